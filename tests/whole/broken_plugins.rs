//! A broken plugin stops the graphs that use it, with its own mistakes, and no others.

use std::path::Path;

use crate::support::{put, shipped, unchecked_registry};
use tempfile::TempDir;
use tyndall_document::{Diagnostics, Source, render_text};
use tyndall_graph::{Overrides, read, validate};
use tyndall_plugin::{Folder, Plugin, Registry};
use tyndall_shader::Library;

const MANIFEST: &str = r#"(name: "t", version: "0.1.0", about: "For tests.", passes: {
    "p": (about: "One.", shader: "p.wgsl", ports: { "color": (about: "One", size: Frame(1.0)) }),
    "q": (about: "Two.", shader: "q.wgsl", ports: { "color": (about: "Two", size: Frame(1.0)) }),
})"#;

const SHADER: &str = "var color: texture_storage_2d<rgba32float, write>;
@compute @workgroup_size(8, 8) fn main(@builtin(global_invocation_id) id: vec3<u32>) {
    textureStore(color, id.xy, vec4(1.0));
}";

/// The mistakes of a graph that uses one pass.
fn mistakes(registry: &Registry, pass: &str) -> String {
    let text = format!("(version: 1, passes: {{ \"a\": (use: \"{pass}\") }}, outputs: {{ \"color\": \"a.color\" }})");
    let mut out = Diagnostics::default();
    let file = read(&Source::new("test.graph.ron", text), &mut out).unwrap();
    let graph = validate(&file, registry.catalogue(), &Overrides::default(), &mut out);
    assert_eq!(graph.is_some(), !out.has_errors());
    render_text(&out, false)
}

/// A folder of plugins with `t`, one of whose files is another.
fn plugins(folder: &str, file: &str, text: &[u8]) -> TempDir {
    let plugins = TempDir::new().unwrap();
    put(plugins.path(), folder, &[("plugin.ron", MANIFEST), ("p.wgsl", SHADER), ("q.wgsl", SHADER)]);
    std::fs::write(plugins.path().join(folder).join(file), text).unwrap();
    plugins
}

fn at(plugins: &TempDir) -> [&Path; 1] {
    [plugins.path()]
}

#[test]
fn a_broken_manifest_stops_whoever_uses_its_plugin() {
    let version = MANIFEST.replace("0.1.0", "one");
    let field = MANIFEST.replace("shader: \"q.wgsl\"", "shadre: \"q.wgsl\"");
    for (manifest, mistake) in [
        ("(", "plugin.ron:1:1"),
        ("", "plugin.ron:1:1"),
        ("(name: 1)", "plugin.ron:1:8"),
        ("(name: \"t\")", "needs the field `version`"),
        (&version, "plugin.ron:1:22"),
        (&field, "plugin.ron:3:"),
        ("\u{1}\u{fffd}", "plugin.ron:1:1"),
    ] {
        let plugins = plugins("t", "plugin.ron", manifest.as_bytes());
        let registry = unchecked_registry(&at(&plugins));
        assert_eq!(mistakes(&registry, "core.constant"), "", "{manifest}");
        for pass in ["t.p", "t.q"] {
            let text = mistakes(&registry, pass);
            assert!(text.contains(mistake) && !text.contains("there is no pass"), "{manifest}: {text}");
        }
        let all = render_text(&registry.mistakes(), false);
        assert!(all.contains(mistake), "{manifest}: {all}");
        assert!(matches!(registry.find("t.p"), Some(Err(_))), "{manifest}");
        assert!(registry.passes().all(|pass| !pass.descriptor.name.starts_with("t.")), "{manifest}");
        assert!(registry.passes().count() > 10, "{manifest}");
    }
}

/// Its folder has another name, so it may be any plugin's.
#[test]
fn a_manifest_without_a_name_is_told_with_what_is_not_found() {
    let plugins = plugins("elsewhere", "plugin.ron", b"(");
    let registry = unchecked_registry(&at(&plugins));
    assert_eq!(mistakes(&registry, "core.constant"), "");
    let text = mistakes(&registry, "t.p");
    assert!(text.contains("there is no pass `t.p`") && text.contains("elsewhere/plugin.ron:1:1"), "{text}");
}

#[test]
fn a_broken_shader_stops_whoever_uses_its_pass() {
    for (shader, place) in [
        ("var color: texture_storage_2d<rgba32float, write>;\nfn main(", "q.wgsl:2:"),
        ("fn other() {}", "plugin.ron:3:"),
        ("#import nowhere", "q.wgsl:1:"),
        ("", "plugin.ron:3:"),
    ] {
        let plugins = plugins("t", "q.wgsl", shader.as_bytes());
        let registry = unchecked_registry(&at(&plugins));
        assert_eq!(mistakes(&registry, "core.constant"), "");
        assert_eq!(mistakes(&registry, "t.p"), "", "{shader}");
        for text in [mistakes(&registry, "t.q"), render_text(&registry.mistakes(), false)] {
            assert!(text.contains(place), "{shader}: {text}");
        }
    }
}

/// Which shaders import it is not known before they are linked.
#[test]
fn a_file_that_cannot_be_read_stops_whoever_uses_its_plugin() {
    for file in ["q.wgsl", "plugin.ron", "unused.wgsl"] {
        let plugins = plugins("t", file, b"\xff\xfe\x80");
        let registry = unchecked_registry(&at(&plugins));
        assert_eq!(mistakes(&registry, "core.constant"), "");
        for text in [mistakes(&registry, "t.p"), render_text(&registry.mistakes(), false)] {
            assert!(text.contains("unreadable-file") && text.contains(file), "{text}");
        }
    }
}

#[test]
fn two_plugins_of_one_name_stop_whoever_uses_one_of_them() {
    let plugins = plugins("a", "p.wgsl", SHADER.as_bytes());
    put(plugins.path(), "b", &[("plugin.ron", MANIFEST), ("p.wgsl", SHADER), ("q.wgsl", SHADER)]);
    let registry = unchecked_registry(&at(&plugins));
    assert_eq!(mistakes(&registry, "core.constant"), "");
    for pass in ["t.p", "t.q", "t.r"] {
        let text = mistakes(&registry, pass);
        assert!(text.contains("duplicate-plugin") && text.contains("b/plugin.ron"), "{text}");
    }
    assert!(render_text(&registry.mistakes(), false).contains("duplicate-plugin"));
}

/// Else the embedded files would silently be drawn with, and not those that somebody is working on.
#[test]
fn a_broken_folder_still_replaces_a_crate() {
    let plugins = TempDir::new().unwrap();
    put(plugins.path(), "core", &[("plugin.ron", "(name: \"core\"")]);
    let registry = unchecked_registry(&at(&plugins));
    for pass in ["core.constant", "core.gbuffer"] {
        let text = mistakes(&registry, pass);
        assert!(text.contains("core/plugin.ron:1:"), "{text}");
    }
    // An earlier path's does as well, and one on a later path is not looked at, but messages.
    let (sound, broken) = (self::plugins("t", "p.wgsl", SHADER.as_bytes()), self::plugins("t", "plugin.ron", b"("));
    let first = unchecked_registry(&[broken.path(), sound.path()]);
    assert!(mistakes(&first, "t.p").contains("plugin.ron:1:1"));
    let second = unchecked_registry(&[sound.path(), broken.path()]);
    assert_eq!(mistakes(&second, "t.p"), "");
    assert!(render_text(&second.mistakes(), false).contains("plugin.ron:1:1"));
}

/// A folder that replaces a crate's plugin, and does not have all its passes.
#[test]
fn a_pass_that_is_missing_is_missing_in_a_file() {
    let plugins = TempDir::new().unwrap();
    let manifest = MANIFEST.replace("\"t\"", "\"core\"");
    put(plugins.path(), "other", &[("plugin.ron", &manifest), ("p.wgsl", SHADER), ("q.wgsl", SHADER)]);
    let registry = unchecked_registry(&at(&plugins));
    assert_eq!(mistakes(&registry, "core.p"), "");
    let text = mistakes(&registry, "core.constant");
    assert!(text.contains("there is no pass `core.constant` in ") && text.contains("other/plugin.ron"), "{text}");
    assert!(mistakes(&registry, "core.gbuffer").contains("missing-shader"));
}

#[test]
fn two_passes_of_one_name_stop_whoever_uses_it() {
    let folder = || Folder::embedded("t", &[("plugin.ron", MANIFEST), ("p.wgsl", SHADER), ("q.wgsl", SHADER)]);
    let crates = vec![Plugin::new("t", folder()), Plugin::new("t", folder())];
    let registry = Registry::new(crates.into_iter().chain(shipped()).collect(), Vec::new(), &Library::default());
    let text = mistakes(&registry, "t.p");
    assert!(text.contains("there already is a pass `t.p`"), "{text}");
}

/// Clones share what is linked, whichever of them links it, in whatever thread.
#[test]
fn a_pass_is_linked_once() {
    let plugins = plugins("t", "p.wgsl", SHADER.as_bytes());
    let registry = unchecked_registry(&at(&plugins));
    let shader = |registry: &Registry| registry.pass("t.p").unwrap().shaders().next().unwrap().1.clone();
    let linked = std::thread::scope(|scope| {
        let threads = [registry.clone(), registry.clone()].map(|registry| scope.spawn(move || shader(&registry)));
        threads.map(|thread| thread.join().unwrap())
    });
    for other in linked {
        assert!(std::sync::Arc::ptr_eq(&shader(&registry), &other));
    }
}
