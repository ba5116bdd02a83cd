//! Mistakes of comparison files, the shipped file, and the truth against data that this project did not compute.

use std::path::Path;
use std::sync::Arc;

use tyndall_document::{
    BAD_SIZE, BAD_VERSION, Code, Diagnostics, MISSING_FILE, NEWER_VERSION, OUT_OF_RANGE, Source, UNKNOWN_FIELD,
    fixture, render_text,
};
use tyndall_gpu::PortData;
use tyndall_graph::Resource;
use tyndall_graph::codes::{UNKNOWN_OUTPUT, UNKNOWN_PARAMETER};
use tyndall_graph::descriptor::{Dimension, Format};
use tyndall_image::metrics::{Percentiles, percentiles};
use tyndall_plugin::Registry;
use tyndall_scene::{Primitive, Scene};
use tyndall_shaders::ray::ray_of_pixel;
use tyndall_shaders::shadow_map::nearest;

use crate::casters::Casters;
use crate::truth::{Geometry, Output, Seen, Truth};
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

/// Codes of other crates are here for their places: a setting is in the comparison file.
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
    for (name, least_scenes, least_methods) in [("light", 5, 10), ("shadows", 6, 7), ("surface", 3, 5)] {
        let source = Source::read(&Path::new("../../graphs").join(format!("{name}.compare.ron"))).unwrap();
        let found = mistakes(&source, &registry);
        assert!(found.is_empty(), "{}", render_text(&found, false));
        let file = read(&source, &mut Diagnostics::default()).unwrap();
        let scenes = prepare(&file, &registry, &mut Diagnostics::default());
        assert!(scenes.len() >= least_scenes && scenes.iter().all(|scene| scene.methods.len() == file.methods.len()));
        assert!(file.methods.len() >= least_methods);
    }
}

/// A wall that faces the eye from 2 m, the lamp beside the eye: without a medium the truth is that of a Phong surface,
/// (ρ/π·(n·l) + k_s·cosⁿα)·I/d², and fog that reaches to the wall adds light where the wall faces away from a lamp behind it.
#[test]
fn the_truth_of_surfaces() {
    let size = (1, 1);
    let wall = Geometry {
        depth: port(size, 1, &[2.0]),
        normal: port(size, 1, &[0.0, 0.0, 1.0, 0.0]),
        material: filled(size, 2, Format::Rgba32Float, [0.6, 0.5, 0.4, 0.0, 0.2, 0.2, 0.2, 3.0]),
        ..nothing_met(size)
    };
    let light = |z: f64, extinction: f64| {
        let text = format!(
            "(camera: (position: (0, 0, 2), look_at: (0, 0, 0)), medium: (extinction: ({extinction}, {extinction}, {extinction})),
            lights: [Point(position: (0, 0, {z}), intensity: (8, 8, 8))])"
        );
        let source = Source::new("wall.scene.ron", text);
        let (scene, _) = Scene::from_source(&source, Path::new(""), &Vec::new(), &Arc::default()).unwrap();
        let twin = scene.twin(0.0, 1.0);
        let seen = Seen { scene: &twin, geometry: &wall, casters: None };
        Truth::new(Output::Surface, seen, size, &|| ()).pixels[0].to_array()
    };
    let [red, green, _] = light(2.0, 0.0);
    let brdf = |rho: f64| rho / std::f64::consts::PI + 0.2;
    assert!((red - brdf(0.6) * 2.0).abs() < 1e-6 && (green - brdf(0.5) * 2.0).abs() < 1e-6, "{red} {green}");
    assert_eq!(light(-2.0, 0.0), [0.0; 3]);
    let [behind, ..] = light(-2.0, 0.3);
    assert!(behind > 1e-3 && behind < red, "{behind}");
}

/// A port that holds these numbers.
fn filled(
    (width, height): (u32, u32),
    depth_or_layers: u32,
    format: Format,
    numbers: impl IntoIterator<Item = f64>,
) -> PortData {
    let dimension = if depth_or_layers == 1 { Dimension::D2 } else { Dimension::D2Array };
    let resource = Resource::Texture { dimension, format, width, height, depth_or_layers };
    PortData::from_numbers(resource, format.scalar(), numbers)
}

/// A port of this value in every texel.
fn port(size: (u32, u32), layers: u32, value: &[f64]) -> PortData {
    let format = if value.len() == 1 { Format::R32Float } else { Format::Rgba32Float };
    filled(size, layers, format, value.repeat((size.0 * size.1 * layers) as usize))
}

fn nothing_met(size: (u32, u32)) -> Geometry {
    let zeros = [0.0; 4];
    Geometry {
        depth: port(size, 1, &[f64::INFINITY]),
        normal: port(size, 1, &zeros),
        material: port(size, 2, &zeros),
        objects: Vec::new(),
        triangle: port(size, 1, &[0.0]),
    }
}

/// Where rays meet the triangles of what is not round, which are what they stand for.
fn met(scene: &Scene, twin: &tyndall_shaders::scene::Scene, size: (u32, u32)) -> Geometry {
    let surfaces = scene.surfaces(0.0).triangles;
    let flat = scene.instances.iter().map(|instance| {
        (
            !matches!(instance.primitive, Some(Primitive::Sphere { .. } | Primitive::Torus { .. })),
            &instance.mesh.triangles,
        )
    });
    let flat: Vec<bool> = flat.flat_map(|(flat, triangles)| triangles.iter().map(move |_| flat)).collect();
    let flat = surfaces.iter().zip(flat).filter(|(_, flat)| *flat);
    let triangles: Vec<_> = flat.map(|(triangle, _)| triangle.corners.map(|corner| corner.position)).collect();
    let pixels = (0..size.1).flat_map(|y| (0..size.0).map(move |x| [x, y]));
    let depth = pixels.map(|pixel| {
        let ray = ray_of_pixel(&twin.camera, pixel, [size.0, size.1]);
        nearest(&triangles, ray.origin, ray.direction)
    });
    let depth = filled(size, 1, Format::R32Float, depth);
    Geometry { depth, ..nothing_met(size) }
}

/// Pictures that this project did not compute.
const REFERENCE: &str = "../../tests/reference";

/// With shadows, too: a box, a sphere, and both. The picture's sum has the outlines. A truth without shadows is another.
#[test]
fn the_truth_with_shadows_agrees_with_reference_data() {
    let (folder, shadows) = (Path::new(REFERENCE), Path::new("../../plugins/shadow_planes/tests/reference"));
    let sums = std::fs::read_to_string(shadows.join("sums.json")).unwrap();
    let sums: serde_json::Value = serde_json::from_str(&sums).unwrap();
    let size = (160, 120);
    for name in ["box", "sphere", "box_sphere"] {
        let (scene, _) = Scene::load(&folder.join(format!("{name}.scene.ron")), &Vec::new(), &Arc::default()).unwrap();
        let (twin, casters) = (scene.twin(0.0, 4.0 / 3.0), Casters::new(&scene));
        let geometry = met(&scene, &twin, size);
        let truth =
            |casters| Truth::new(Output::Airlight, Seen { scene: &twin, geometry: &geometry, casters }, size, &|| ());
        let shadowed = truth(Some(&casters));
        let samples = tyndall_image::read_array(&shadows.join(format!("{name}.shadowed.npy"))).unwrap();
        let (samples, _) = samples.data.as_chunks::<5>();
        let errors = |truth: &Truth| {
            let error = |sample: &[f32; 5]| {
                let found = truth.pixels[sample[1] as usize * 160 + sample[0] as usize].to_array();
                (0..3).map(|channel| (found[channel] / f64::from(sample[2 + channel]) - 1.0).abs()).fold(0.0, f64::max)
            };
            percentiles(&mut samples.iter().map(error).collect::<Vec<_>>()).unwrap()
        };
        let found = errors(&shadowed);
        let sum: f64 = shadowed.pixels.iter().map(|pixel| pixel.x).sum();
        let wanted = sums[name][0].as_f64().unwrap();
        println!("{name}: {found:?}, sum {:e}", sum / wanted - 1.0);
        assert!(samples.len() > 1_000 && found.p99 < 1e-6 && found.max < 1e-4, "{name}: {found:?}");
        assert!((sum / wanted - 1.0).abs() < 1e-6, "{name}: {sum} for {wanted}");
        assert!(errors(&truth(None)).p99 > 0.02);
        let edges = shadowed.edges.unwrap().into_iter().filter(|edge| *edge).count();
        assert!((500..8_000).contains(&edges), "{name}: {edges}");
    }
}

/// Errors of the truth of a scene without surfaces, at the pixels that the reference has (see `tests/reference/README.md`).
fn truth_errors(name: &str) -> Percentiles {
    let folder = Path::new(REFERENCE);
    let (scene, _) = Scene::load(&folder.join(format!("{name}.scene.ron")), &Vec::new(), &Arc::default()).unwrap();
    let size = (160, 120);
    let (twin, geometry) = (scene.twin(0.0, 4.0 / 3.0), nothing_met(size));
    let seen = Seen { scene: &twin, geometry: &geometry, casters: None };
    let truth = Truth::new(Output::Airlight, seen, size, &|| ());
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
