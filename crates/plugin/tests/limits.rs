//! What a manifest says of scenes that a pass does not do justice to, and of what it runs over.

use std::sync::Arc;

use tyndall_document::render_text;
use tyndall_plugin::{Folder, Limit, Plugin, Registry};
use tyndall_shader::Library;

const SHADER: &str = "var result: texture_storage_2d<rgba32float, write>;
@compute @workgroup_size(8, 8) fn main(@builtin(global_invocation_id) id: vec3<u32>) {
    textureStore(result, id.xy, vec4<f32>(1.0));
}";

/// The plugin `test`, a crate's where it `brings` features, and a folder without Rust else.
fn registry_of(brings: &[&'static str], limits: &str) -> Result<Registry, Arc<str>> {
    let manifest = format!(
        "(name: \"test\", version: \"0.1.0\", about: \"For tests.\", passes: {{
    \"fill\": (about: \"Fills.\", shader: \"pass.wgsl\", limits: {limits},
        ports: {{ \"result\": (about: \"Ones\", size: Frame(1.0)) }}),
}})"
    );
    let folder = Folder::embedded("test", &[("plugin.ron", &manifest), ("pass.wgsl", SHADER)]);
    let bring = |plugin: Plugin, name: &&'static str| plugin.scene_feature(name, |scene| scene.lights.len() > 2);
    let other = Folder::embedded("other", &[("plugin.ron", OTHER)]);
    let mut plugins = vec![Plugin::new("other", other).scene_feature("ThreeLights", |scene| scene.lights.len() > 2)];
    let mut folders = Vec::new();
    match brings {
        [] => folders.push(folder),
        brings => plugins.push(brings.iter().fold(Plugin::new("test", folder), bring)),
    }
    let registry = Registry::new(plugins, folders, &Library::default());
    let mistakes = registry.mistakes();
    if mistakes.is_empty() { Ok(registry) } else { Err(render_text(&mistakes, false).into()) }
}

fn registry(limits: &str) -> Result<Registry, Arc<str>> {
    registry_of(&[], limits)
}

const OTHER: &str = "(name: \"other\", version: \"0.1.0\", about: \"Brings a feature.\", passes: {})";

fn messages_of(limits: &[Limit]) -> Vec<(&str, &str)> {
    limits.iter().map(|limit| (limit.feature.name, limit.text.as_str())).collect()
}

/// A manifest names the scene's own features, its plugin's, and those of other plugins.
#[test]
fn limits_are_read() {
    for brings in [vec![], vec!["ManyLights"], vec!["ManyLights", "ThreeLights"]] {
        let limits = "[Spot(\"dark\"), ThreeLights(\"two\")], refuses: [Medium(\"is for clear air only\")]";
        let registry = registry_of(&brings, limits).unwrap_or_else(|text| panic!("{brings:?}: {text}"));
        let pass = registry.pass("test.fill").expect("it was registered");
        assert_eq!(messages_of(&pass.limits), [("Spot", "dark"), ("ThreeLights", "two")]);
        assert_eq!(messages_of(&pass.refuses), [("Medium", "is for clear air only")]);
    }
    assert!(registry_of(&["ManyLights"], "[ManyLights(\"dark\")]").is_ok());
}

#[test]
fn mistakes_have_a_place_and_a_hint() {
    for (limits, expected) in [
        ("[Spott(\"dark\")]", "error[unknown-variant]: `Spott` is not something that a scene can have"),
        ("[Spott(\"dark\")]", "plugin.ron:2:61"),
        ("[Spott(\"dark\")]", "did you mean `Spot`?"),
        ("[ManyLights(\"dark\")]", "help: available: `Point`, `Spot`, `Directional`, `Medium`, `ThreeLights`"),
        ("[Spot]", "error[wrong-type]: expected `Spot(\"the message\")`"),
        ("[Spot(3)]", "error[wrong-type]: expected a string, found the number 3"),
        ("(1, 2)", "error[wrong-type]: expected a list"),
        ("[], dispatch: (0, 3)", "error[wrong-type]: expected the name of a port, or numbers of threads: (x, y, z)"),
        ("[], dispatch: 1.5", "error[wrong-type]: expected the name of a port, or numbers of threads: (x, y, z)"),
    ] {
        let text = registry(limits).err().unwrap_or_else(|| panic!("{limits} is accepted"));
        assert!(text.contains(expected), "{limits}: {text}");
    }
}
