//! `bench`: the fields of its file, and that kept results are kept.

use serde_json::Value;
use tyndall_tests::Desk;

use crate::run::Program;

fn bench(desk: &Desk, more: &[&str]) -> Value {
    let mut arguments = vec!["bench", "fog.graph.ron", "--size", "32x24", "--json", "bench.json"];
    arguments.extend(more);
    desk.ends(0, &arguments);
    serde_json::from_str(&std::fs::read_to_string(desk.path("bench.json")).unwrap()).unwrap()
}

fn runs(figures: &Value) -> Vec<(String, u64)> {
    let passes = figures["passes"].as_array().unwrap().iter();
    passes.map(|pass| (pass["name"].as_str().unwrap().to_owned(), pass["runs"].as_u64().unwrap())).collect()
}

#[test]
fn the_file_has_every_figure() {
    let desk = Desk::new();
    let figures = bench(&desk, &["--frames", "2"]);
    assert!(!figures["adapter"].as_str().unwrap().is_empty());
    assert_eq!(figures["size"], serde_json::json!([32, 24]));
    for time in ["load_us", "validate_us", "plan_us", "first_image_ms"] {
        assert!(figures[time].as_f64().unwrap() > 0.0, "{time}");
    }
    assert!(figures["frame"]["cpu_us"].as_f64().unwrap() > 0.0);
    assert!(figures["frame"]["gpu_us"].is_null() || figures["frame"]["gpu_us"].as_f64().unwrap() > 0.0);
    let shared = figures["transient_bytes"]["shared"].as_u64().unwrap();
    assert!(shared > 0 && shared <= figures["transient_bytes"]["unshared"].as_u64().unwrap());
    let runs = runs(&figures);
    assert_eq!(runs.len(), 7);
    assert!(runs.iter().all(|(_, runs)| *runs == 2), "every pass runs in every frame: {runs:?}");
}

#[test]
fn with_keep_only_what_changes_runs_again() {
    let desk = Desk::new();
    let figures = bench(&desk, &["--frames", "3", "--keep", "--vary", "exposure=0.5..2"]);
    for (name, runs) in runs(&figures) {
        assert_eq!(runs, if name == "display" { 3 } else { 1 }, "{name}");
    }
}

/// Programs read the file, so its keys are exactly these.
#[test]
fn the_file_has_no_other_key() {
    let desk = Desk::new();
    let figures = bench(&desk, &["--frames", "1"]);
    let keys = |value: &Value| value.as_object().unwrap().keys().cloned().collect::<Vec<_>>();
    let wanted = [
        "adapter",
        "first_image_ms",
        "frame",
        "load_us",
        "passes",
        "plan_us",
        "size",
        "transient_bytes",
        "validate_us",
    ];
    assert_eq!(keys(&figures), wanted);
    assert_eq!(keys(&figures["frame"]), ["cpu_us", "gpu_us"]);
    assert_eq!(keys(&figures["transient_bytes"]), ["shared", "unshared"]);
    for pass in figures["passes"].as_array().unwrap() {
        assert_eq!(keys(pass), ["cpu_us", "gpu_us", "name", "runs"]);
        assert!(pass["name"].is_string() && pass["runs"].is_u64() && pass["cpu_us"].is_number());
        assert!(pass["gpu_us"].is_number() || pass["gpu_us"].is_null());
    }
}

#[test]
fn what_cannot_vary_is_refused() {
    let desk = Desk::new();
    for vary in [
        "exposure",
        "exposure=1",
        "exposure=a..b",
        "exposure=-1..2",
        "exposure=0..NaN",
        "exposure=0..inf",
        "air.nodes=4..8",
        "direct=0..1",
        "exposur=1..2",
        "=1..2",
        "",
    ] {
        let ended = desk.ends(2, &["bench", "fog.graph.ron", "--size", "8x8", "--frames", "2", "--vary", vary]);
        assert!(ended.err.contains(&format!("--vary {vary}")), "{vary}: {}", ended.err);
    }
}
