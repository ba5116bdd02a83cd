//! Text to plan, step by step, from 10 to 10,000 passes.

#![allow(missing_docs, clippy::unwrap_used, reason = "a benchmark")]

#[path = "../tests/support/mod.rs"]
mod support;

use std::sync::Arc;

use divan::Bencher;
use divan::counter::ItemsCount;
use support::{catalogue, exists, generated};
use tyndall_document::{Diagnostics, Source};
use tyndall_graph::{Catalogue, Graph, GraphFile, Overrides, PlanOptions, plan, read, validate_with};

const PASSES: [usize; 7] = [10, 20, 100, 300, 1000, 3000, 10_000];

fn main() {
    divan::main();
}

fn parsed(source: &Arc<Source>) -> GraphFile {
    read(source, &mut Diagnostics::default()).unwrap()
}

fn validated(file: &GraphFile, catalogue: &Catalogue) -> Arc<Graph> {
    validate_with(file, catalogue, &Overrides::default(), &exists, &mut Diagnostics::default()).unwrap()
}

#[divan::bench(args = PASSES)]
fn parse(bencher: Bencher, passes: usize) {
    let source = Source::new("bench.graph.ron", generated(passes));
    bencher.counter(ItemsCount::new(passes)).bench_local(|| parsed(&source));
}

#[divan::bench(args = PASSES)]
fn validate(bencher: Bencher, passes: usize) {
    let (file, catalogue) = (parsed(&Source::new("bench.graph.ron", generated(passes))), catalogue());
    bencher.counter(ItemsCount::new(passes)).bench_local(|| validated(&file, &catalogue));
}

#[divan::bench(name = "plan", args = PASSES)]
fn planning(bencher: Bencher, passes: usize) {
    let graph = validated(&parsed(&Source::new("bench.graph.ron", generated(passes))), &catalogue());
    let options = PlanOptions::new(graph.size);
    bencher.counter(ItemsCount::new(passes)).bench_local(|| plan(&graph, &options).unwrap());
}

#[divan::bench(args = PASSES)]
fn text_to_plan(bencher: Bencher, passes: usize) {
    let (text, catalogue) = (generated(passes), catalogue());
    bencher.counter(ItemsCount::new(passes)).bench_local(|| {
        let graph = validated(&parsed(&Source::new("bench.graph.ron", text.as_str())), &catalogue);
        plan(&graph, &PlanOptions::new(graph.size)).unwrap()
    });
}
