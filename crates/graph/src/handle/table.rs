//! Vectors that are indexed by handles of one kind.

use std::fmt;
use std::marker::PhantomData;
use std::ops::{Index, IndexMut};

use super::{Handle, Handles, Segment, Slice};

/// A vector of `V` that is indexed by handles of `K`: the `K` themselves, or a column with a property of each.
pub struct Table<K, V = K> {
    values: Vec<V>,
    of: PhantomData<fn() -> K>,
}

impl<K, V> Table<K, V> {
    /// An empty one.
    pub const fn new() -> Self {
        Self { values: Vec::new(), of: PhantomData }
    }

    /// An empty one with room for this many.
    pub fn with_capacity(capacity: usize) -> Self {
        Self::from(Vec::with_capacity(capacity))
    }

    /// Adds a value at the end.
    pub fn push(&mut self, value: V) -> Handle<K> {
        let handle = self.next_handle();
        self.values.push(value);
        handle
    }

    /// The handle of the value that is pushed next.
    pub fn next_handle(&self) -> Handle<K> {
        Handle::at(self.end())
    }

    /// The handles of the values pushed since `first` was the next.
    pub fn since(&self, first: Handle<K>) -> Handles<K> {
        Handles::new(first.offset()..self.end())
    }

    /// Adds a value for each entry of another table.
    pub fn push_for<P, W>(&mut self, other: &Table<P, W>, value: V) -> Segment<P, K>
    where
        V: Clone,
    {
        let first = self.end();
        self.values.resize(self.values.len() + other.len(), value);
        Segment::new(first..self.end())
    }

    /// A column beside this table: a value for each of its entries.
    pub fn column<W: Clone>(&self, value: W) -> Table<K, W> {
        Table::from(vec![value; self.len()])
    }

    /// How many there are.
    pub fn len(&self) -> usize {
        self.values.len()
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.values.is_empty()
    }

    /// All handles, in order.
    pub fn handles(&self) -> Handles<K> {
        Handles::new(0..self.end())
    }

    /// All values, in order.
    pub fn iter(&self) -> std::slice::Iter<'_, V> {
        self.values.iter()
    }

    /// All values, in order, to be changed.
    pub fn iter_mut(&mut self) -> std::slice::IterMut<'_, V> {
        self.values.iter_mut()
    }

    /// All values with their handles, in order.
    pub fn entries(&self) -> impl DoubleEndedIterator<Item = (Handle<K>, &V)> + ExactSizeIterator + Clone {
        self.handles().zip(&self.values)
    }

    /// The first entry of which this is true.
    pub fn position(&self, is_wanted: impl FnMut(&V) -> bool) -> Option<Handle<K>> {
        let index = self.values.iter().position(is_wanted)?;
        self.handles().nth(index)
    }

    /// The value of a handle, if this table has come so far.
    pub fn get(&self, handle: Handle<K>) -> Option<&V> {
        self.values.get(handle.index())
    }

    /// The values of a segment, opened by what that is a segment for.
    pub fn slice<P>(&self, segment: Segment<P, K>) -> Slice<'_, P, V> {
        Slice::new(&self.values[segment.range()])
    }

    /// Puts one value everywhere.
    pub fn fill(&mut self, value: V)
    where
        V: Clone,
    {
        self.values.fill(value);
    }

    /// Keeps only the entries of which this is true: handles of those behind others change.
    pub fn retain(&mut self, is_wanted: impl FnMut(&V) -> bool) {
        self.values.retain(is_wanted);
    }

    fn end(&self) -> u32 {
        self.values.len() as u32
    }
}

impl<K, V> Index<Handle<K>> for Table<K, V> {
    type Output = V;

    fn index(&self, handle: Handle<K>) -> &V {
        &self.values[handle.index()]
    }
}

impl<K, V> IndexMut<Handle<K>> for Table<K, V> {
    fn index_mut(&mut self, handle: Handle<K>) -> &mut V {
        &mut self.values[handle.index()]
    }
}

impl<K, V> From<Vec<V>> for Table<K, V> {
    fn from(values: Vec<V>) -> Self {
        Self { values, of: PhantomData }
    }
}

impl<K, V, const N: usize> From<[V; N]> for Table<K, V> {
    fn from(values: [V; N]) -> Self {
        Self::from(Vec::from(values))
    }
}

impl<K, V> FromIterator<V> for Table<K, V> {
    fn from_iter<I: IntoIterator<Item = V>>(values: I) -> Self {
        Self::from(Vec::from_iter(values))
    }
}

impl<K, V> Extend<V> for Table<K, V> {
    fn extend<I: IntoIterator<Item = V>>(&mut self, values: I) {
        self.values.extend(values);
    }
}

impl<K, V> IntoIterator for Table<K, V> {
    type Item = V;
    type IntoIter = std::vec::IntoIter<V>;

    fn into_iter(self) -> Self::IntoIter {
        self.values.into_iter()
    }
}

impl<'a, K, V> IntoIterator for &'a Table<K, V> {
    type Item = &'a V;
    type IntoIter = std::slice::Iter<'a, V>;

    fn into_iter(self) -> Self::IntoIter {
        self.values.iter()
    }
}

impl<'a, K, V> IntoIterator for &'a mut Table<K, V> {
    type Item = &'a mut V;
    type IntoIter = std::slice::IterMut<'a, V>;

    fn into_iter(self) -> Self::IntoIter {
        self.values.iter_mut()
    }
}

impl<K, V> Default for Table<K, V> {
    fn default() -> Self {
        Self::new()
    }
}

impl<K, V: Clone> Clone for Table<K, V> {
    fn clone(&self) -> Self {
        Self::from(self.values.clone())
    }
}

impl<K, V: PartialEq> PartialEq for Table<K, V> {
    fn eq(&self, other: &Self) -> bool {
        self.values == other.values
    }
}

impl<K, V: Eq> Eq for Table<K, V> {}

impl<K, V: fmt::Debug> fmt::Debug for Table<K, V> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.values.fmt(f)
    }
}
