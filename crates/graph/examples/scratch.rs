#![allow(missing_docs)]
#[path = "../tests/support/mod.rs"]
mod support;
use std::time::Instant;
use tyndall_document::{Diagnostics, Source, parse, Node, Value};
use tyndall_graph::*;
fn main() {
    println!("Node {} Value {} PassEntry {} InputEntry {}", size_of::<Node>(), size_of::<Value>(), size_of::<PassEntry>(), size_of::<InputEntry>());
    for _ in 0..3 {
    for n in [100usize, 10000] {
        let source = Source::new("b.graph.ron", support::generated(n));
        let mut best = [f64::MAX; 4];
        for _ in 0..(300_000 / n) {
            let t0 = Instant::now();
            let node = parse(&source, &mut Diagnostics::default()).unwrap();
            let t1 = Instant::now();
            drop(node);
            let t2 = Instant::now();
            let file = read(&source, &mut Diagnostics::default()).unwrap();
            let t3 = Instant::now();
            drop(file);
            let t4 = Instant::now();
            for (b, d) in best.iter_mut().zip([t1 - t0, t2 - t1, t3 - t2, t4 - t3]) { *b = b.min(d.as_nanos() as f64 / n as f64); }
        }
        println!("{n}: parse {:.0} drop {:.0} read {:.0} drop {:.0}", best[0], best[1], best[2], best[3]);
    }}
}
