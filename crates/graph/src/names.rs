//! Handles by name, without the names: they stand where the handles lead.

use std::hash::Hasher;

use rustc_hash::FxHasher;

use crate::handle::Handle;

/// A hash table of handles. Whoever asks says which name a handle has.
#[derive(Debug)]
pub(crate) struct Names<T> {
    /// Half a hash and a handle each; half of them free, so that a search ends soon.
    entries: Vec<Option<(u32, Handle<T>)>>,
}

impl<T> Names<T> {
    /// Room for so many names.
    pub fn with_capacity(names: usize) -> Self {
        Self { entries: vec![None; (2 * names).next_power_of_two()] }
    }

    /// Adds a handle, unless there is one of this name. No more may be added than there is room for.
    pub fn insert(&mut self, name: &str, handle: Handle<T>, is_named: impl Fn(Handle<T>) -> bool) {
        let hash = hash(name);
        if let Err(free) = self.search(hash, is_named) {
            self.entries[free] = Some((hash, handle));
        }
    }

    /// The handle of this name; `is_named` says whether a handle has it.
    pub fn find(&self, name: &str, is_named: impl Fn(Handle<T>) -> bool) -> Option<Handle<T>> {
        self.search(hash(name), is_named).ok()
    }

    /// The handle, or the free entry where it would stand.
    fn search(&self, hash: u32, is_named: impl Fn(Handle<T>) -> bool) -> Result<Handle<T>, usize> {
        let mask = self.entries.len() - 1;
        let mut at = hash as usize & mask;
        while let Some((other, handle)) = self.entries[at] {
            if other == hash && is_named(handle) {
                return Ok(handle);
            }
            at = (at + 1) & mask;
        }
        Err(at)
    }
}

fn hash(name: &str) -> u32 {
    let mut hasher = FxHasher::default();
    hasher.write(name.as_bytes());
    let hash = hasher.finish();
    (hash ^ (hash >> 32)) as u32
}
