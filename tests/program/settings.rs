//! `--set`, and parameters, switches and times in graph files.

use std::path::Path;

use tyndall_image::{Image, metrics, read};
use tyndall_tests::{Desk, sessions};

use crate::run::Program;

/// In this process: that a command line carries its settings there is told by `render.rs`.
fn draw(desk: &Desk, graph: &str, settings: &[&str], output: &str) -> Image {
    let request = desk.request(Path::new(graph), None, Some((12, 8)), settings);
    let drawn = sessions().with(|session| session.draw(&request, &[output], 0..1)).and_then(|drawn| drawn);
    drawn.unwrap_or_else(|error| panic!("{settings:?}: {error}")).pictures.remove(0)
}

#[track_caller]
fn equal(a: &Image, b: &Image) {
    assert_eq!(metrics::differing_bits(a, b).unwrap(), 0);
}

#[test]
fn every_part_of_a_scene_can_be_set() {
    let desk = Desk::new();
    let plain = draw(&desk, "fog.graph.ron", &[], "radiance");
    for set in [
        "scene.camera.position=(0, 2, 6)",
        "scene.camera.look_at=(0.5, 1, 0)",
        "scene.camera.vertical_fov=40",
        "scene.camera=(position: (0, 2, 6), look_at: (0, 1, 0))",
        "scene.medium.extinction=(0.1, 0.1, 0.1)",
        "scene.medium.albedo=(0.5, 0.5, 0.5)",
        "scene.medium.phase=Rayleigh",
        "scene.medium=(extinction: (0.01, 0.01, 0.01))",
        "scene.lights.0.position=(2, 2, 2)",
        "scene.lights.1.irradiance=(1, 1, 1)",
        "scene.lights.1.direction=(0, -1, 0)",
        "scene.lights=[]",
        "scene.objects.0.translation=(1, 1, 1)",
        "scene.objects.0.material=(diffuse: (0.1, 0.1, 0.1))",
        "scene.objects.0.mesh=Box(size: (1, 1, 1))",
        "scene.objects=[]",
    ] {
        assert!(
            metrics::differing_bits(&draw(&desk, "fog.graph.ron", &[set], "radiance"), &plain).unwrap() > 0,
            "{set}"
        );
    }
    let last = draw(
        &desk,
        "fog.graph.ron",
        &["scene.medium.albedo=(0, 0, 0)", "scene.medium.albedo=(0.9, 0.8, 0.7)"],
        "radiance",
    );
    equal(&last, &plain);
}

#[test]
fn settings_that_are_wrong_end_with_2_and_name_themselves() {
    let desk = Desk::new();
    for set in [
        "",
        "=",
        "=1",
        "exposure=",
        "exposure=1 2",
        "exposure=-1",
        "exposure=NaN",
        "exposure=inf",
        "exposure=(1, 1, 1)",
        "exposure=true",
        "direct=1",
        "display.curve=filmic",
        "display.curve=\"filmick\"",
        "display.exposur=1",
        "displai.exposure=1",
        "display.=1",
        ".exposure=1",
        "display.radiance=1",
        "scene=1",
        "scene.=1",
        "scene.medium",
        "scene.medium.extinction=1",
        "scene.medium.extinction=(1, 1)",
        "scene.medium.extinction=(-1, 1, 1)",
        "scene.medium.extinction=(NaN, 1, 1)",
        "scene.medium.extinktion=(1, 1, 1)",
        "scene.medium.phase=HenyeyGreenstein(1.0)",
        "scene.medium.phase=Mie",
        "scene.lights.2.intensity=(1, 1, 1)",
        "scene.lights.-1.intensity=(1, 1, 1)",
        "scene.lights.0.irradiance=(1, 1, 1)",
        "scene.lights.0.intensity=(inf, 1, 1)",
        "scene.objects.0.mesh=File(\"missing.glb\")",
        "scene.objects.0.mesh=Sphere(radius: -1)",
        "scene.camera.look_at=(0, 1.5, 6)",
        "scene.camera.up=(0, 0, 0)",
        "scene.camera.vertical_fov=180",
        "scene.camera.vertical_fov=0",
    ] {
        let ended = desk.ends(2, &["render", "fog.graph.ron", "--size", "8x8", "--set", set]);
        assert!(ended.err.contains(&format!("--set {set}")), "{set}: {}", ended.err);
    }
    assert!(desk.files("out").is_empty());
}

#[test]
fn values_are_ron() {
    let desk = Desk::new();
    let filmic = draw(&desk, "fog.graph.ron", &["display.curve=\"filmic\""], "image");
    assert!(metrics::differing_bits(&filmic, &draw(&desk, "fog.graph.ron", &[], "image")).unwrap() > 0);
    equal(
        &draw(&desk, "fog.graph.ron", &["exposure=2"], "image"),
        &draw(&desk, "fog.graph.ron", &["exposure= 2.0 "], "image"),
    );
    equal(
        &draw(&desk, "fog.graph.ron", &["exposure=0x2"], "image"),
        &draw(&desk, "fog.graph.ron", &["exposure=2e0"], "image"),
    );
}

const SWITCHED: &str = r#"(
    version: 1,
    params: { "level": 0.25, "on": true },
    passes: {
        "grey": (use: "core.constant", params: { "value": (0.25, 0.5, 1.0) }),
        "twice": (use: "core.scale", inputs: { "input": "grey.color" }, params: { "factor": (2, 2, 2) }, enabled: "$on"),
        "sum": (use: "core.add", inputs: { "a": "twice.scaled", "b": "grey.color" }, params: { "factor": "$level" }),
    },
    outputs: { "radiance": "sum.sum" },
)"#;

#[test]
fn passes_are_switched_by_parameters() {
    let desk = Desk::new();
    desk.put("on.graph.ron", SWITCHED);
    let first = |settings: &[&str]| draw(&desk, "on.graph.ron", settings, "radiance").data[0];
    assert_eq!(first(&[]), 0.5 + 0.25 * 0.25);
    assert_eq!(first(&["on=false"]), 0.25 + 0.25 * 0.25);
    assert_eq!(first(&["level=2"]), 1.0);
    assert_eq!(first(&["level=2", "sum.factor=0"]), 0.5, "`pass.parameter` beats `$name`");
    assert_eq!(first(&["sum.factor=0", "level=2"]), 0.5, "in either order");
    let ended = desk.ends(2, &["render", "on.graph.ron", "--size", "8x8", "--set", "scene.background=(1, 1, 1)"]);
    assert!(ended.err.contains("scene"), "{}", ended.err);
}

#[test]
fn frames_and_times_are_parameters() {
    let desk = Desk::new();
    for (name, wanted) in [("$frame", [3.0, 4.0]), ("$time", [3.0 / 24.0, 4.0 / 24.0])] {
        let graph =
            SWITCHED.replace("\"level\": 0.25, ", "").replace("$level", name).replace("(0.25, 0.5, 1.0)", "(1, 1, 1)");
        desk.put("time.graph.ron", &graph);
        desk.ends(
            0,
            &["render", "time.graph.ron", "--size", "8x8", "--frames", "3..5", "--output", "radiance=t.####.npy"],
        );
        for (file, wanted) in ["t.0003.npy", "t.0004.npy"].into_iter().zip(wanted) {
            let found = read(&desk.path(file)).unwrap().data[0];
            assert!((found - (2.0 + wanted as f32)).abs() < 1e-6, "{name} {file}: {found}");
        }
    }
}

#[test]
fn an_unused_parameter_of_a_graph_is_a_mistake() {
    let desk = Desk::new();
    desk.put("unused.graph.ron", &SWITCHED.replace("\"on\": true", "\"on\": true, \"spare\": 1"));
    let ended = desk.ends(2, &["check", "unused.graph.ron"]);
    assert!(ended.err.contains("spare") && ended.err.contains("unused.graph.ron:3:"), "{}", ended.err);
}

#[test]
fn numbers_in_files_that_are_not_finite_are_mistakes() {
    let desk = Desk::new();
    for (from, to) in [
        ("0.05", "NaN"),
        ("20.0, 18.0", "inf, 18.0"),
        ("50.0", "-inf"),
        ("radius: 1.0", "radius: NaN"),
        ("1.5", "1e400"),
    ] {
        desk.put("bad.scene.ron", &tyndall_tests::SCENE.replacen(from, to, 1));
        let ended = desk.ends(2, &["render", "fog.graph.ron", "--scene", "bad.scene.ron", "--size", "8x8"]);
        assert!(ended.err.contains("bad.scene.ron:"), "{to}: {}", ended.err);
    }
    desk.put("bad.graph.ron", &SWITCHED.replace("0.25, 0.5, 1.0", "0.25, NaN, 1.0"));
    let ended = desk.ends(2, &["check", "bad.graph.ron"]);
    assert!(ended.err.contains("bad.graph.ron:5:"), "{}", ended.err);
}
