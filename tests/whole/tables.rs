//! Lookup tables are passes that are kept: they run again where what they depend on changes, and nowhere else.

use crate::support::{executor, gpu, planned, registry, scene, set_scene};
use tyndall_gpu::FrameOptions;

const LIGHT: &str = "Point(position: (1.0, 2.5, 0.0), intensity: (20.0, 18.0, 15.0))";

fn graph(mode: &str) -> String {
    let text = std::fs::read_to_string(tyndall_tests::shipped(&format!("modes/{mode}"))).unwrap();
    let text = text.replace("scene: \"../scenes/pavilion.scene.ron\",", "").replace("(1280, 720)", "(16, 12)");
    text.replace("\"airlight_size\": 512", "\"airlight_size\": 16")
        .replace("\"surface_size\": 64", "\"surface_size\": 8")
}

/// How often each of these passes has run after frames with another density, another g, and another place of the lamp.
fn runs(mode: &str, passes: &[&str]) -> Vec<u64> {
    let (gpu, registry) = (gpu(), registry(&[]));
    let mut kept = executor(&gpu, &registry, planned(&registry, &graph(mode), |_, _| ()));
    let changed = |from: &str, to: &str| {
        let text = crate::support::scene_text(LIGHT);
        assert!(text.contains(from));
        crate::support::scene_of(&text.replace(from, to))
    };
    let frames = [
        scene(LIGHT),
        changed("extinction: (0.05,", "extinction: (0.15,"),
        changed("g: 0.7", "g: 0.3"),
        scene("Point(position: (2.0, 2.5, 0.0), intensity: (20.0, 18.0, 15.0))"),
    ];
    for scene in &frames {
        set_scene(&mut kept, scene, 0.0);
        kept.frame(FrameOptions::default()).unwrap();
    }
    let index = |name: &str| kept.counters().handles().find(|at| kept.plan().pass_name(*at) == name).unwrap();
    passes.iter().map(|name| kept.counters()[index(name)].runs).collect()
}

/// The frames change density, g, g back with the lamp: a table of the phase function runs for the first and for both g.
#[test]
fn a_table_of_the_phase_function_runs_again_where_that_changes_alone() {
    assert_eq!(runs("table", &["h", "j1", "jn", "air", "scattered"]), [3, 3, 3, 4, 4]);
}

#[test]
fn legendre_tables_run_once() {
    assert_eq!(runs("legendre", &["h_k", "j1_k", "jn_k", "air", "scattered"]), [1, 1, 1, 4, 4]);
}
