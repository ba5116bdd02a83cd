//! A chain of small passes, as a plan and as a frame of wgpu written by hand.

#![allow(dead_code, missing_docs, clippy::unwrap_used, reason = "each test and benchmark uses a part")]

pub mod by_hand;
mod programs;

pub use programs::{catalogue, shaders};

use std::fmt::Write;
use std::sync::Arc;

use tyndall_document::{Diagnostics, Source, render_text};
use tyndall_gpu::{Executor, Gpu, GpuError, PipelineCache, SceneBuffers};
use tyndall_graph::{Graph, Overrides, Plan, PlanOptions, plan, read, validate};

/// Pixels on each side of every picture of a [`chain`].
pub const SIDE: u32 = 8;

/// A source and `passes - 1` steps, each of which scales what the one before it gave.
pub fn chain(passes: usize) -> String {
    let mut text = format!("(version: 1, size: ({SIDE}, {SIDE}), passes: {{\n\"p0\": (use: \"test.source\"),\n");
    for pass in 1..passes {
        let from = if pass == 1 { "p0.color".to_owned() } else { format!("p{}.scaled", pass - 1) };
        writeln!(text, "\"p{pass}\": (use: \"test.step\", inputs: {{ \"input\": \"{from}\" }}),").unwrap();
    }
    text + &format!("}}, outputs: {{ \"last\": \"p{}.scaled\" }})", passes - 1)
}

/// A graph file's text as a checked graph.
pub fn graph(text: &str) -> Arc<Graph> {
    let mut out = Diagnostics::default();
    let file = read(&Source::new("test.graph.ron", text), &mut out);
    let graph = file.and_then(|file| validate(&file, &catalogue(), &Overrides::default(), &mut out));
    assert!(out.is_empty(), "{}", render_text(&out, false));
    graph.unwrap()
}

/// Its plan, in the size that it names.
pub fn planned(text: &str) -> Plan {
    let graph = graph(text);
    plan(&graph, &PlanOptions::new(graph.size)).unwrap()
}

/// A plan on a device.
pub fn executor(gpu: &Arc<Gpu>, plan: Plan) -> Result<Executor, GpuError> {
    Executor::new(gpu, Arc::new(plan), &shaders(), &mut PipelineCache::default(), SceneBuffers::default())
}

/// The device of the machine; a machine without one fails the test.
pub fn gpu() -> Arc<Gpu> {
    Gpu::open(None).unwrap_or_else(|error| panic!("{error}"))
}
