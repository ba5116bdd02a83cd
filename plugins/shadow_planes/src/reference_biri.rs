//! The published shadow planes in double precision: plane after plane, with neither slices nor a light's frame.

use std::collections::BTreeMap;

use glam::DVec3;
use tyndall_plugin::{Outputs, Pixel, ReferenceInput, rgba};
use tyndall_shaders::airlight::airlight;
use tyndall_shaders::lights::lit_bit;
use tyndall_shaders::ray::Ray;
use tyndall_shaders::scene::{Camera, Caster, Light};
use tyndall_shaders::shadows::{Source, UNSEEN, edge_touches, facing};

/// What eight bits hold.
const STENCIL_MAX: i32 = 255;

/// What lies behind a silhouette edge.
struct Plane {
    a: DVec3,
    b: DVec3,
    /// Triangles to the left of the way from a to b as the light sees it, less those to the right.
    excess: i32,
}

/// A plane where a ray crosses it.
struct Crossed {
    /// m.
    x: f64,
    /// It faces the eye: the shadow is behind it.
    facing: bool,
    /// In the order, m.
    place: f64,
}

/// Airlight by the planes, drawn in their order with a stencil or without.
pub(crate) fn biri(input: &ReferenceInput<'_>) -> Outputs {
    let (scene, stencil) = (input.scene()?, input.is_on("stencil"));
    let planes: Vec<Vec<Plane>> =
        scene.lights.iter().map(|light| silhouette(light, &scene.casters, &scene.camera)).collect();
    let pixels = input.pixels("radiance", |Pixel { ray, distance, .. }| {
        let (mut sum, mut bits) = (DVec3::ZERO, [0_u32; 4]);
        for (index, (light, planes)) in scene.lights.iter().zip(&planes).enumerate() {
            let crossed = crossed(light, planes, ray, *distance);
            let volumes = volumes_of_surface(&crossed);
            if volumes == 0
                && let Some((channel, bit)) = lit_bit(index)
            {
                bits[channel] |= bit;
            }
            let before = |x: f64| airlight(light, &scene.medium, ray, 0.0, x);
            sum += drawn(&crossed, volumes, stencil, *distance, before);
        }
        (sum, bits)
    })?;
    let (radiance, lit): (Vec<_>, Vec<_>) = pixels.into_iter().unzip();
    Ok(BTreeMap::from([("radiance", rgba(radiance)), ("lit", lit.concat().into())]))
}

/// The planes before the surface that face the eye, less those that do not.
fn volumes_of_surface(crossed: &[Crossed]) -> i32 {
    let facing = crossed.iter().filter(|plane| plane.facing).count() as i32;
    let averted = crossed.len() as i32 - facing;
    (facing.min(STENCIL_MAX) - averted).max(0)
}

/// The surface, then the planes.
fn drawn(crossed: &[Crossed], volumes: i32, stencil: bool, way: f64, before: impl Fn(f64) -> DVec3) -> DVec3 {
    let mut sum = if volumes == 0 { before(way) } else { DVec3::ZERO };
    let mut count = volumes;
    for plane in crossed {
        let passes = !stencil || count == i32::from(plane.facing);
        let sign = if plane.facing { 1.0 } else { -1.0 };
        if passes {
            sum += sign * before(plane.x);
        }
        count = (count - sign as i32).clamp(0, STENCIL_MAX);
    }
    sum
}

/// Those that a ray crosses before its end, the farthest edges first.
fn crossed(light: &Light, planes: &[Plane], ray: &Ray, way: f64) -> Vec<Crossed> {
    let crossing = |plane: &Plane| {
        // Behind the edge a point is b + s (a - b) + t away, with 0 < s < 1 and t > 0.
        let away = |point: DVec3| match *light {
            Light::Point { position, .. } | Light::Spot { position, .. } => point - position,
            Light::Directional { direction, .. } => direction,
        };
        let normal = (plane.a - plane.b).cross(away(plane.b));
        let rise = normal.dot(ray.direction);
        let x = normal.dot(plane.a - ray.origin) / rise;
        let point = ray.at(x);
        let (to_a, to_b) = (normal.cross(away(plane.a)), normal.cross(away(plane.b)));
        let between = to_a.dot(point - plane.a) * to_a.dot(plane.b - plane.a) > 0.0
            && to_b.dot(point - plane.b) * to_b.dot(plane.a - plane.b) > 0.0;
        let outward = (plane.b - plane.a).cross(normal);
        let behind = outward.dot(point - plane.a) * outward.dot(away(plane.a)) > 0.0;
        // What is left of the way from a to b, as the light sees it, the normal points away from.
        let facing = (plane.excess > 0) == (rise < 0.0);
        let place = (0.5 * (plane.a + plane.b) - ray.origin).length();
        (between && behind && x > 0.0 && x < way).then_some(Crossed { x, facing, place })
    };
    let mut crossed: Vec<Crossed> = planes.iter().filter_map(crossing).collect();
    crossed.sort_by(|a, b| b.place.total_cmp(&a.place));
    crossed
}

/// The edges with more triangles on one side than on the other, but for those that pass through the eye. Corners at one
/// position are one vertex.
fn silhouette(light: &Light, casters: &[Caster], camera: &Camera) -> Vec<Plane> {
    let mut edges: BTreeMap<[[u64; 3]; 2], Plane> = BTreeMap::new();
    for triangle in casters {
        let facing = i32::from(facing(Source::of(light), triangle));
        let [a, b, c] = *triangle;
        for (from, to) in [(a, b), (b, c), (c, a)] {
            let bits = |v: DVec3| (v + DVec3::ZERO).to_array().map(f64::to_bits);
            let forward = bits(from) < bits(to);
            let (a, b) = if forward { (from, to) } else { (to, from) };
            let plane = edges.entry([bits(a), bits(b)]).or_insert(Plane { a, b, excess: 0 });
            plane.excess += if forward { facing } else { -facing };
        }
    }
    edges
        .into_values()
        .filter(|plane| {
            plane.excess != 0 && !edge_touches(camera.position, UNSEEN * camera.nearest, [plane.a, plane.b])
        })
        .collect()
}
