//! Plugins that are folders with a manifest and WGSL, found at run time and from anywhere.

use std::path::Path;

use tyndall_image::read;

use tyndall_tests::tint::{GRAPH, MANIFEST, SHADER};
use tyndall_tests::{Desk, shipped};

use crate::run::{Ended, Program};

/// A desk with the graph in `here`, and the plugin in `folder`.
fn desk(folder: &str, shader: &str) -> Desk {
    let desk = Desk::new();
    desk.put("here/tint.graph.ron", GRAPH);
    desk.put(&format!("{folder}/tint/plugin.ron"), MANIFEST);
    desk.put(&format!("{folder}/tint/invert.wgsl"), shader);
    desk
}

/// Runs the program in a folder of the desk.
fn run_in(desk: &Desk, folder: &str, arguments: &[&str], variable: Option<&Path>) -> Ended {
    let mut command = desk.command(arguments);
    command.current_dir(desk.path(folder));
    if let Some(value) = variable {
        command.env("TYNDALL_PLUGIN_PATH", value);
    }
    Ended::of(arguments, &command.output().unwrap())
}

#[track_caller]
fn draws(desk: &Desk, folder: &str, more: &[&str], variable: Option<&Path>) {
    let (graph, file) = (desk.path("here/tint.graph.ron"), desk.path("tint.npy"));
    let output = format!("radiance={}", file.display());
    let mut arguments = vec!["render", graph.to_str().unwrap(), "--size", "9x7", "--output", &output];
    arguments.extend(more);
    let ended = run_in(desk, folder, &arguments, variable);
    assert_eq!(ended.code, 0, "{}", ended.err);
    let image = read(&file).unwrap().first_channels(3);
    assert!(image.data.as_chunks::<3>().0.iter().all(|pixel| *pixel == [1.75, 1.5, 1.0]));
}

#[test]
fn a_plugin_is_found_wherever_it_may_be() {
    let beside = desk("here/plugins", SHADER);
    std::fs::create_dir(beside.path("elsewhere")).unwrap();
    draws(&beside, "elsewhere", &[], None);

    let in_the_working_directory = desk("elsewhere/plugins", SHADER);
    draws(&in_the_working_directory, "elsewhere", &[], None);
    let refused = run_in(&in_the_working_directory, "here", &["check", "tint.graph.ron"], None);
    assert!(refused.code == 2 && refused.err.contains("tint.invert"), "{}", refused.err);

    let far = desk("far", SHADER);
    draws(&far, "here", &["--plugin-path", "../far"], None);
    draws(&far, "here", &["--plugin-path", "../far/tint"], None);
    draws(&far, "here", &[], Some(&far.path("far")));
    draws(&far, "here", &[], Some(&far.path("far/tint")));
    let listed = run_in(&far, "here", &["--plugin-path", "../far", "passes", "tint.invert"], None);
    assert!(listed.code == 0 && listed.out.contains("What is missing"), "{}", listed.out);
}

#[test]
fn shipped_graphs_render_from_anywhere() {
    let desk = Desk::new();
    std::fs::create_dir(desk.path("empty")).unwrap();
    let graph = shipped("fog");
    let arguments = ["render", graph.to_str().unwrap(), "--size", "16x9"];
    let ended = run_in(&desk, "empty", &arguments, None);
    assert_eq!(ended.code, 0, "{}", ended.err);
    assert_eq!(desk.files("empty/out").len(), 4);
}

#[test]
fn a_plugin_path_that_holds_none_is_a_mistake() {
    let desk = Desk::new();
    for verb in [&["passes"][..], &["check", "fog.graph.ron"], &["render", "fog.graph.ron"]] {
        let arguments: Vec<&str> = verb.iter().chain(&["--plugin-path", "nowhere"]).copied().collect();
        assert!(desk.ends(2, &arguments).err.contains("nowhere"));
    }
    let ended = run_in(&desk, "", &["passes"], Some(Path::new("no-such-folder")));
    assert!(ended.code == 2 && ended.err.contains("no-such-folder"), "{}", ended.err);
}

/// With a shader that does not compile there is nothing that a machine could run: `render` ends with 3.
#[test]
fn a_mistake_in_a_shader_points_into_it() {
    for (from, to, place, code) in [
        ("params.level - color", "params.level - colour", "invert.wgsl:13:", 3),
        ("id.xy >= textureDimensions(inverted)", "id.xy >= 1.5", "invert.wgsl:9:", 3),
        ("var radiance:", "var radiation:", "invert.wgsl", 3),
        ("texture_storage_2d<rgba32float, write>", "texture_storage_2d<rgba32float, read>", "invert.wgsl", 3),
        // Whichever end is wrong, the default in the manifest is not of the type.
        ("level: f32", "level: vec3<f32>", "plugin.ron:13:", 2),
    ] {
        assert!(SHADER.contains(from));
        let desk = desk("here/plugins", &SHADER.replace(from, to));
        for (verb, code) in [("check", 2), ("render", code)] {
            let ended = desk.ends(code, &[verb, "here/tint.graph.ron"]);
            assert!(ended.err.contains(place), "{to}: {}", ended.err);
        }
    }
}

#[test]
fn broken_manifests_are_mistakes() {
    for manifest in [
        "",
        "(",
        "(name: 1)",
        "(name: \"tint\")",
        &MANIFEST.replace("invert.wgsl", "missing.wgsl"),
        &MANIFEST.replace("\"tint\"", "\"core\""),
    ] {
        let desk = desk("here/plugins", SHADER);
        desk.put("here/plugins/tint/plugin.ron", manifest);
        let ended = desk.ends(2, &["check", "here/tint.graph.ron"]);
        assert!(ended.err.contains("plugin.ron"), "{manifest}: {}", ended.err);
    }
}

/// One that no graph uses is told by `passes`, which lists the others.
#[test]
fn a_broken_plugin_stops_the_graphs_that_use_it() {
    let shader = SHADER.replace("params.level - color", "params.level - colour");
    for (file, text, place, codes) in [
        ("plugin.ron", "(name: \"tint\",", "plugin.ron:1:", [2, 2]),
        ("invert.wgsl", &shader, "invert.wgsl:13:", [3, 3]),
    ] {
        let desk = desk("plugins", SHADER);
        desk.put(&format!("plugins/tint/{file}"), text);
        desk.ends(0, &["check", "fog.graph.ron"]);
        desk.ends(0, &["render", "fog.graph.ron", "--size", "8x6"]);
        desk.ends(0, &["passes", "core.add"]);
        assert!(desk.ends(2, &["check", "here/tint.graph.ron"]).err.contains(place));
        assert!(desk.ends(codes[0], &["render", "here/tint.graph.ron", "--size", "8x6"]).err.contains(place));
        for arguments in [&["passes"][..], &["passes", "--json"], &["passes", "tint.invert"]] {
            let listed = desk.ends(codes[1], arguments);
            assert!(listed.err.contains(place), "{}", listed.err);
            assert_eq!(listed.out.contains("core.add"), arguments.len() == 1 || arguments[1] == "--json");
        }
    }
}
