//! Mistakes of comparison files, the shipped file, and the truth against data that this project did not compute.

use std::path::Path;
use std::sync::Arc;

use tyndall_document::{Code, Diagnostics, MISSING_FILE, Source, UNKNOWN_FIELD, fixture, render_text};
use tyndall_gpu::PortData;
use tyndall_graph::codes::{BAD_SIZE, BAD_VERSION, NEWER_VERSION, OUT_OF_RANGE, UNKNOWN_OUTPUT, UNKNOWN_PARAMETER};
use tyndall_image::metrics::{Percentiles, percentiles};
use tyndall_plugin::Registry;
use tyndall_scene::Scene;

use crate::casters::Casters;
use crate::truth::{Geometry, Light, Seen, Truth};
use crate::{codes, prepare, read};

fn registry() -> Registry {
    let plugins = vec![
        tyndall_core::plugin(),
        tyndall_airlight::plugin(),
        tyndall_surface_radiance::plugin(),
        tyndall_froxel::plugin(),
        tyndall_march::plugin(),
        tyndall_shadow_planes::plugin(),
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
fn the_shipped_files_have_none() {
    let registry = registry();
    for (name, least_scenes, least_methods) in [("light", 5, 10), ("shadows", 6, 8), ("surface", 3, 5)] {
        let source = Source::read(&Path::new("../../graphs").join(format!("{name}.compare.ron"))).unwrap();
        let found = mistakes(&source, &registry);
        assert!(found.is_empty(), "{}", render_text(&found, false));
        let file = read(&source, &mut Diagnostics::default()).unwrap();
        let scenes = prepare(&file, &registry, &mut Diagnostics::default());
        assert!(scenes.len() >= least_scenes && scenes.iter().all(|scene| scene.methods.len() == file.methods.len()));
        assert!(file.methods.len() >= least_methods);
    }
}

/// A wall that faces the eye from 2 m, the lamp at the eye's side: without a medium the truth is the contract's formula,
/// and fog that reaches to the wall adds light where the wall faces away from a lamp behind it.
#[test]
fn the_truth_of_surfaces() {
    let size = (1, 1);
    let wall = Geometry {
        depth: port(size, 1, &[2.0]),
        normal: port(size, 1, &[0.0, 0.0, 1.0, 0.0]),
        material: PortData { data: vec![0.6, 0.5, 0.4, 0.0, 0.2, 0.2, 0.2, 3.0], ..port(size, 2, &[0.0; 4]) },
        ..nothing_met(size)
    };
    let light = |z: f64, extinction: f64| {
        let text = format!(
            "(camera: (position: (0, 0, 2), look_at: (0, 0, 0)), medium: (extinction: ({extinction}, {extinction}, {extinction})),
            lights: [Point(position: (0, 0, {z}), intensity: (8, 8, 8))])"
        );
        let source = Source::new("wall.scene.ron", text);
        let (scene, _) = Scene::from_source(&source, Path::new(""), &Vec::new()).unwrap();
        let twin = scene.twin(0.0, 1.0);
        let seen = Seen { scene: &twin, geometry: &wall, casters: None };
        Truth::new(Light::Surface, seen, size, &|| ()).pixels[0].to_array()
    };
    let [red, green, _] = light(2.0, 0.0);
    let brdf = |rho: f64| rho / std::f64::consts::PI + 0.2;
    assert!((red - brdf(0.6) * 2.0).abs() < 1e-6 && (green - brdf(0.5) * 2.0).abs() < 1e-6, "{red} {green}");
    assert_eq!(light(-2.0, 0.0), [0.0; 3]);
    let [behind, ..] = light(-2.0, 0.3);
    assert!(behind > 1e-3 && behind < red, "{behind}");
}

/// A port of one layer of this value.
fn port((width, height): (u32, u32), layers: u32, value: &[f32]) -> PortData {
    let data = value.repeat((width * height * layers) as usize);
    PortData { width, height, layers, channels: value.len() as u32, is_buffer: false, is_image: layers == 1, data }
}

fn nothing_met(size: (u32, u32)) -> Geometry {
    let zeros = [0.0; 4];
    Geometry {
        depth: port(size, 1, &[f32::INFINITY]),
        normal: port(size, 1, &zeros),
        material: port(size, 2, &zeros),
        objects: Vec::new(),
        triangle: port(size, 1, &[0.0]),
    }
}

/// Errors of the truth of a scene without surfaces, at the pixels that the reference has (see `tests/reference/README.md`).
fn truth_errors(name: &str) -> Percentiles {
    let folder = Path::new("../app/tests/reference");
    let (scene, _) = Scene::load(&folder.join(format!("{name}.scene.ron")), &Vec::new()).unwrap();
    let size = (160, 120);
    let (twin, geometry) = (scene.twin(0.0, 4.0 / 3.0), nothing_met(size));
    let seen = Seen { scene: &twin, geometry: &geometry, casters: None };
    let truth = Truth::new(Light::Airlight, seen, size, &|| ());
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
