//! Typed indices, and tables that accept only their own.
//!
//! A pass of a graph, its position in a plan, a port and a slot are all numbers; here each has a type of its own:
//!
//! ```
//! use tyndall_graph::descriptor::PortDescriptor;
//! use tyndall_graph::{Handle, Pass, Plan, PlannedPass, PortRef, Resource, Slot};
//!
//! fn resource(plan: &Plan, slot: Handle<Slot>) -> &Resource {
//!     &plan.slots[slot].resource
//! }
//! fn name(plan: &Plan, position: Handle<PlannedPass>) -> &str {
//!     plan.pass_name(position)
//! }
//! fn port(pass: Handle<Pass>, port: Handle<PortDescriptor>) -> PortRef {
//!     PortRef { pass, port }
//! }
//! ```
//!
//! Using one in the place of another does not compile:
//!
//! ```compile_fail
//! # use tyndall_graph::{Handle, Plan, PlannedPass, Resource};
//! fn resource(plan: &Plan, slot: Handle<PlannedPass>) -> &Resource {
//!     &plan.slots[slot].resource
//! }
//! ```
//! ```compile_fail
//! # use tyndall_graph::{Handle, Pass, Plan};
//! fn name(plan: &Plan, position: Handle<Pass>) -> &str {
//!     plan.pass_name(position)
//! }
//! ```
//! ```compile_fail
//! # use tyndall_graph::{Handle, Pass, PortRef, descriptor::ParamDescriptor};
//! fn port(pass: Handle<Pass>, port: Handle<ParamDescriptor>) -> PortRef {
//!     PortRef { pass, port }
//! }
//! ```
//!
//! A handle is valid for the graph or plan that made it. Nothing prevents its use with another one: there it finds something
//! else, or panics like any index beyond the end.

mod segment;
mod table;

use std::cmp::Ordering;
use std::fmt;
use std::hash::{Hash, Hasher};
use std::marker::PhantomData;
use std::num::NonZeroU32;
use std::ops::Range;

pub use segment::{Segment, Slice};
pub use table::Table;

/// The index of a `T` in its [`Table`]: four bytes, and in an `Option` too.
pub struct Handle<T> {
    number: NonZeroU32,
    of: PhantomData<fn() -> T>,
}

impl<T> Handle<T> {
    fn at(index: u32) -> Self {
        Self { number: NonZeroU32::MIN.saturating_add(index), of: PhantomData }
    }

    /// The number, counted from 0, for files and for people.
    pub fn index(self) -> usize {
        self.offset() as usize
    }

    /// The one before it; `None` for the first.
    pub fn before(self) -> Option<Self> {
        self.offset().checked_sub(1).map(Self::at)
    }

    fn offset(self) -> u32 {
        self.number.get() - 1
    }
}

impl<T> Clone for Handle<T> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<T> Copy for Handle<T> {}

impl<T> PartialEq for Handle<T> {
    fn eq(&self, other: &Self) -> bool {
        self.number == other.number
    }
}

impl<T> Eq for Handle<T> {}

impl<T> PartialOrd for Handle<T> {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl<T> Ord for Handle<T> {
    fn cmp(&self, other: &Self) -> Ordering {
        self.number.cmp(&other.number)
    }
}

impl<T> Hash for Handle<T> {
    fn hash<H: Hasher>(&self, state: &mut H) {
        self.number.hash(state);
    }
}

impl<T> fmt::Debug for Handle<T> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "#{}", self.offset())
    }
}

/// Its index.
impl<T> fmt::Display for Handle<T> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.offset().fmt(f)
    }
}

/// Handles in a row.
pub struct Handles<T> {
    offsets: Range<u32>,
    of: PhantomData<fn() -> T>,
}

impl<T> Handles<T> {
    fn new(offsets: Range<u32>) -> Self {
        Self { offsets, of: PhantomData }
    }
}

impl<T> Clone for Handles<T> {
    fn clone(&self) -> Self {
        Self::new(self.offsets.clone())
    }
}

impl<T> PartialEq for Handles<T> {
    fn eq(&self, other: &Self) -> bool {
        self.offsets == other.offsets
    }
}

impl<T> Eq for Handles<T> {}

impl<T> fmt::Debug for Handles<T> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "#{}..#{}", self.offsets.start, self.offsets.end)
    }
}

impl<T> Iterator for Handles<T> {
    type Item = Handle<T>;

    fn next(&mut self) -> Option<Handle<T>> {
        self.offsets.next().map(Handle::at)
    }

    fn size_hint(&self) -> (usize, Option<usize>) {
        self.offsets.size_hint()
    }
}

impl<T> DoubleEndedIterator for Handles<T> {
    fn next_back(&mut self) -> Option<Handle<T>> {
        self.offsets.next_back().map(Handle::at)
    }
}

impl<T> ExactSizeIterator for Handles<T> {}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_handle_takes_four_bytes_in_an_option_too() {
        assert_eq!((size_of::<Handle<String>>(), size_of::<Option<Handle<String>>>()), (4, 4));
    }

    #[test]
    fn handles_count_from_0_and_are_ordered() {
        let table: Table<char> = "abc".chars().collect();
        let handles: Vec<Handle<char>> = table.handles().collect();
        assert_eq!(handles.iter().map(|handle| handle.index()).collect::<Vec<_>>(), [0, 1, 2]);
        assert!(handles.is_sorted());
        assert_eq!((handles[0].before(), handles[2].before()), (None, Some(handles[1])));
        assert_eq!(format!("{} {:?}", handles[2], handles[2]), "2 #2");
        assert!(table.handles().rev().eq(handles.into_iter().rev()));
    }

    #[test]
    fn a_segment_leads_to_and_fro() {
        let (short, long): (Table<u8>, Table<u8>) = ([1, 2].into_iter().collect(), [1, 2, 3].into_iter().collect());
        let mut all: Table<char> = Table::new();
        let (first, second) = (all.push_for(&short, 'a'), all.push_for(&long, 'b'));
        assert_eq!(all.iter().collect::<String>(), "aabbb");
        assert_eq!(first.handles().chain(second.handles()).collect::<Vec<_>>(), all.handles().collect::<Vec<_>>());
        for key in long.handles() {
            assert_eq!(second.key(second.at(key)), key);
            assert_eq!(all.slice(second)[key], 'b');
        }
        assert_eq!(all.slice(first).len(), 2);
    }
}
