//! What the passes of this plugin compute, in double precision: what image tests hold them against.

use glam::DVec3;
use std::collections::BTreeMap;
use tyndall_plugin::{Outputs, Pixel, ReferenceInput};
use tyndall_shaders::lights::incident;
use tyndall_shaders::medium::transmittance;
use tyndall_shaders::phase::phase;
use tyndall_shaders::ray::Ray;
use tyndall_shaders::scene::{Light, Scene};
use tyndall_shaders::shadow_map::{Tiles, is_hidden, nearest, place};
use tyndall_shaders::shadows::lit_intervals;

/// Optical depth along the ray, of the channel of least extinction among those that scatter, at which the march ends: as in `airlight.wgsl`.
const MARCH_DEPTH: f64 = 16.0;

/// How it is asked whether a light reaches a point.
#[derive(Clone, Copy)]
enum Shadows<'a> {
    None,
    Rays,
    /// Distances, and the width of a layer.
    Map(&'a [f32], u32),
}

/// The same march with the same steps, from the definition of single scattering: what a light sends to the middle of
/// each step, through the medium to there and from there. No distance is floored, so lights keep off the rays.
pub(crate) fn airlight(input: &ReferenceInput<'_>) -> Outputs {
    let (scene, steps) = (input.scene()?, input.number("steps")?);
    let map = input.inputs.get("shadow_map").map(|map| (map.floats(), map.width()));
    let shadows = match &map {
        Some((distances, width)) if input.is_on("shadows") && input.is_on("maps") => Shadows::Map(distances, *width),
        _ if input.is_on("shadows") => Shadows::Rays,
        _ => Shadows::None,
    };
    let (extinction, scattering) = (scene.medium.extinction.to_array(), scene.medium.scattering().to_array());
    let scatters = extinction.into_iter().zip(scattering).filter(|(_, scattering)| *scattering > 0.0);
    let least = scatters.map(|(extinction, _)| extinction).fold(f64::INFINITY, f64::min);
    let least = if least.is_finite() { least } else { 1e-30 };
    input.view("radiance", |Pixel { ray, distance, .. }| {
        march(scene, ray, distance.min(MARCH_DEPTH / least), steps, shadows)
    })
}

fn march(scene: &Scene, ray: &Ray, way: f64, steps: f64, shadows: Shadows<'_>) -> DVec3 {
    let dx = way / steps;
    let casters = if matches!(shadows, Shadows::Rays) { scene.casters.as_slice() } else { &[] };
    let lit: Vec<Vec<[f64; 2]>> =
        scene.lights.iter().map(|light| lit_intervals(light, casters, ray, f64::INFINITY)).collect();
    let reaches = |light: usize, x: f64| match shadows {
        Shadows::Map(distances, width) => !is_hidden(distances, width, &scene.lights, light, ray.at(x)),
        Shadows::None | Shadows::Rays => lit[light].iter().any(|[from, to]| (*from..*to).contains(&x)),
    };
    let mut sum = DVec3::ZERO;
    for step in 0..steps as u32 {
        let x = (f64::from(step) + 0.5) * dx;
        for (_, light) in scene.lights.iter().enumerate().filter(|(index, _)| reaches(*index, x)) {
            sum += scatter(scene, light, ray, x) * dx;
        }
    }
    sum
}

/// Where a light sees nothing, m: as in `shadow_map.wgsl`.
const NOTHING: f32 = 3e38;

/// The distance of the nearest of all casters, for each texel.
pub(crate) fn shadow_map(input: &ReferenceInput<'_>) -> Outputs {
    let (scene, [width, ..]) = (input.scene()?, input.size("distances")?);
    let tiles = Tiles::new(scene.lights.len(), width);
    let distances = input.texels("distances", |[x, y, layer]| {
        let place = tiles.light([x, y]).and_then(|light| place(scene.lights.get(light)?));
        let found = place.map(|place| nearest(&scene.casters, place, tiles.direction([x, y], layer)));
        found.filter(|found| found.is_finite()).map_or(NOTHING, |found| found as f32)
    })?;
    Ok(BTreeMap::from([("distances", distances.into())]))
}

/// Light that is scattered toward the eye at a point of the ray, and reaches it, W/(sr m³).
fn scatter(scene: &Scene, light: &Light, ray: &Ray, x: f64) -> DVec3 {
    let arriving = incident(light, ray.at(x));
    // sin² of half the angle between the way of the light and the way to the eye.
    let w = (ray.direction - arriving.to_light).length_squared() / 4.0;
    let reaches = transmittance(&scene.medium, arriving.way) * transmittance(&scene.medium, x);
    scene.medium.scattering() * arriving.irradiance * phase(&scene.medium.phase, w) * reaches
}
