//! `passes`: what every pass declares; and `new`: files that work as they are.

use serde_json::Value;

use crate::run::Desk;

#[test]
fn every_pass_is_documented() {
    let desk = Desk::new();
    let list = desk.ends(0, &["passes"]).out;
    let json: Vec<Value> = serde_json::from_str(&desk.ends(0, &["passes", "--json"]).out).unwrap();
    assert!(json.len() >= 9, "only {} passes", json.len());
    for pass in &json {
        let name = pass["name"].as_str().unwrap();
        assert!(list.contains(name));
        assert!(!pass["about"].as_str().unwrap().is_empty(), "{name} says nothing of itself");
        let page = desk.ends(0, &["passes", name]).out;
        for kind in ["inputs", "outputs", "params"] {
            for entry in pass[kind].as_array().unwrap() {
                let entry_name = entry["name"].as_str().unwrap();
                assert!(page.contains(entry_name), "{name}: {entry_name} is not on its page");
                assert!(!entry["about"].as_str().unwrap().is_empty(), "{name}.{entry_name} says nothing of itself");
            }
        }
        assert!(!pass["outputs"].as_array().unwrap().is_empty(), "{name} has no output");
    }
}

#[test]
fn an_unknown_pass_is_refused_with_a_near_name() {
    let ended = Desk::new().ends(2, &["passes", "airlight.homogenous"]);
    assert!(ended.err.contains("airlight.homogeneous"), "{}", ended.err);
}

#[test]
fn new_files_render_as_they_are() {
    let desk = Desk::new();
    desk.ends(0, &["new", "graph", "mine"]);
    desk.ends(0, &["check", "mine.graph.ron"]);
    desk.ends(0, &["render", "mine.graph.ron", "--size", "16x12"]);
    assert!(!desk.files("out").is_empty());
    desk.ends(2, &["new", "graph", "mine"]);
    desk.ends(0, &["new", "scene", "other"]);
    desk.ends(0, &["render", "mine.graph.ron", "--scene", "other.scene.ron", "--size", "16x12"]);
    let written = std::fs::read_to_string(desk.path("other.scene.ron")).unwrap();
    desk.ends(2, &["new", "scene", "other"]);
    assert_eq!(std::fs::read_to_string(desk.path("other.scene.ron")).unwrap(), written);
}
