//! The light that each froxel scatters toward the eye, in double precision: twin of `scatter.wgsl`.

use std::collections::BTreeMap;
use std::f64::consts::PI;

use glam::{DVec2, DVec3};
use tyndall_plugin::{Outputs, ReferenceInput, each_texel, rgba};
use tyndall_shaders::lights::incident;
use tyndall_shaders::medium::transmittance;
use tyndall_shaders::phase::phase;
use tyndall_shaders::ray::Ray;
use tyndall_shaders::scene::{Camera, Light, Scene};
use tyndall_shaders::shadow_map::is_hidden;

use crate::grid::{Grid, ray_of_point};

/// Both ports of `froxel.scatter`.
pub(crate) fn reference(input: &ReferenceInput<'_>) -> Outputs {
    let whole = |param: &str| input.number(param).map(|number| number as u32);
    let (columns, slices, points) = ([whole("width")?, whole("height")?], whole("slices")?, whole("points")?);
    let (near, far) = (input.number("near")?, input.number("far")?);
    // What ends before it begins is as good as empty.
    let grid = Grid { near, far: far.max(1.001 * near), slices };
    let scene = input.scene()?;
    let map = input.inputs.get("shadow_map").filter(|_| input.is_on("shadows"));
    let map = map.map(|map| (map.floats(), map.width()));
    let map = map.as_ref().map(|(distances, width)| Map { distances, width: *width });
    let scattered = each_texel([columns[0], columns[1], slices], |at| froxel((scene, map), &grid, columns, at, points));
    let numbers = vec![grid.near as f32, grid.far as f32, 0.0, 0.0];
    Ok(BTreeMap::from([("scattered", rgba(scattered)), ("grid", numbers.into())]))
}

/// A shadow map: distances, and the width of a layer.
#[derive(Clone, Copy)]
struct Map<'a> {
    distances: &'a [f32],
    width: u32,
}

/// σ_s·p·E·e^(−σ_t·r), W/(sr m³): its mean over the middles of points³ equal parts of a froxel.
fn froxel((scene, map): (&Scene, Option<Map<'_>>), grid: &Grid, columns: [u32; 2], at: [u32; 3], points: u32) -> DVec3 {
    let size = DVec2::new(f64::from(columns[0]), f64::from(columns[1]));
    let (start, end) = (grid.border(at[2]), grid.border(at[2] + 1));
    let parts = f64::from(points.pow(3));
    let volume = solid_angle(&scene.camera, size) * (end.powi(3) - start.powi(3)) / 3.0 / parts;
    let middle = |part: u32| (f64::from(part) + 0.5) / f64::from(points);
    let mut sum = DVec3::ZERO;
    for (z, y, x) in (0..points).flat_map(|z| (0..points).flat_map(move |y| (0..points).map(move |x| (z, y, x)))) {
        let place = DVec2::new(f64::from(at[0]) + middle(x), f64::from(at[1]) + middle(y)) / size;
        let ray = ray_of_point(&scene.camera, place);
        let way = start + middle(z) * (end - start);
        let point = ray.at(way);
        let hides = |map: Map<'_>, light: usize| is_hidden(map.distances, map.width, &scene.lights, light, point);
        let lit = |(index, _): &(usize, &Light)| !map.is_some_and(|map| hides(map, *index));
        let lights = scene.lights.iter().enumerate().filter(lit);
        sum += lights.map(|(_, light)| scattered(scene, light, &ray, way, volume)).sum::<DVec3>();
    }
    sum / parts
}

/// Of a column in the middle of the picture, by its rectangle at distance 1 along the view.
fn solid_angle(camera: &Camera, columns: DVec2) -> f64 {
    (2.0 * camera.right.length() / columns.x) * (2.0 * camera.up.length() / columns.y)
}

/// What one light adds at a point of a ray. A point stands for a volume: a ball as large about a lamp has a mean of 1/r²
/// of 3 over its squared radius, and nearer to the lamp 1/r² is no more than that.
fn scattered(scene: &Scene, light: &Light, ray: &Ray, way: f64, volume: f64) -> DVec3 {
    let arriving = incident(light, ray.at(way));
    let most = 3.0 / (3.0 * volume / (4.0 * PI)).powf(2.0 / 3.0);
    let share = match light {
        Light::Directional { .. } => 1.0,
        Light::Point { .. } | Light::Spot { .. } => (most * arriving.way * arriving.way).min(1.0),
    };
    // sin² of half the angle between the way of the light and the way to the eye
    let w = (ray.direction - arriving.to_light).length_squared() / 4.0;
    let reaches = arriving.irradiance * share * transmittance(&scene.medium, arriving.way);
    scene.medium.scattering() * phase(&scene.medium.phase, w) * reaches
}
