//! Indices by name, without the names: they stand where the indices lead.

use std::hash::Hasher;

use rustc_hash::FxHasher;

/// A hash table of indices. Whoever asks says which name an index has.
#[derive(Debug, Default)]
pub(crate) struct Names {
    /// Half a hash and an index each; half of them free, so that a search ends soon.
    entries: Vec<Option<(u32, u32)>>,
}

impl Names {
    /// Room for so many names.
    pub fn with_capacity(names: usize) -> Self {
        Self { entries: vec![None; (2 * names).next_power_of_two()] }
    }

    /// Adds an index, unless there is one of this name. No more may be added than there is room for.
    pub fn insert(&mut self, name: &str, index: u32, name_of: impl Fn(u32) -> bool) {
        let hash = hash(name);
        if let Err(free) = self.search(hash, name_of) {
            self.entries[free] = Some((hash, index));
        }
    }

    /// The index of this name; `is_named` says whether an index has it.
    pub fn find(&self, name: &str, is_named: impl Fn(u32) -> bool) -> Option<u32> {
        if self.entries.is_empty() {
            return None;
        }
        self.search(hash(name), is_named).ok()
    }

    /// The index, or the free entry where it would stand.
    fn search(&self, hash: u32, is_named: impl Fn(u32) -> bool) -> Result<u32, usize> {
        let mask = self.entries.len() - 1;
        let mut at = hash as usize & mask;
        while let Some((other, index)) = self.entries[at] {
            if other == hash && is_named(index) {
                return Ok(index);
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
