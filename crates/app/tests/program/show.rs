//! `show` and `explain`: the plan in every form.

use serde_json::Value;

use crate::run::Desk;

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
