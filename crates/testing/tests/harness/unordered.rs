//! Ports whose elements come in no order: compared sorted, and what lies downstream bit by bit.

use std::sync::atomic::{AtomicUsize, Ordering};

use tempfile::TempDir;
use tyndall_plugin::descriptor::{
    Class, Dimension, Disabled, Format, PassDescriptor, PortDescriptor, PortKind, Role, SizeRule,
};
use tyndall_plugin::{Folder, GpuError, Plugin, Program, Recorder, RustPass};
use tyndall_testing::{Options, Outcome, Robustness, Session};

/// Elements of the list.
const COUNT: u32 = 8;

/// How often a list was written: each time it begins with the next element, as one that threads append to may.
static WRITTEN: AtomicUsize = AtomicUsize::new(0);

const MANIFEST: &str = r#"(name: "list", version: "0.1.0", about: "lists", passes: {
    "sum": (about: "the sum of a list", shader: "sum.wgsl", ports: {
        "list": (about: "a list"),
        "result": (about: "its sum", size: Frame(1.0), disabled: Constant(0.0, 0.0, 0.0, 1.0)),
    }),
    "first": (about: "the first of a list", shader: "first.wgsl", ports: {
        "list": (about: "a list"),
        "result": (about: "its first element", size: Frame(1.0), disabled: Constant(0.0, 0.0, 0.0, 1.0)),
    }),
})"#;

fn shader(value: &str) -> String {
    format!(
        "var list: texture_2d<f32>;
var result: texture_storage_2d<rgba32float, write>;
@compute @workgroup_size(8, 8)
fn main(@builtin(global_invocation_id) id: vec3<u32>) {{
    if any(id.xy >= textureDimensions(result)) {{ return; }}
    var sum = vec3(0.0);
    for (var at = 0u; at < {COUNT}u; at++) {{ sum += textureLoad(list, vec2(at, 0u), 0).rgb; }}
    let first = textureLoad(list, vec2(0u), 0).rgb;
    textureStore(result, id.xy, vec4({value}, 1.0));
}}
"
    )
}

fn plugin() -> Plugin {
    let (sum, first) = (shader("sum + 0.0 * first"), shader("first + 0.0 * sum"));
    let files = [("plugin.ron", MANIFEST), ("sum.wgsl", &sum), ("first.wgsl", &first)];
    Plugin::new("list", Folder::embedded("list", &files))
        .pass(list("list.declared", true, false))
        .pass(list("list.undeclared", false, false))
        .pass(list("list.changing", true, true))
}

fn list(name: &str, unordered: bool, changes: bool) -> RustPass {
    let texture = PortKind::Texture {
        dimension: Dimension::D2,
        class: Class::Color,
        format: Some(Format::Rgba32Float),
        filtered: false,
    };
    let port = PortDescriptor {
        name: "list".to_owned(),
        about: "A list".to_owned(),
        unit: String::new(),
        role: Role::Output { disabled: Disabled::Constant([0.0; 4]) },
        kind: texture,
        size: Some(SizeRule::fixed(COUNT, 1, 1)),
        unordered,
    };
    let descriptor = PassDescriptor {
        name: name.to_owned(),
        about: "A list whose elements come in another order each time".to_owned(),
        source: String::new(),
        ports: [port].into(),
        params: [].into(),
        presets: Vec::new(),
        scene: Vec::new(),
        side_effect: false,
        revision: 1,
    };
    RustPass { descriptor, shaders: Vec::new(), make: Box::new(move |_, _| Ok(Box::new(List { changes }))) }
}

struct List {
    changes: bool,
}

impl Program for List {
    fn record(&mut self, recorder: &mut Recorder<'_>) -> Result<(), GpuError> {
        let written = WRITTEN.fetch_add(1, Ordering::Relaxed);
        let element = |at: usize| {
            let number = ((at + written) % COUNT as usize) as f32;
            // An element that is not the one of the time before, in a list that changes.
            let number = if self.changes && number == 3.0 { 100.0 + written as f32 } else { number };
            [number, 2.0 * number, 1.0, 1.0]
        };
        let texels: Vec<u8> = (0..COUNT as usize).flat_map(element).flat_map(f32::to_le_bytes).collect();
        let port = recorder.pass.port("list")?;
        recorder.write_texture(port, &texels)
    }
}

/// Runs a graph of one kind of list, and of one that reads it, once and then twice more.
fn run(list: &str, reader: &str) -> Outcome {
    let folder = TempDir::new().unwrap();
    let graph = format!(
        "(version: 1, size: (8, 8), passes: {{
            \"items\": (use: \"list.{list}\"),
            \"read\": (use: \"list.{reader}\", inputs: {{ \"list\": \"items.list\" }}),
        }}, outputs: {{ \"read\": \"read.result\" }})"
    );
    std::fs::write(folder.path().join("list.graph.ron"), graph).unwrap();
    let test = "(version: 1, graph: \"list.graph.ron\", size: (8, 8), taps: { \"*\": (properties: [Finite]) })";
    std::fs::write(folder.path().join("list.test.ron"), test).unwrap();
    let mut session = Session::new(vec![plugin], Vec::new(), None).unwrap_or_else(|error| panic!("{error}"));
    let robustness = Robustness { repeat: 2, ..Robustness::default() };
    session.run(&folder.path().join("list.test.ron"), &Options { robustness, ..Options::default() })
}

#[test]
fn an_unordered_list_is_compared_sorted_and_what_follows_bit_by_bit() {
    let right = run("declared", "sum");
    assert!(right.passed(), "{}", right.text());
    let order_matters = run("declared", "first");
    assert!(order_matters.text().contains("`read.result` came out different"), "{}", order_matters.text());
    assert!(!order_matters.text().contains("`items.list`"), "{}", order_matters.text());
}

#[test]
fn a_list_that_is_not_declared_unordered_must_keep_its_order() {
    let outcome = run("undeclared", "sum");
    assert!(outcome.text().contains("`items.list` came out different"), "{}", outcome.text());
}

#[test]
fn other_elements_are_noticed_in_any_order() {
    let outcome = run("changing", "sum");
    assert!(outcome.text().contains("`items.list` came out different"), "{}", outcome.text());
}
