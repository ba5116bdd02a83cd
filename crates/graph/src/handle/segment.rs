//! Parts of tables.

use std::fmt;
use std::marker::PhantomData;
use std::ops::{Index, Range};

use super::{Handle, Handles};

/// Handles of `V` in a row, one for each `K` of something: all ports of a graph that are of one pass, by their place in
/// its descriptor.
pub struct Segment<K, V> {
    first: u32,
    end: u32,
    of: PhantomData<fn() -> (K, V)>,
}

impl<K, V> Segment<K, V> {
    pub(super) fn new(Range { start: first, end }: Range<u32>) -> Self {
        Self { first, end, of: PhantomData }
    }

    pub(super) fn range(self) -> Range<usize> {
        self.first as usize..self.end as usize
    }

    /// The handle that stands for `key`.
    pub fn at(self, key: Handle<K>) -> Handle<V> {
        Handle { number: key.number.saturating_add(self.first), of: PhantomData }
    }

    /// What a handle of this segment stands for.
    pub fn key(self, handle: Handle<V>) -> Handle<K> {
        Handle::at(handle.offset() - self.first)
    }

    /// All of them, in order.
    pub fn handles(self) -> Handles<V> {
        Handles::new(self.first..self.end)
    }
}

impl<K, V> Clone for Segment<K, V> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<K, V> Copy for Segment<K, V> {}

impl<K, V> fmt::Debug for Segment<K, V> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.handles().fmt(f)
    }
}

/// A part of a table, indexed by handles of `K`.
pub struct Slice<'a, K, V> {
    values: &'a [V],
    of: PhantomData<fn() -> K>,
}

impl<'a, K, V> Slice<'a, K, V> {
    pub(super) fn new(values: &'a [V]) -> Self {
        Self { values, of: PhantomData }
    }

    /// How many there are.
    pub fn len(self) -> usize {
        self.values.len()
    }

    /// Whether there are none.
    pub fn is_empty(self) -> bool {
        self.values.is_empty()
    }

    /// All values, in order.
    pub fn iter(self) -> std::slice::Iter<'a, V> {
        self.values.iter()
    }

    /// All values with their handles, in order.
    pub fn entries(self) -> impl DoubleEndedIterator<Item = (Handle<K>, &'a V)> + ExactSizeIterator + Clone {
        Handles::new(0..self.values.len() as u32).zip(self.values)
    }
}

impl<K, V> Clone for Slice<'_, K, V> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<K, V> Copy for Slice<'_, K, V> {}

impl<K, V> Index<Handle<K>> for Slice<'_, K, V> {
    type Output = V;

    fn index(&self, handle: Handle<K>) -> &V {
        &self.values[handle.index()]
    }
}

impl<'a, K, V> IntoIterator for Slice<'a, K, V> {
    type Item = &'a V;
    type IntoIter = std::slice::Iter<'a, V>;

    fn into_iter(self) -> Self::IntoIter {
        self.values.iter()
    }
}

impl<K, V: fmt::Debug> fmt::Debug for Slice<'_, K, V> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.values.fmt(f)
    }
}
