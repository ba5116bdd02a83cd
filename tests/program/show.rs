//! `show` and `explain`: the plan in every form.

use serde_json::Value;
use tyndall_tests::{Desk, shipped};

use crate::run::Program;

#[test]
fn every_form_names_every_pass() {
    let desk = Desk::new();
    let text = desk.ends(0, &["show", "fog.graph.ron"]).out;
    desk.ends(0, &["show", "fog.graph.ron", "--svg", "a.svg", "--dot", "a.dot", "--json", "a.json"]);
    let [svg, dot, json] = ["a.svg", "a.dot", "a.json"].map(|name| std::fs::read_to_string(desk.path(name)).unwrap());
    for pass in ["surfaces", "lit", "air", "fogged", "display"] {
        for (form, text) in [("text", &text), ("svg", &svg), ("dot", &dot), ("json", &json)] {
            assert!(text.contains(pass), "{pass} is not in the {form}");
        }
    }
    assert!(svg.starts_with("<svg") && svg.trim_end().ends_with("</svg>"));
    assert!(dot.starts_with("digraph"));
    let _: Value = serde_json::from_str(&json).unwrap();
}

#[test]
fn showing_is_repeatable() {
    let desk = Desk::new();
    let once = desk.ends(0, &["show", "fog.graph.ron"]).out;
    assert_eq!(desk.ends(0, &["show", "fog.graph.ron"]).out, once);
}

#[test]
fn passes_and_ports_are_explained_and_others_refused() {
    let desk = Desk::new();
    for name in ["air", "air.radiance", "surfaces.depth", "image"] {
        assert!(!desk.ends(0, &["explain", "fog.graph.ron", name]).out.trim().is_empty(), "{name}");
    }
    let ended = desk.ends(2, &["explain", "fog.graph.ron", "aire"]);
    assert!(ended.err.contains("aire"), "{}", ended.err);
}

#[test]
fn a_culled_pass_is_explained() {
    let desk = Desk::new();
    let graph = std::fs::read_to_string(desk.path("fog.graph.ron")).unwrap();
    let with =
        graph.replace("        \"display\"", "        \"unused\": (use: \"core.constant\"),\n        \"display\"");
    desk.put("culled.graph.ron", &with);
    let text = desk.ends(0, &["show", "culled.graph.ron"]).out;
    assert!(text.contains("unused"), "{text}");
    assert!(desk.ends(0, &["explain", "culled.graph.ron", "unused"]).out.contains("unused"));
}

#[test]
fn a_pixel_is_probed() {
    let desk = Desk::new();
    let ended = desk.ends(0, &["probe", "fog.graph.ron", "surfaces.depth", "8,11", "--size", "16x12"]);
    assert!(ended.out.contains("surfaces.depth") && ended.out.contains('m'), "{}", ended.out);
    desk.ends(2, &["probe", "fog.graph.ron", "surfaces.depth", "16,0", "--size", "16x12"]);
}

/// In textures and in buffers, on the terminal and in files.
#[test]
fn whole_numbers_beyond_those_of_floats_survive() {
    let desk = Desk::new();
    desk.put(
        "plugins/count/plugin.ron",
        r#"(name: "count", version: "0.1.0", about: "counts", passes: { "count": (about: "counts", shader: "count.wgsl",
            ports: { "words": (about: "texels", size: Fixed(2, 1)), "list": (about: "elements", size: Fixed(2)) }) })"#,
    );
    desk.put(
        "plugins/count/count.wgsl",
        "var words: texture_storage_2d<rgba32uint, write>;
        var<storage, read_write> list: array<u32>;
        @compute @workgroup_size(2) fn main(@builtin(global_invocation_id) id: vec3<u32>) {
            let odd = select(16777217u, 0xffffffffu, id.x == 1u);
            textureStore(words, id.xy, vec4<u32>(odd));
            list[id.x] = odd;
        }",
    );
    let graph = r#"(version: 1, size: (2, 1), passes: { "c": (use: "count.count") },
        outputs: { "words": "c.words", "list": "c.list" })"#;
    desk.put("count.graph.ron", graph);
    let probe = |port: &str, pixel: &str| desk.ends(0, &["probe", "count.graph.ron", port, pixel]).out;
    assert_eq!(probe("c.words", "0,0"), format!("c.words 0,0: {}\n", ["16777217"; 4].join("  ")));
    assert_eq!(probe("c.list", "1,0"), "c.list 1,0: 4294967295\n");
    desk.ends(
        0,
        &[
            "render",
            "count.graph.ron",
            "--output",
            "words=w.exr",
            "--output",
            "list=l.npy",
            "--output",
            "c.words=w.npy",
        ],
    );
    let words = [16_777_217.0, 4_294_967_295.0].map(|word| [word; 4]).concat();
    for file in ["w.exr", "w.npy"] {
        assert_eq!(tyndall_image::read_exact(&desk.path(file)).unwrap().data, words, "{file}");
    }
    let list = std::fs::read(desk.path("l.npy")).unwrap();
    assert!(list.ends_with(&[16_777_217, u32::MAX].map(u32::to_le_bytes).concat()));
    assert!(String::from_utf8_lossy(&list[..64]).contains("'descr': '<u4'"));
}

#[test]
fn what_nobody_asks_for_is_not_drawn() {
    let desk = Desk::new();
    let graph = shipped("aerial-perspective");
    let shown = desk.ends(0, &["show", graph.to_str().unwrap()]).out;
    let culled = shown.split("\nculled\n").nth(1).unwrap_or_else(|| panic!("nothing is culled: {shown}"));
    let first = culled.lines().next().unwrap_or_default();
    assert!(first.contains("transmittance") && first.contains("nothing that was asked for"), "{shown}");
}
