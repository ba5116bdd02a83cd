//! Mistakes of comparison files, the shipped file, and the truth against data that this project did not compute.

use std::path::Path;
use std::sync::Arc;

use tyndall_document::{Code, Diagnostics, MISSING_FILE, Source, UNKNOWN_FIELD, fixture, render_text};
use tyndall_graph::codes::{BAD_SIZE, BAD_VERSION, NEWER_VERSION, OUT_OF_RANGE, UNKNOWN_OUTPUT, UNKNOWN_PARAMETER};
use tyndall_image::metrics::{Percentiles, percentiles};
use tyndall_plugin::Registry;
use tyndall_scene::Scene;

use crate::truth::{Light, Truth};
use crate::twin::Twin;
use crate::{codes, prepare, read};

fn registry() -> Registry {
    let plugins = vec![
        tyndall_core::plugin(),
        tyndall_airlight::plugin(),
        tyndall_surface_radiance::plugin(),
        tyndall_froxel::plugin(),
        tyndall_march::plugin(),
    ];
    tyndall_render::registry(plugins, &[]).unwrap()
}

/// All that is said about a file, as `run` collects it.
fn mistakes(source: &Arc<Source>, registry: &Registry) -> Diagnostics {
    let mut out = Diagnostics::default();
    if let Some(file) = read(source, &mut out) {
        prepare(&file, registry, &mut out);
    }
    out
}

/// Those of other crates are here for their places: a setting stands in the comparison file.
#[test]
fn every_mistake_has_its_text_and_place() {
    let elsewhere = [
        BAD_VERSION,
        NEWER_VERSION,
        BAD_SIZE,
        UNKNOWN_OUTPUT,
        UNKNOWN_PARAMETER,
        OUT_OF_RANGE,
        UNKNOWN_FIELD,
        MISSING_FILE,
        tyndall_scene::codes::UNKNOWN_PATH,
    ];
    let codes: Vec<Code> = codes::CODES.iter().copied().chain(elsewhere).collect();
    let registry = registry();
    fixture::check(Path::new("tests/fixtures"), &codes, &|source| mistakes(source, &registry));
}

#[test]
fn the_shipped_file_has_none() {
    let source = Source::read(Path::new("../../graphs/light.compare.ron")).unwrap();
    let registry = registry();
    let found = mistakes(&source, &registry);
    assert!(found.is_empty(), "{}", render_text(&found, false));
    let file = read(&source, &mut Diagnostics::default()).unwrap();
    let scenes = prepare(&file, &registry, &mut Diagnostics::default());
    assert!(scenes.len() >= 5 && scenes.iter().all(|scene| scene.methods.len() == file.methods.len()));
    assert!(file.methods.len() >= 10);
}

/// Errors of the truth of a scene without surfaces, at the pixels that the reference has (see `tests/reference/README.md`).
fn truth_errors(name: &str) -> Percentiles {
    let folder = Path::new("../app/tests/reference");
    let (scene, _) = Scene::load(&folder.join(format!("{name}.scene.ron")), &Vec::new()).unwrap();
    let size = (160, 120);
    let depth = vec![f32::INFINITY; 160 * 120];
    let truth = Truth::new(Light::Airlight, &Twin::new(&scene, 4.0 / 3.0), size, &depth, &|| ());
    let samples = tyndall_image::read_array(&folder.join(format!("{name}.airlight.npy"))).unwrap();
    let (samples, _) = samples.data.as_chunks::<5>();
    assert!(samples.len() > 1_000);
    let error = |sample: &[f32; 5]| {
        let found = truth.pixels[sample[1] as usize * 160 + sample[0] as usize].to_array();
        (0..3).map(|channel| (found[channel] / f64::from(sample[2 + channel]) - 1.0).abs()).fold(0.0, f64::max)
    };
    percentiles(&mut samples.iter().map(error).collect::<Vec<_>>()).unwrap()
}

/// The reference is stored as f32: half a unit of its last digit is 6e-8. At the pixel nearest to a lamp it is itself off by
/// up to 2e-6, as arithmetic of 30 digits says of `glow_g0.5`.
#[test]
fn the_truth_agrees_with_reference_data() {
    for name in ["glow_g0.5", "glow_g0.9", "glow_rayleigh", "lamp_behind"] {
        let errors = truth_errors(name);
        assert!(errors.p99 < 6.1e-8 && errors.max < 3e-6, "{name}: {errors:?}");
    }
}
