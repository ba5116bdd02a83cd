//! What a manifest says of scenes that a pass does not do justice to, and of what it runs over.

use std::sync::Arc;

use tyndall_document::render_text;
use tyndall_plugin::{Folder, Registry, SceneFeature};
use tyndall_shader::Library;

const SHADER: &str = "var result: texture_storage_2d<rgba32float, write>;
@compute @workgroup_size(8, 8) fn main(@builtin(global_invocation_id) id: vec3<u32>) {
    textureStore(result, id.xy, vec4<f32>(1.0));
}";

fn registry(limits: &str) -> Result<Registry, Arc<str>> {
    let manifest = format!(
        "(name: \"test\", version: \"0.1.0\", about: \"For tests.\", passes: {{
    \"fill\": (about: \"Fills.\", shader: \"pass.wgsl\", limits: {limits},
        ports: {{ \"result\": (about: \"Ones\", size: Frame(1.0)) }}),
}})"
    );
    let folder = Folder::embedded("test", &[("plugin.ron", &manifest), ("pass.wgsl", SHADER)]);
    let registry = Registry::new(Vec::new(), vec![folder], &Library::default(), &[]);
    let mistakes = registry.mistakes();
    if mistakes.is_empty() { Ok(registry) } else { Err(render_text(&mistakes, false).into()) }
}

#[test]
fn limits_are_read() {
    let registry = registry("[Spot(\"dark\"), SeveralShininesses(\"one\")]").unwrap_or_else(|text| panic!("{text}"));
    let limits = &registry.pass("test.fill").expect("it was registered").limits;
    let found: Vec<_> = limits.iter().map(|limit| (limit.feature, limit.text.as_str())).collect();
    assert_eq!(found, [(SceneFeature::Spot, "dark"), (SceneFeature::SeveralShininesses, "one")]);
}

#[test]
fn mistakes_have_a_place_and_a_hint() {
    for (limits, expected) in [
        ("[Spott(\"dark\")]", "error[unknown-variant]: `Spott` is not something that a scene can have"),
        ("[Spott(\"dark\")]", "plugin.ron:2:61"),
        ("[Spott(\"dark\")]", "did you mean `Spot`?"),
        ("[Spot]", "error[wrong-type]: expected `Spot(\"what the pass does instead\")`"),
        ("[Spot(3)]", "error[wrong-type]: expected a string, found the number 3"),
        ("(1, 2)", "error[wrong-type]: expected a list"),
        ("[], dispatch: (0, 3)", "error[wrong-type]: expected the name of a port, or numbers of threads: (x, y, z)"),
        ("[], dispatch: 1.5", "error[wrong-type]: expected the name of a port, or numbers of threads: (x, y, z)"),
    ] {
        let text = registry(limits).err().unwrap_or_else(|| panic!("{limits} is accepted"));
        assert!(text.contains(expected), "{limits}: {text}");
    }
}
