//! `passes`: what every pass declares; and `new`: files that work as they are.

use serde_json::Value;
use tyndall_tests::Desk;

use crate::run::Program;

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
        for limit in pass["limits"].as_array().unwrap() {
            assert!(page.contains(&format!("  {}: ", limit["scene"].as_str().unwrap())), "{name}: {limit}");
        }
    }
    let tables = desk.ends(0, &["passes", "surface_radiance.lobes"]).out;
    assert!(
        tables.contains(&format!("tables of {} shininesses", tyndall_surface_radiance::SHININESSES_MAX)),
        "{tables}"
    );
    assert!(tables.contains(&format!("tables of {} spots", tyndall_surface_radiance::SPOTS_MAX)), "{tables}");
    let phong = desk.ends(0, &["passes", "surface_radiance.phong"]).out;
    assert!(phong.contains("needs the input table"), "{phong}");
}

/// A table for each, as many as there can be; of more it is told which stand for all.
#[test]
fn more_lobes_than_tables_are_told() {
    let desk = Desk::new();
    let fog = tyndall_tests::shipped("fog");
    let warned = |count: usize| {
        let ball = |i: usize| {
            format!("(mesh: Sphere(radius: 0.1), material: (specular: (0.1, 0.1, 0.1), shininess: {}))", i + 1)
        };
        let spot = |i: usize| {
            format!("Spot(position: (0, 2, 0), direction: (0, -1, 0), intensity: (1, 1, 1), exponent: {})", i + 1)
        };
        let all = |one: &dyn Fn(usize) -> String, count| (0..count).map(one).collect::<Vec<_>>().join(", ");
        let (balls, spots) =
            (tyndall_surface_radiance::SHININESSES_MAX + count, tyndall_surface_radiance::SPOTS_MAX + count);
        let scene = format!(
            "(camera: (position: (0, 1, 5), look_at: (0, 1, 0)), medium: (extinction: (0.1, 0.1, 0.1)), lights: [{}], objects: [{}])",
            all(&spot, spots),
            all(&ball, balls)
        );
        desk.put("many.scene.ron", &scene);
        let ended = desk.ends(0, &["render", fog.to_str().unwrap(), "--scene", "many.scene.ron", "--size", "8x6"]);
        ["has more: 23 between", "the first 8 stand for them"].map(|text| ended.err.contains(text))
    };
    assert_eq!((warned(0), warned(1)), ([false, false], [true, true]));
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
