//! Which of all mistakes are made: drawn by a seed, and spread.

use std::collections::BTreeMap;
use std::hash::{DefaultHasher, Hash, Hasher};

use tyndall_shader::MutationKind;

/// Draws mistakes of a pass: function by function, so that a long one does not take all, and of the kind that was drawn
/// least so far.
pub(crate) struct Draw {
    /// Sites that are left, by function, the functions in a drawn order.
    functions: Vec<Vec<(usize, MutationKind)>>,
    next: usize,
    drawn: BTreeMap<MutationKind, usize>,
    kinds: Vec<MutationKind>,
    state: u64,
}

impl Draw {
    /// Of these sites, each with the function that it is in.
    pub fn new(sites: &[(&str, MutationKind)], pass: &str, seed: u64) -> Self {
        let mut functions: BTreeMap<&str, Vec<(usize, MutationKind)>> = BTreeMap::new();
        for (index, (function, kind)) in sites.iter().enumerate() {
            functions.entry(function).or_default().push((index, *kind));
        }
        let mut hasher = DefaultHasher::new();
        (pass, seed).hash(&mut hasher);
        let mut draw = Self {
            functions: Vec::new(),
            next: 0,
            drawn: BTreeMap::new(),
            kinds: sites.iter().map(|(_, kind)| *kind).collect(),
            state: hasher.finish(),
        };
        let mut left: Vec<_> = functions.into_values().collect();
        while !left.is_empty() {
            let one = draw.below(left.len());
            draw.functions.push(left.swap_remove(one));
        }
        draw
    }

    /// The next site; `None` where all were drawn.
    pub fn next(&mut self) -> Option<usize> {
        let count = self.functions.len();
        let turn = (0..count).map(|step| (self.next + step) % count).find(|turn| !self.functions[*turn].is_empty())?;
        self.next = (turn + 1) % count;
        let times = |kind: &MutationKind| self.drawn.get(kind).copied().unwrap_or_default();
        let sites = &self.functions[turn];
        let least = sites.iter().map(|(_, kind)| times(kind)).min()?;
        let rare: Vec<usize> = (0..sites.len()).filter(|at| times(&sites[*at].1) == least).collect();
        let at = rare[self.below(rare.len())];
        let (site, kind) = self.functions[turn].swap_remove(at);
        *self.drawn.entry(kind).or_default() += 1;
        Some(site)
    }

    /// The site could not be used: its kind is still to be drawn.
    pub fn undo(&mut self, site: usize) {
        if let Some(count) = self.drawn.get_mut(&self.kinds[site]) {
            *count -= 1;
        }
    }

    /// A number below `count`, which is above 0, by splitmix64 (Steele, Lea and Flood 2014).
    fn below(&mut self, count: usize) -> usize {
        self.state = self.state.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut mixed = self.state;
        mixed = (mixed ^ (mixed >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        mixed = (mixed ^ (mixed >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((mixed ^ (mixed >> 31)) % count as u64) as usize
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sites() -> Vec<(&'static str, MutationKind)> {
        let long = (0..50).map(|index| ("long", MutationKind::ALL[index % 5]));
        long.chain(["a", "b", "c"].map(|name| (name, MutationKind::FlipSign))).collect()
    }

    fn all(pass: &str, seed: u64) -> Vec<usize> {
        let mut draw = Draw::new(&sites(), pass, seed);
        std::iter::from_fn(|| draw.next()).collect()
    }

    #[test]
    fn a_seed_draws_the_same_and_another_seed_or_pass_something_else() {
        assert_eq!(all("p.a", 7), all("p.a", 7));
        assert_ne!(all("p.a", 7), all("p.a", 8));
        assert_ne!(all("p.a", 7), all("p.b", 7));
        let mut sorted = all("p.a", 7);
        sorted.sort_unstable();
        assert_eq!(sorted, (0..53).collect::<Vec<_>>(), "each once");
    }

    #[test]
    fn a_long_function_does_not_take_all_and_kinds_take_turns() {
        for seed in 0..20 {
            let first = &all("p.a", seed)[..8];
            let short = first.iter().filter(|site| **site >= 50).count();
            assert_eq!(short, 3, "each short function has its turn");
            let kinds: std::collections::BTreeSet<_> = first.iter().map(|site| sites()[*site].1).collect();
            assert_eq!(kinds.len(), 5);
        }
    }
}
