//! Plugins that are folders on disk: outside the repository, over those that are compiled in, and over each other.

use std::path::Path;

use crate::support::{content, executor, gpu, planned, put, registry, run_all, try_registry};
use tempfile::TempDir;
use tyndall_plugin::{Origin, Registry};

/// Files of a plugin `t` with one pass, whose picture is this number everywhere.
fn files(value: &str) -> [(&'static str, String); 2] {
    let manifest = r#"(name: "t", version: "0.1.0", about: "For tests.", passes: {
        "p": (about: "A number.", shader: "p.wgsl", ports: { "color": (about: "The number", size: Frame(1.0)) }),
    })"#;
    let shader = format!(
        "var color: texture_storage_2d<rgba32float, write>;
        @compute @workgroup_size(8, 8) fn main(@builtin(global_invocation_id) id: vec3<u32>) {{
            textureStore(color, id.xy, vec4({value}));
        }}"
    );
    [("plugin.ron", manifest.to_owned()), ("p.wgsl", shader)]
}

fn put_number(plugins: &Path, folder: &str, value: &str) {
    let files = files(value);
    put(plugins, folder, &files.each_ref().map(|(name, text)| (*name, text.as_str())));
}

/// The first number of the picture of a graph of one pass.
fn first_number(registry: &Registry, pass: &str, port: &str) -> f32 {
    let text = format!(
        "(version: 1, size: (2, 2), passes: {{
            \"c\": (use: \"core.constant\", params: {{ \"value\": (1.0, 1.0, 1.0) }}),
            \"p\": (use: {pass}) }}, outputs: {{ \"color\": \"p.{port}\" }})"
    );
    let mut executor = executor(&gpu(), registry, planned(registry, &text, |_, _| ()));
    run_all(&mut executor);
    content(&executor, "color").floats()[0]
}

#[test]
fn a_folder_outside_the_repository_renders() {
    let plugins = TempDir::new().unwrap();
    put_number(plugins.path(), "t", "42.0");
    assert_eq!(first_number(&registry(&[plugins.path()]), "\"t.p\"", "color"), 42.0);
    // The path of the plugin itself does as well.
    assert_eq!(first_number(&registry(&[&plugins.path().join("t")]), "\"t.p\"", "color"), 42.0);
}

#[test]
fn an_earlier_search_path_wins() {
    let (one, two) = (TempDir::new().unwrap(), TempDir::new().unwrap());
    put_number(one.path(), "t", "1.0");
    put_number(two.path(), "other-name-of-the-folder", "2.0");
    assert_eq!(first_number(&registry(&[one.path(), two.path()]), "\"t.p\"", "color"), 1.0);
    assert_eq!(first_number(&registry(&[two.path(), one.path()]), "\"t.p\"", "color"), 2.0);
    // A path that is given twice is one path.
    assert_eq!(first_number(&registry(&[one.path(), one.path()]), "\"t.p\"", "color"), 1.0);
}

#[test]
fn two_on_one_path_are_a_mistake() {
    let plugins = TempDir::new().unwrap();
    put_number(plugins.path(), "a", "1.0");
    put_number(plugins.path(), "b", "2.0");
    let mistakes = try_registry(&[plugins.path()]).err().unwrap();
    assert_eq!(mistakes.iter().map(|mistake| mistake.code.0).collect::<Vec<_>>(), ["duplicate-plugin"]);
}

/// The folder of a plugin that is compiled in, found at run time: its files win, and its passes in Rust stay.
#[test]
fn a_folder_replaces_the_files_of_a_crate() {
    let plugins = TempDir::new().unwrap();
    let core = tyndall_tests::root().join("plugins/core");
    let files = std::fs::read_dir(core).unwrap().map(|entry| entry.unwrap().path());
    for file in files.filter(|file| file.is_file()) {
        let name = file.file_name().unwrap().to_str().unwrap();
        let text =
            std::fs::read_to_string(&file).unwrap().replace("* params.factor, 1.0)", "* params.factor + 10.0, 1.0)");
        put(plugins.path(), "core", &[(name, &text)]);
    }
    let scale = "\"core.scale\", inputs: { \"input\": \"c.color\" }, params: { \"factor\": (3.0, 3.0, 3.0) }";
    assert_eq!(first_number(&registry(&[]), scale, "scaled"), 3.0);
    let replaced = registry(&[plugins.path()]);
    assert_eq!(first_number(&replaced, scale, "scaled"), 13.0);
    for pass in ["core.scale", "core.gbuffer"] {
        assert!(matches!(replaced.pass(pass).unwrap().origin, Origin::Folder(_)), "{pass}");
    }
}
