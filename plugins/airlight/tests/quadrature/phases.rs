//! `phase_at` of `shaders/phase.wgsl` on the GPU: the function of its twin, and 1 over the sphere.

use tyndall_probe::Probe;
use tyndall_scene::phase_table;
use tyndall_shaders::phase::{PHASE_FUNCTIONS, phase};
use tyndall_shaders::scene::Phase;

use crate::cases::fog;
use crate::on_gpu::{self, count};

const SHADER: &str = "
#import scene
#import phase

var<storage, read> cases: array<f32>;
var<uniform> phase: Phase;
var<storage, read_write> results: array<vec4<f32>>;

@compute @workgroup_size(64)
fn main(@builtin(global_invocation_id) id: vec3<u32>) {
    if id.x < arrayLength(&cases) {
        results[id.x] = vec4<f32>(phase_at(phase, cases[id.x]));
    }
}
";

fn on_gpu(kind: &Phase, places: &[f32]) -> Vec<f32> {
    let table = phase_table(kind);
    let probe = Probe::new(SHADER, &[], &[("phase_table_count", count(&table))]);
    let inputs: [(&str, &[u8]); 2] = [("phase", &on_gpu::phase(kind)), ("phase_table", &table)];
    let results = probe.run_with(bytemuck::cast_slice(places), places.len(), &inputs);
    results.iter().map(|result| result[0]).collect()
}

fn all() -> Vec<Phase> {
    let mut all = vec![fog()];
    // backward no narrower: near its end w itself is known to 6e-8 only
    for g in [-0.9, -0.5, 1e-7, 0.3, 0.75, 0.99] {
        let share = 0.5 + 0.5 * g;
        all.extend(PHASE_FUNCTIONS.iter().filter_map(|of| (of.make)(&mut |parameter| Some(parameter.range.at(share)))));
        all.push(Phase::DoubleHenyeyGreenstein { g1: g, g2: -0.3, f: 0.25 });
    }
    assert_eq!(all.len(), 1 + 6 * (PHASE_FUNCTIONS.len() + 1));
    all
}

/// Midpoints in u, where w = 1/(1 + e^(-2u)): no peak is narrow there.
fn places() -> Vec<f64> {
    const COUNT: usize = 40_000;
    (0..COUNT).map(|i| -15.0 + 30.0 * (i as f64 + 0.5) / COUNT as f64).collect()
}

#[test]
fn phase_functions_are_those_of_the_twin_and_integrate_to_one() {
    let places = places();
    let du = places[1] - places[0];
    let ws: Vec<f32> = places.iter().map(|u| (1.0 / (1.0 + (-2.0 * u).exp())) as f32).collect();
    for kind in all() {
        let found = on_gpu(&kind, &ws);
        let measured = matches!(kind, Phase::Measured(_));
        let mut integral = 0.0;
        let mut worst: f64 = 0.0;
        for (&w, &found) in ws.iter().zip(&found) {
            let (w, found) = (f64::from(w), f64::from(found));
            assert!(found.is_finite() && found > 0.0, "{kind:?} at {w}: {found}");
            worst = worst.max((found / phase(&kind, w) - 1.0).abs());
            // 2 pi dmu = 4 pi dw, dw = 2 w (1 - w) du
            integral += found * 8.0 * std::f64::consts::PI * w * (1.0 - w) * du;
        }
        println!("{kind:?}: integral {integral:.6}, worst {worst:.1e}", kind = name(&kind));
        assert!((integral - 1.0).abs() < 1e-4, "{kind:?}: {integral}");
        // between rows of 1 degree a measured function has kinks, which the table's steps round off
        assert!(worst < if measured { 5e-3 } else { 2e-5 }, "{kind:?}: {worst:e}");
    }
}

fn name(kind: &Phase) -> String {
    let text = format!("{kind:?}");
    text.chars().take(60).collect()
}
