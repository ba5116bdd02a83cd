//! The order in which passes run.

use super::Order;
use crate::signature::RoleKind;
use crate::table::Table;

/// The needed passes, each after those that it reads.
pub(super) fn order(table: &Table, needed: &[bool], order: Order) -> Vec<u32> {
    match order {
        Order::File => table.order.iter().copied().filter(|pass| needed[*pass as usize]).collect(),
        Order::Shuffled(seed) => shuffled(table, needed, seed),
    }
}

/// Draws one of the passes that are ready, again and again.
fn shuffled(table: &Table, needed: &[bool], seed: u64) -> Vec<u32> {
    let passes = table.passes() as usize;
    let mut waits_for = vec![0u32; passes];
    let mut readers: Vec<Vec<u32>> = vec![Vec::new(); passes];
    for pass in (0..table.passes()).filter(|pass| needed[*pass as usize]) {
        for source in sources(table, pass) {
            readers[source as usize].push(pass);
            waits_for[pass as usize] += 1;
        }
    }
    let is_ready = |pass: &u32| needed[*pass as usize] && waits_for[*pass as usize] == 0;
    let mut ready: Vec<u32> = (0..table.passes()).filter(is_ready).collect();
    let mut random = Random(seed);
    let mut order = Vec::with_capacity(passes);
    while !ready.is_empty() {
        let pass = ready.swap_remove(random.below(ready.len()));
        order.push(pass);
        for reader in &readers[pass as usize] {
            waits_for[*reader as usize] -= 1;
            if waits_for[*reader as usize] == 0 {
                ready.push(*reader);
            }
        }
    }
    order
}

/// The passes that a pass waits for, once for each port that it reads.
fn sources(table: &Table, pass: u32) -> impl Iterator<Item = u32> + '_ {
    let ports = table.ports(pass).zip(&table.kind(pass).signature.ports);
    ports.filter(|(_, port)| !matches!(port.role, RoleKind::History | RoleKind::Output)).filter_map(|(port, _)| {
        let source = table.feeds[port as usize].as_port()?;
        Some(table.pass_of[source as usize])
    })
}

/// SplitMix64 (Steele, Lea, Flood 2014): enough to draw an order.
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
