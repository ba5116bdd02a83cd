//! `check`: mistakes with their places, as text and as JSON.

use serde_json::Value;
use tyndall_tests::Desk;

use crate::run::Program;

const WRONG: &str = r#"(
    version: 1,
    scene: "test.scene.ron",
    passes: {
        "air": (use: "airlight.homogenous"),
        "display": (use: "core.tonemap", inputs: { "radience": "air.radiance" }, params: { "exposure": -1.0 }),
    },
    outputs: { "image": "display.color" },
)"#;

fn mistakes(desk: &Desk, file: &str) -> Vec<Value> {
    let ended = desk.ends(2, &["check", file, "--format", "json"]);
    serde_json::from_str(&ended.out).unwrap_or_else(|error| panic!("{error}: {}", ended.out))
}

#[test]
fn sound_graphs_pass_in_both_forms() {
    let desk = Desk::new();
    desk.ends(0, &["check", "fog.graph.ron"]);
    let ended = desk.ends(0, &["check", "fog.graph.ron", "--format", "json"]);
    let list: Vec<Value> = serde_json::from_str(&ended.out).unwrap();
    assert!(list.iter().all(|mistake| mistake["severity"] != "error"), "{list:?}");
}

#[test]
fn scenes_and_comparisons_are_checked_for_what_they_are() {
    let desk = Desk::new();
    desk.put("s.scene.ron", "(camera: (position: (0, 1, 5), look_at: (0, 1, 0)), lights: [])");
    desk.put(
        "c.compare.ron",
        r#"(version: 1, output: "airlight", size: (8, 6), scenes: { "s": (scene: "s.scene.ron") },
        methods: { "fog": (graph: "fog.graph.ron") })"#,
    );
    let ended = desk.ends(0, &["check", "s.scene.ron", "c.compare.ron", "fog.graph.ron"]);
    assert!(ended.out.contains("3 files without mistakes"), "{}", ended.out);
    desk.put("s.scene.ron", "(camera: (position: (0, 1, 5), look_at: (0, 1, 0)), lihgts: [])");
    let found = mistakes(&desk, "s.scene.ron");
    assert_eq!((found[0]["code"].as_str(), found[0]["line"].as_u64()), (Some("unknown-field"), Some(1)));
    let named = &mistakes(&desk, "c.compare.ron")[0];
    assert_eq!((&named["code"], &named["file"]), (&found[0]["code"], &found[0]["file"]));
    assert_eq!(named["related"][0]["file"].as_str(), Some("c.compare.ron"));
    assert!(desk.ends(2, &["check", "t.test.ron"]).err.contains("`tyndall test t.test.ron`"));
}

#[test]
fn all_mistakes_are_told_in_the_order_of_the_file() {
    let desk = Desk::new();
    desk.put("wrong.graph.ron", WRONG);
    let found = mistakes(&desk, "wrong.graph.ron");
    assert!(found.len() >= 3, "{found:?}");
    let lines: Vec<u64> = found.iter().map(|mistake| mistake["line"].as_u64().unwrap()).collect();
    assert!(lines.is_sorted(), "{lines:?}");
    let first = &found[0];
    assert_eq!((first["line"].as_u64(), first["column"].as_u64()), (Some(5), Some(22)));
    assert_eq!(first["file"], "wrong.graph.ron");
    assert_eq!(first["text"], "\"airlight.homogenous\"");
    assert!(first["suggestion"].as_str().unwrap().contains("airlight.homogeneous"), "{first}");
    for mistake in &found {
        let code = mistake["code"].as_str().unwrap();
        assert!(!code.is_empty() && code.chars().all(|letter| letter.is_ascii_lowercase() || letter == '-'), "{code}");
        assert!(!mistake["message"].as_str().unwrap().is_empty());
    }
    let text = desk.ends(2, &["check", "wrong.graph.ron"]);
    assert!((text.out + &text.err).contains("wrong.graph.ron:5:22"));
}

#[test]
fn several_files_and_their_scenes_are_checked() {
    let desk = Desk::new();
    desk.put("wrong.graph.ron", WRONG);
    desk.put("bad.scene.ron", "(lights: [Point(position: (0.0, NaN, 0.0), intensity: (1.0, 1.0, 1.0))])");
    let graph = std::fs::read_to_string(desk.path("fog.graph.ron")).unwrap();
    desk.put("scene.graph.ron", &graph.replace("test.scene.ron", "bad.scene.ron"));
    let ended = desk.ends(2, &["check", "wrong.graph.ron", "scene.graph.ron", "fog.graph.ron", "--format", "json"]);
    let found: Vec<Value> = serde_json::from_str(&ended.out).unwrap();
    let errors = || found.iter().filter(|mistake| mistake["severity"] == "error");
    let in_file = |name: &str| errors().filter(|mistake| mistake["file"] == name).count();
    assert!(in_file("wrong.graph.ron") >= 3 && in_file("bad.scene.ron") >= 1, "{found:?}");
    assert_eq!(in_file("fog.graph.ron"), 0);
}

#[test]
fn hostile_text_is_a_mistake_and_nothing_worse() {
    let desk = Desk::new();
    let deep = "(".repeat(100_000);
    let long = format!("(version: 1, passes: {{ \"{}\": (use: \"x\") }})", "a".repeat(100_000));
    let texts =
        ["", "\u{0}", "(", ")", "(version: 1", "[]", "((((", "\u{feff}(version: 1)", deep.as_str(), long.as_str()];
    for text in texts {
        desk.put("hostile.graph.ron", text);
        assert!(!mistakes(&desk, "hostile.graph.ron").is_empty());
    }
    std::fs::write(desk.path("hostile.graph.ron"), [0xff, 0xfe, 0x00]).unwrap();
    assert!(!mistakes(&desk, "hostile.graph.ron").is_empty());
}

#[test]
fn a_truncated_graph_never_panics() {
    let desk = Desk::new();
    let graph = std::fs::read_to_string(desk.path("fog.graph.ron")).unwrap();
    let cuts: Vec<usize> = (0..graph.len()).step_by(29).filter(|cut| graph.is_char_boundary(*cut)).collect();
    let names: Vec<String> = cuts.iter().map(|cut| format!("cut{cut}.graph.ron")).collect();
    for (name, cut) in names.iter().zip(&cuts) {
        desk.put(name, &graph[..*cut]);
    }
    let mut arguments = vec!["check", "--format", "json"];
    arguments.extend(names.iter().map(String::as_str));
    let ended = desk.ends(2, &arguments);
    let found: Vec<Value> = serde_json::from_str(&ended.out).unwrap();
    for name in &names {
        assert!(found.iter().any(|mistake| mistake["file"] == name.as_str()), "{name} has no mistake");
    }
}

/// A triangle whose material has an occlusion picture: read but for that.
const OCCLUDED: &str = r#"{"asset":{"version":"2.0"},"buffers":[{"byteLength":36,"uri":"data:;base64,AACAvwAAgL8AAAAAAACAPwAAgL8AAAAAAAAAAAAAgD8AAAAA"}],
    "bufferViews":[{"buffer":0,"byteLength":36}],"accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3"}],
    "materials":[{"occlusionTexture":{"index":0}}],"meshes":[{"primitives":[{"attributes":{"POSITION":0},"material":0}]}],
    "nodes":[{"mesh":0}],"scenes":[{"nodes":[0]}]}"#;

/// What of a model is not drawn is told by the verbs that look at the picture, unless it is allowed.
#[test]
fn warnings_can_be_left_out() {
    let desk = Desk::new();
    desk.put("model.gltf", OCCLUDED);
    desk.put(
        "m.scene.ron",
        "(camera: (position: (0, 0, 5), look_at: (0, 0, 0)), objects: [(mesh: File(\"model.gltf\"))])",
    );
    let messages = |arguments: &[&str]| desk.ends(0, arguments).err.contains("warning[gltf-ignored]");
    assert!(messages(&["check", "m.scene.ron"]));
    assert!(!messages(&["check", "m.scene.ron", "--quiet"]));
    assert!(!messages(&["check", "m.scene.ron", "--allow", "brighter-than-white", "--allow", "gltf-ignored"]));
    assert!(messages(&["check", "m.scene.ron", "--allow", "gltf-mode"]));
    assert!(!messages(&["show", "fog.graph.ron", "--scene", "m.scene.ron"]));
    let json = desk.ends(0, &["check", "m.scene.ron", "--format", "json", "--quiet"]).out;
    assert_eq!(json.trim(), "[]");
    assert!(
        desk.ends(2, &["check", "m.scene.ron", "--allow", "gltf-ignord"]).err.contains("did you mean `gltf-ignored`?")
    );
    // A mistake is told whatever is allowed.
    desk.put("wrong.scene.ron", "(lihgts: [])");
    assert!(desk.ends(2, &["check", "wrong.scene.ron", "--quiet", "--allow", "unknown-field"]).err.contains("lihgts"));
}
