//! Every code has a fixture that pins its text and position: a manifest, beside the shader below.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use tyndall_document::{BAD_SIZE, BAD_VERSION, Code, Diagnostics, OUT_OF_RANGE, Source, fixture};
use tyndall_graph::codes::UNKNOWN_CHOICE;
use tyndall_plugin::scene::SceneData;
use tyndall_plugin::{CODES, Folder, Plugin, Registry, SearchPath, find_folders};
use tyndall_shader::Library;

const SHADER: &str = "struct Params {
    factor: f32,
    curve: u32,
}
var<uniform> params: Params;
var input: texture_2d<f32>;
var scaled: texture_storage_2d<rgba32float, write>;
@compute @workgroup_size(8, 8) fn main(@builtin(global_invocation_id) id: vec3<u32>) {
    textureStore(scaled, id.xy, params.factor * f32(params.curve) * textureLoad(input, id.xy, 0));
}";

/// Reads the scene data `glow`, which are a list of `f32`, as another list.
const GLOW_SHADER: &str = "struct Glow {
    count: u32,
    pad0: u32,
    pad1: u32,
    pad2: u32,
    items: array<vec2<f32>>,
}
var<storage, read> glow: Glow;
var scaled: texture_storage_2d<rgba32float, write>;
@compute @workgroup_size(8, 8) fn main(@builtin(global_invocation_id) id: vec3<u32>) {
    textureStore(scaled, id.xy, vec4<f32>(glow.items[0], 0.0, 1.0));
}";

/// A plugin that brings the scene data `glow`.
fn glowing(name: &str, folder: Folder) -> Plugin {
    Plugin::new(name, folder).scene_data(SceneData::list("glow", &[], |_| vec![1.0f32]))
}

/// A first line `// twice` gives the manifest to two plugins, `// clash` to one that brings the scene data of another;
/// `// --plugin-path PATH` looks there instead.
fn run(source: &Arc<Source>) -> Diagnostics {
    let mut out = Diagnostics::default();
    let text = source.text();
    let first = text.lines().next().unwrap_or_default();
    if let Some(path) = first.strip_prefix("// --plugin-path ") {
        out.extend(find_folders(&[SearchPath { path: PathBuf::from(path), required: true }]).err().unwrap_or_default());
        return out;
    }
    let folder =
        |name: &str| Folder::embedded(name, &[("plugin.ron", text), ("pass.wgsl", SHADER), ("glow.wgsl", GLOW_SHADER)]);
    let nothing = "(name: \"glow\", version: \"0.1.0\", about: \"Brings scene data.\")";
    let mut crates = vec![glowing("glow", Folder::embedded("glow", &[("plugin.ron", nothing)]))];
    let mut folders = Vec::new();
    match first {
        "// twice" => folders.extend([folder("test"), folder("again")]),
        "// clash" => crates.push(glowing("test", folder("test"))),
        _ => folders.push(folder("test")),
    }
    out.extend(Registry::new(crates, folders, &Library::default()).mistakes());
    out
}

#[test]
fn every_code_has_its_text() {
    const ALSO: &[Code] = &[BAD_SIZE, BAD_VERSION, OUT_OF_RANGE, UNKNOWN_CHOICE];
    fixture::check(Path::new("tests/fixtures"), &[CODES, ALSO].concat(), &run);
}

/// The manifest that the fixtures are mistakes of has none.
#[test]
fn the_right_manifest_is_accepted() {
    let text = include_str!("fixtures/right/plugin.ron");
    assert!(run(&Source::new("plugin.ron", text)).is_empty());
}
