//! From text to plan fast enough for an editor, and no slower per pass in large graphs than in small ones.

#![allow(clippy::unwrap_used, reason = "a test")]

mod support;

use std::sync::Arc;
use std::time::{Duration, Instant};

use support::{catalogue, exists, generated};
use tyndall_document::{Diagnostics, Source};
use tyndall_graph::{Catalogue, Overrides, PlanOptions, plan, read, validate_with};

/// Parse, validate, plan; and all of them.
fn steps(source: &Arc<Source>, catalogue: &Catalogue) -> [Duration; 4] {
    let mut out = Diagnostics::default();
    let started = Instant::now();
    let file = read(source, &mut out).unwrap();
    let parsed = Instant::now();
    let graph = validate_with(&file, catalogue, &Overrides::default(), &exists, &mut out).unwrap();
    let validated = Instant::now();
    let planned = plan(&graph, &PlanOptions::new(graph.size)).unwrap();
    let done = Instant::now();
    drop((file, planned));
    [parsed - started, validated - parsed, done - validated, done - started]
}

/// The fastest of many turns, for whatever else the machine does only makes them slower. Sizes take turns.
fn fastest(sizes: &[usize], turns: usize) -> Vec<[Duration; 4]> {
    let catalogue = catalogue();
    let sources: Vec<Arc<Source>> =
        sizes.iter().map(|passes| Source::new("speed.graph.ron", generated(*passes))).collect();
    let mut fastest = vec![[Duration::MAX; 4]; sizes.len()];
    for _ in 0..turns {
        for ((source, passes), fastest) in sources.iter().zip(sizes).zip(&mut fastest) {
            for _ in 0..(1000 / passes).max(1) {
                for (fastest, took) in fastest.iter_mut().zip(steps(source, &catalogue)) {
                    *fastest = took.min(*fastest);
                }
            }
        }
    }
    fastest
}

#[test]
fn text_to_plan_is_fast_and_linear() {
    let sizes = [10, 20, 100, 1000, 10_000];
    let times = fastest(&sizes, 30);
    let per_pass = |time: Duration, passes: usize| time.as_nanos() as f64 / passes as f64;
    println!("ns per pass: parse, validate, plan, all");
    for (time, passes) in times.iter().zip(sizes) {
        let [parse, validate, plan, all] = time.map(|time| per_pass(time, passes));
        println!("{passes:>6} passes {parse:>6.0} {validate:>6.0} {plan:>6.0} {all:>6.0}");
    }
    assert!(times[1][3] < Duration::from_millis(1), "20 passes: {:?}", times[1]);
    assert!(times[4][3] < Duration::from_millis(150), "10,000 passes: {:?}", times[4]);
    let (small, large) = (per_pass(times[2][3], 100), per_pass(times[4][3], 10_000));
    assert!(large <= 2.0 * small, "{large} ns a pass of 10,000, {small} ns a pass of 100");
}
