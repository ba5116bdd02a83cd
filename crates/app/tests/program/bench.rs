//! `bench`: the fields of its file, and that kept results are kept.

use serde_json::Value;

use crate::run::Desk;

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
    let figures = bench(&desk, &["--frames", "4"]);
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
    assert_eq!(runs.len(), 5);
    assert!(runs.iter().all(|(_, runs)| *runs == 4), "every pass runs in every frame: {runs:?}");
}

#[test]
fn with_keep_only_what_changes_runs_again() {
    let desk = Desk::new();
    let figures = bench(&desk, &["--frames", "10", "--keep", "--vary", "exposure=0.5..2"]);
    for (name, runs) in runs(&figures) {
        assert_eq!(runs, if name == "display" { 10 } else { 1 }, "{name}");
    }
}
