//! The order in which passes run.

use super::Order;
use crate::graph::Pass;
use crate::handle::{Handle, Table};
use crate::wiring::Wiring;

/// The needed passes, each after those that it reads.
pub(super) fn order(wiring: &Wiring, needed: &Table<Pass, bool>, order: Order) -> Vec<Handle<Pass>> {
    match order {
        Order::File => wiring.order.iter().copied().filter(|pass| needed[*pass]).collect(),
        Order::Shuffled(seed) => shuffled(wiring, needed, seed),
    }
}

/// Repeatedly chooses one of the passes that are ready.
fn shuffled(wiring: &Wiring, needed: &Table<Pass, bool>, seed: u64) -> Vec<Handle<Pass>> {
    let mut waits_for = needed.column(0u32);
    let mut readers: Table<Pass, Vec<Handle<Pass>>> = needed.column(Vec::new());
    for pass in needed.handles().filter(|pass| needed[*pass]) {
        // A pass waits once for each port that it reads.
        for source in wiring.sources(pass) {
            readers[wiring.passes.pass_of[source]].push(pass);
            waits_for[pass] += 1;
        }
    }
    let is_ready = |pass: &Handle<Pass>| needed[*pass] && waits_for[*pass] == 0;
    let mut ready: Vec<Handle<Pass>> = needed.handles().filter(is_ready).collect();
    let mut random = Random(seed);
    let mut order = Vec::with_capacity(needed.len());
    while !ready.is_empty() {
        let pass = ready.swap_remove(random.below(ready.len()));
        order.push(pass);
        for reader in &readers[pass] {
            waits_for[*reader] -= 1;
            if waits_for[*reader] == 0 {
                ready.push(*reader);
            }
        }
    }
    order
}

/// SplitMix64 (Steele, Lea, Flood 2014): good enough to choose an order.
struct Random(u64);

impl Random {
    fn below(&mut self, end: usize) -> usize {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut mixed = self.0;
        mixed = (mixed ^ (mixed >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        mixed = (mixed ^ (mixed >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((mixed ^ (mixed >> 31)) % end as u64) as usize
    }
}
