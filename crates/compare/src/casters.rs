//! What hides lights, for the truth: spheres and tori as they are, all else triangle by triangle.

use tyndall_scene::Scene;
use tyndall_shaders::ray::Ray;
use tyndall_shaders::scene::{Caster, Light};
use tyndall_shaders::shadows::lit_intervals;

use crate::round::Round;

/// A lit part shorter than this part of its ray is no part: rounding makes such where casters touch.
const SLIVER: f64 = 1e-9;
/// A surface is lit where the last lit part ends within this part of the way to it.
const AT_SURFACE: f64 = 1e-5;

/// What a scene casts shadows with, and what its rays meet.
#[derive(Debug, Clone)]
pub(crate) struct Casters {
    round: Vec<Round>,
    triangles: Vec<Caster>,
    /// Everything round that is seen, casters or not.
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

    /// Where a ray ends that meets a triangle after `way` metres: no later than at what the triangles stand for.
    pub fn end(&self, ray: &Ray, way: f64) -> f64 {
        self.seen.iter().filter_map(|round| round.entry(ray, way)).fold(way, f64::min)
    }

    /// The parts of the first `way` metres of a ray that a light reaches, in order, m.
    pub fn lit(&self, light: &Light, ray: &Ray, way: f64) -> Vec<[f64; 2]> {
        let mut lit = lit_intervals(light, &self.triangles, ray, way);
        for round in &self.round {
            for [from, to] in round.hidden(light, ray, way) {
                let beside = |[start, end]: [f64; 2]| [[start, end.min(from)], [start.max(to), end]];
                lit = lit.into_iter().flat_map(beside).filter(|[start, end]| end > start).collect();
            }
        }
        lit.retain(|[start, end]| end.is_infinite() || end - start > SLIVER * end);
        lit
    }

    /// Whether the light reaches the surface at the end of the way, by the lit parts before it.
    pub fn reaches(lit: &[[f64; 2]], way: f64) -> bool {
        lit.last().is_some_and(|[_, end]| *end >= way * (1.0 - AT_SURFACE))
    }
}
