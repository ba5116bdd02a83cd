//! What hides lights, for the truth: exact spheres and tori, and the triangles of everything else.

use tyndall_scene::Scene;
use tyndall_shaders::ray::Ray;
use tyndall_shaders::scene::{Caster, Light};
use tyndall_shaders::shadows::lit_intervals;

use crate::round::Round;

/// Lit parts shorter than this fraction of their ray are dropped: rounding makes them where casters touch.
const SLIVER: f64 = 1e-9;
/// A surface is lit if the last lit part ends within this fraction of the distance to it.
const AT_SURFACE: f64 = 1e-5;

/// The casters of a scene, and what its rays meet.
#[derive(Debug, Clone)]
pub(crate) struct Casters {
    round: Vec<Round>,
    triangles: Vec<Caster>,
    /// Everything round that is visible, casters or not.
    seen: Vec<Round>,
}

impl Casters {
    /// Of a scene at time 0.
    pub fn new(scene: &Scene) -> Self {
        let frame = scene.at(0.0);
        let (mut round, mut triangles, mut seen) = (Vec::new(), Vec::new(), Vec::new());
        for (instance, world) in scene.instances.iter().zip(&frame.transforms) {
            let shape = instance.primitive.and_then(|primitive| Round::new(primitive, *world));
            seen.extend(shape);
            match shape {
                _ if !instance.casts_shadow => {}
                Some(shape) => round.push(shape),
                None => {
                    let mesh = &instance.mesh;
                    let corner = |index: u32| world.transform_point3(mesh.positions[index as usize].as_dvec3());
                    triangles.extend(mesh.triangles.iter().map(|triangle| triangle.map(corner)));
                }
            }
        }
        Self { round, triangles, seen }
    }

    /// Where a ray ends that meets a triangle after `distance` metres: at the latest at the round shape that the triangles
    /// approximate.
    pub fn end(&self, ray: &Ray, distance: f64) -> f64 {
        self.seen.iter().filter_map(|round| round.entry(ray, distance)).fold(distance, f64::min)
    }

    /// The parts of the first `distance` metres of a ray that a light reaches, in order, m.
    pub fn lit(&self, light: &Light, ray: &Ray, distance: f64) -> Vec<[f64; 2]> {
        let mut lit = lit_intervals(light, &self.triangles, ray, distance);
        for round in &self.round {
            for [from, to] in round.hidden(light, ray, distance) {
                let beside = |[start, end]: [f64; 2]| [[start, end.min(from)], [start.max(to), end]];
                lit = lit.into_iter().flat_map(beside).filter(|[start, end]| end > start).collect();
            }
        }
        lit.retain(|[start, end]| end.is_infinite() || end - start > SLIVER * end);
        lit
    }

    /// Whether the light reaches the surface at this distance, given the lit parts before it.
    pub fn reaches(lit: &[[f64; 2]], distance: f64) -> bool {
        lit.last().is_some_and(|[_, end]| *end >= distance * (1.0 - AT_SURFACE))
    }
}
