//! What the linker finds in shaders that are right.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

use std::sync::Arc;

use tyndall_document::{Place, Source, render_text};
use tyndall_graph::descriptor::{Class, Dimension, Format, PortKind, Scalar};
use tyndall_shader::*;

mod descriptor;

fn library() -> Library {
    let mut library = Library::default();
    library.insert("sample", Source::new("sample.wgsl", SAMPLE));
    library
}

/// A shared module: it declares more than anybody uses.
const SAMPLE: &str = "
struct Camera { position: vec3<f32>, time: f32, up: vec3<f32>, }
var<uniform> camera: Camera;
var<storage, read> lights: array<vec4<f32>>;
override spare: f32 = 2.0;
override steps: u32;
fn inner(t: texture_2d<f32>, s: sampler, at: vec2<f32>) -> vec4<f32> { return textureSampleLevel(t, s, at, 0.0); }
fn outer(t: texture_2d<f32>, s: sampler) -> vec4<f32> { return inner(t, s, vec2(0.5)) * f32(steps); }
";

fn linked(text: &str) -> Linked {
    match link(&Source::new("pass.wgsl", text), &library()) {
        Ok(linked) => linked,
        Err(problems) => panic!("{}", render_text(&problems, false)),
    }
}

fn names(linked: &Linked) -> Vec<(&str, u32)> {
    linked.resources.iter().map(|resource| (resource.name.as_str(), resource.binding)).collect()
}

fn is_filtered(linked: &Linked, name: &str) -> bool {
    matches!(linked.resource(name).unwrap().kind, ResourceKind::Texture { filtered: true, .. })
}

#[test]
fn what_is_not_used_is_not_bound() {
    let linked = linked(
        "#import sample\nvar idle: texture_2d<f32>;\nvar a: texture_2d<f32>;\nvar b: texture_storage_2d<r32float, write>;\n\
         @compute @workgroup_size(4, 2) fn main() { textureStore(b, vec2(0), textureLoad(a, vec2(0), 0)); }",
    );
    assert_eq!(names(&linked), [("a", 0), ("b", 1)]);
    assert!(linked.params.is_empty(), "unused overrides of a module are not parameters");
    assert_eq!(linked.unused.iter().map(|unused| unused.name.as_str()).collect::<Vec<_>>(), ["idle"]);
    assert_eq!(linked.module.global_variables.len(), 2);
    let entry = &linked.entry_points[0];
    assert_eq!(
        (entry.name.as_str(), entry.workgroup_size, entry.resources.as_slice()),
        ("main", [4, 2, 1], &[0, 1][..])
    );
    assert!(linked.resource("b").unwrap().written && !linked.resource("b").unwrap().read);
}

#[test]
fn every_format_but_that_of_depth_is_stored_under_its_name() {
    for format in Format::ALL.iter().filter(|format| **format != Format::Depth32Float) {
        let texel = if format.scalar() == Scalar::U32 { "vec4<u32>(1u)" } else { "vec4<f32>(1.0)" };
        let linked = linked(&format!(
            "var o: texture_storage_2d<{format}, write>;\n\
             @compute @workgroup_size(1) fn main() {{ textureStore(o, vec2(0), {texel}); }}"
        ));
        let kind = &linked.resource("o").unwrap().kind;
        assert!(matches!(kind, ResourceKind::StorageTexture { format: found, .. } if found == format), "{format}");
    }
}

#[test]
fn only_what_a_filtering_sampler_samples_is_filtered() {
    let linked = linked(
        "#import sample\nvar a: texture_2d<f32>;\nvar b: texture_2d<f32>;\nvar c: texture_2d<f32>;\nvar linear_clamp: sampler;\n\
         var nearest_clamp: sampler;\nvar<storage, read_write> o: array<vec4<f32>>;\n\
         @compute @workgroup_size(1) fn main() { o[0] = outer(a, linear_clamp) + outer(b, nearest_clamp) + textureLoad(c, vec2(0), 0); }",
    );
    assert!(is_filtered(&linked, "a"), "through two calls");
    assert!(!is_filtered(&linked, "b") && !is_filtered(&linked, "c"));
    let filtering = |name| matches!(linked.resource(name).unwrap().kind, ResourceKind::Sampler { filtering: true, .. });
    assert!(filtering("linear_clamp") && !filtering("nearest_clamp"));
    let steps = linked.param("steps").unwrap();
    assert_eq!((steps.kind, steps.source), (ParamKind::Uint, ParamSource::Override { default: None }));
}

#[test]
fn parameters_have_their_offsets_defaults_and_places() {
    let text = "struct Params { on: u32, tint: vec3<f32>, count: i32 }\nvar<uniform> params: Params;\noverride gain = 2.5;\n\
        override on_too: bool = false;\noverride twice = gain * 2.0;\nvar<storage, read_write> o: array<f32>;\n\
        @compute @workgroup_size(1) fn main() { if on_too { o[0] = params.tint.y * gain * twice + f32(params.count); } }";
    let linked = linked(text);
    let found: Vec<_> = linked.params.iter().map(|p| (p.name.as_str(), p.kind, p.source, p.used)).collect();
    let default = |value| ParamSource::Override { default: Some(value) };
    assert_eq!(
        found,
        [
            ("on", ParamKind::Uint, ParamSource::Uniform { offset: 0 }, false),
            ("tint", ParamKind::Vector(3), ParamSource::Uniform { offset: 16 }, true),
            ("count", ParamKind::Int, ParamSource::Uniform { offset: 28 }, true),
            ("gain", ParamKind::Float, default(ParamDefault::Float(2.5)), true),
            ("on_too", ParamKind::Bool, default(ParamDefault::Bool(false)), true),
        ]
    );
    let Place::Text { source, span } = &linked.param("tint").unwrap().place else { panic!("no place") };
    assert_eq!((source.slice(*span), source.line_column(span.start)), ("tint", (1, 26)));
}

#[test]
fn a_parameter_block_that_is_passed_on_counts_as_read() {
    let linked = linked(
        "struct Params { a: f32, b: f32 }\nvar<uniform> params: Params;\nvar<storage, read_write> o: array<f32>;\n\
         fn f(p: Params) -> f32 { return p.b; }\n@compute @workgroup_size(1) fn main() { o[0] = f(params); }",
    );
    assert!(linked.params.iter().all(|param| param.used));
}

#[test]
fn ports_are_derived() {
    let linked = linked(
        "struct Node { next: u32, at: vec3<f32> }\nvar color: texture_2d<f32>;\nvar volume: texture_3d<f32>;\nvar ids: texture_2d<u32>;\n\
         var a: texture_storage_2d<r32float, write>;\nvar b: texture_storage_2d_array<rgba16float, write>;\n\
         var c: texture_storage_2d<r32uint, read_write>;\nvar<storage, read_write> nodes: array<Node>;\n\
         var<storage, read_write> count: atomic<u32>;\nvar<uniform> mean: vec4<f32>;\n\
         @compute @workgroup_size(1) fn main() { nodes[0].next = atomicAdd(&count, textureLoad(ids, vec2(0), 0).x);\n\
         textureStore(a, vec2(0), textureLoad(color, vec2(0), 0) + mean + textureLoad(volume, vec3(0), 0));\n\
         textureStore(b, vec2(0), 0, vec4(0.0)); textureStore(c, vec2(0), textureLoad(c, vec2(1))); }",
    );
    let texture = |dimension, class, format| PortKind::Texture { dimension, class, format, filtered: false };
    let expected = [
        ("color", true, false, texture(Dimension::D2, Class::Color, None)),
        ("volume", true, false, texture(Dimension::D3, Class::Data, None)),
        ("ids", true, false, texture(Dimension::D2, Class::Data, None)),
        ("a", false, true, texture(Dimension::D2, Class::Scalar, Some(Format::R32Float))),
        ("b", false, true, texture(Dimension::D2Array, Class::Data, Some(Format::Rgba16Float))),
        ("c", true, true, texture(Dimension::D2, Class::Data, Some(Format::R32Uint))),
        ("nodes", false, true, PortKind::Buffer { element: "Node".into(), stride: 32 }),
        ("count", true, true, PortKind::Value { element: "u32".into(), bytes: 4 }),
        ("mean", true, false, PortKind::Value { element: "vec4<f32>".into(), bytes: 16 }),
    ];
    let names: Vec<_> = expected.iter().map(|(name, ..)| *name).chain(["absent"]).collect();
    let ports = reflect_ports(&linked, &names).unwrap();
    let found: Vec<_> = ports.into_iter().map(|port| (port.name, port.readable, port.writable, port.kind)).collect();
    assert_eq!(found, expected.map(|(name, readable, writable, kind)| (name.to_owned(), readable, writable, kind)));
}

#[test]
fn layouts_of_a_module_can_be_read() {
    let linked = linked("#import sample\n");
    let found: Vec<_> = members(&linked.module, "Camera").into_iter().map(|m| (m.name, m.offset, m.size)).collect();
    assert_eq!(found, [("position".into(), 0, 12), ("time".into(), 12, 4), ("up".into(), 16, 12)]);
    assert!(members(&linked.module, "Nothing").is_empty());
}

#[test]
fn the_fingerprint_is_of_what_is_used_of_all_files() {
    let text = "#import sample\nvar x: texture_2d<f32>; var y: sampler; var z: texture_storage_2d<r32float, write>;
        @compute @workgroup_size(1) fn main() { textureStore(z, vec2(0), outer(x, y)); }";
    let with = |sample: String| {
        let mut library = Library::default();
        library.insert("sample", Source::new("sample.wgsl", sample));
        link(&Source::new("pass.wgsl", text), &library).unwrap().fingerprint
    };
    let first = linked(text).fingerprint;
    assert_eq!(first, with(SAMPLE.to_owned()));
    assert_eq!(first, with(format!("// Nothing new.\n{SAMPLE} fn idle() -> u32 {{ return steps; }}")));
    assert_eq!(first, with(SAMPLE.replace("spare: f32 = 2.0", "spare: f32 = 3.0")));
    assert_ne!(first, with(SAMPLE.replace("vec2(0.5)", "vec2(0.25)")));
    let files: Vec<_> = linked(text).sources().map(|source| source.name().to_owned()).collect();
    assert_eq!(files, ["pass.wgsl", "sample.wgsl"]);
}

#[test]
fn several_shaders_together_make_a_pass() {
    let (mut library, descriptor) = (Library::default(), descriptor::descriptor());
    library.insert_file(
        "p.wgsl",
        Source::new("p.wgsl", "struct Params { exposure: f32 }\nvar<uniform> params: Params;\n"),
    );
    let link = |text: &str| link(&Source::new("pass.wgsl", text), &library).unwrap();
    let first = link(
        "var depth: texture_2d<f32>;\nvar<uniform> camera: vec4<f32>;\nvar radiance: texture_storage_2d<rgba32float, write>;\n\
         @compute @workgroup_size(1) fn main() { textureStore(radiance, vec2(0), camera * textureLoad(depth, vec2(0), 0)); }",
    );
    let second = link(
        "#import \"p.wgsl\"\noverride nodes: i32;\nvar<storage, read> lights_found: array<u32>;\nvar radiance: texture_2d<f32>;\n\
         var<storage, read_write> scratch: array<f32>;\n@compute @workgroup_size(1) fn main() { let x = lights_found[nodes];\n\
         scratch[x] = params.exposure * textureLoad(radiance, vec2(0), 0).x; }",
    );
    let report = |shaders: &[&Linked], private: &[&str]| -> Vec<String> {
        check_all(shaders, &descriptor, descriptor::SCENE, private).into_iter().map(|problem| problem.message).collect()
    };
    assert!(report(&[&first, &second], &["scratch"]).is_empty(), "{:?}", report(&[&first, &second], &["scratch"]));
    assert_eq!(report(&[&first, &second], &[]).len(), 1, "scratch is not known");
    assert!(report(&[&second], &["scratch"]).iter().any(|message| message.contains("never writes to it")));
}

#[test]
fn a_fragment_shader_writes_ports_by_member() {
    let linked = linked(
        "struct Out { @location(0) normal: vec4<f32>, @location(1) ids: u32 }\n\
         @vertex fn corner(@builtin(vertex_index) i: u32) -> @builtin(position) vec4<f32> { return vec4(f32(i)); }\n\
         @fragment fn shade() -> Out { return Out(vec4(1.0), 2u); }",
    );
    let targets = &linked.entry_points[1].targets;
    let found: Vec<_> = targets.iter().map(|t| (t.name.as_str(), t.location, t.class)).collect();
    assert_eq!(found, [("normal", 0, SampleClass::Float), ("ids", 1, SampleClass::Uint)]);
}

#[test]
fn lines_and_columns_are_those_of_the_file() {
    let text = "#import sample // with a comment\n\n/* é */ fn f() -> f32 { return undefined; }\n";
    let problems = link(&Source::new("pass.wgsl", text), &library()).unwrap_err();
    assert_eq!(problems[0].place.line_column(), Some((3, 32)));
}

#[test]
fn a_root_of_the_library_is_not_joined_to_itself() {
    let mut library = Library::default();
    let root = Source::new("a.wgsl", "#import \"b.wgsl\"\nfn a() -> f32 { return b(); }");
    library.insert_file("a.wgsl", Arc::clone(&root));
    library.insert_file("b.wgsl", Source::new("b.wgsl", "fn b() -> f32 { return 1.0; }"));
    assert!(link(&root, &library).is_ok());
    library.insert_file("b.wgsl", Source::new("b.wgsl", "#import \"a.wgsl\"\nfn b() -> f32 { return 1.0; }"));
    assert_eq!(link(&root, &library).unwrap_err()[0].code.0, "shader-import-cycle");
}
