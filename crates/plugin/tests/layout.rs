//! Structs of scene data in a plugin's WGSL, held against those in its Rust.

use tyndall_document::render_text;
use tyndall_plugin::scene::{Part, SceneData, wgsl_struct};
use tyndall_plugin::{Folder, Plugin, Registry};
use tyndall_shader::Library;

wgsl_struct! {
    /// `Spark`.
    struct Spark {
        position: [f32; 3],
        count: u32,
        color: [f32; 3],
        pad0: f32,
    }
}

const MANIFEST: &str = "(name: \"t\", version: \"0.1.0\", about: \"For tests.\", passes: {
    \"show\": (about: \"Shows sparks.\", shader: \"p.wgsl\", ports: { \"result\": (about: \"Sparks\", size: Frame(1.0)) }),
})";

const SPARK: &str = "struct Spark { position: vec3<f32>, count: u32, color: vec3<f32> }
struct Sparks { count: u32, pad0: u32, pad1: u32, pad2: u32, items: array<Spark> }
var<storage, read> sparks: Sparks;
var<uniform> first: Spark;
var result: texture_storage_2d<rgba32float, write>;
@compute @workgroup_size(8, 8) fn main(@builtin(global_invocation_id) id: vec3<u32>) {
    let spark = sparks.items[0];
    textureStore(result, id.xy, vec4<f32>(first.color + spark.color, 1.0));
}";

/// What is wrong with a shader.
fn mistakes(shader: &str) -> String {
    let folder = Folder::embedded("t", &[("plugin.ron", MANIFEST), ("p.wgsl", shader)]);
    let plugin = Plugin::new("t", folder)
        .scene_data(SceneData::list("sparks", &[Part::Camera], |_| vec![Spark::default()]))
        .scene_data(SceneData::record("first", &[], |_| Spark::default()));
    render_text(&Registry::new(vec![plugin], Vec::new(), &Library::default()).mistakes(), false)
}

#[test]
fn a_shader_that_agrees_is_accepted() {
    assert_eq!(mistakes(SPARK), "");
    // Padding may be written out.
    assert_eq!(mistakes(&SPARK.replace("color: vec3<f32> }", "color: vec3<f32>, padding: f32 }")), "");
}

#[test]
fn a_shader_that_does_not_agree_is_refused() {
    let both = 2;
    for (from, to, expected, count) in [
        ("count: u32, color", "sum: u32, color", "expected `count: u32` at byte 12, found `sum: u32` at byte 12", both),
        (
            "position: vec3<f32>",
            "position: vec4<f32>",
            "expected `position: vec3<f32>` at byte 0, found `position: vec4<f32>`",
            both,
        ),
        (
            ", color: vec3<f32> }",
            ", color: vec3<f32>, more: vec4<f32> }",
            "expected the end of `Spark`, found `more: vec4<f32>`",
            both,
        ),
        (", color: vec3<f32> }", ", color: vec3<f32>, pad: vec4<f32> }", "expected 32 bytes, found 48", both),
        (
            "pad2: u32, items",
            "pad2: u32, pad3: u32, items",
            "it is a `count: u32`, padding to 16 bytes, and `items: array<Spark>`",
            1,
        ),
        ("pad2: u32, items: array<Spark>", "pad2: u32, items: array<Spark, 4>", "it is a `count: u32`", 1),
    ] {
        assert!(SPARK.contains(from));
        let messages = mistakes(&SPARK.replace(from, to));
        assert_eq!(messages.matches("error[scene-layout]").count(), count, "{to}: {messages}");
        assert!(messages.contains(expected), "{to}: {messages}");
    }
    let array = SPARK.replace("first: Spark;", "first: array<Spark, 2>;").replace("first.color", "first[0].color");
    assert!(mistakes(&array).contains("expected `Spark`, found `array<Spark, 2>`"), "{}", mistakes(&array));
}
