//! A bare tree, 6 m high, of more than 100,000 triangles: a trunk with limbs, and boughs of thin branches on them.

use std::f32::consts::TAU;

use glam::{Mat3, Quat, Vec3};
use serde_json::json;

use crate::glb::{Glb, Shape};
use crate::skin::rod;

/// The file `graphs/scenes/shadows/models/tree.glb`.
pub fn tree() -> Vec<u8> {
    let mut glb = Glb::default();
    let bark = glb.material("bark", [0.13, 0.10, 0.08], None);
    let mut chance = Chance(7);
    let boughs = [0, 1, 2].map(|_| {
        let mut bough = Shape::default();
        grow(&mut bough, &mut chance, Branch { foot: Vec3::ZERO, way: Vec3::Y, length: 1.9, radius: 0.024, order: 1 });
        glb.mesh("bough", &[(&bough, bark)])
    });
    let mut wood = Shape::default();
    let trunk =
        bend(&mut chance, Vec3::new(0.0, -0.2, 0.0), Vec3::new(0.04, 1.0, 0.0), 4.4, 0.12, 0.2, [0.21, 0.05], 14);
    join(&mut wood, &rod(&trunk, 18));
    let mut ends: Vec<(Vec3, Vec3, f32)> = vec![(trunk[14].0, trunk[14].0 - trunk[13].0, 1.0)];
    for k in 0..11 {
        let at = trunk[5 + k * 9 / 11];
        let lean = 0.62 - 0.035 * k as f32;
        let (sin, cos) = (2.4 * k as f32 + 0.4 * chance.signed()).sin_cos();
        let way = Vec3::new(cos * lean, 0.75 - lean * 0.4, sin * lean);
        let length = 2.3 - 0.13 * k as f32;
        let limb = bend(&mut chance, at.0, way, length, 0.22, 0.25, [0.45 * at.1 + 0.02, 0.018], 9);
        join(&mut wood, &rod(&limb, 9));
        for i in [4, 6, 9] {
            let along = (limb[i].0 - limb[i - 1].0).normalize();
            let aside = if i == 9 { Vec3::ZERO } else { along.cross(chance.direction()).normalize_or(Vec3::X) * 0.9 };
            ends.push((limb[i].0, along + aside, if i == 9 { 0.85 } else { 0.7 }));
        }
    }
    let wood = glb.mesh("wood", &[(&wood, bark)]);
    let mut roots = vec![glb.node("wood", Vec3::ZERO, Quat::IDENTITY, &json!({ "mesh": wood }), &[])];
    for (k, (foot, way, size)) in ends.into_iter().enumerate() {
        let roll = Quat::from_rotation_y(TAU * chance.unit());
        let turn = Quat::from_rotation_arc(Vec3::Y, way.normalize()) * roll;
        let what = json!({ "mesh": boughs[k % boughs.len()], "scale": [size, size, size] });
        roots.push(glb.node(&format!("bough {k}"), foot, turn, &what, &[]));
    }
    glb.finish(&roots)
}

/// Repeatable numbers.
struct Chance(u32);

impl Chance {
    /// 0..1.
    fn unit(&mut self) -> f32 {
        self.0 = self.0.wrapping_mul(747_796_405).wrapping_add(2_891_336_453);
        let word = ((self.0 >> ((self.0 >> 28) + 4)) ^ self.0).wrapping_mul(277_803_737);
        ((word >> 22) ^ word) as f32 / u32::MAX as f32
    }

    /// -1..1.
    fn signed(&mut self) -> f32 {
        2.0 * self.unit() - 1.0
    }

    fn direction(&mut self) -> Vec3 {
        let z = self.signed();
        let (sin, cos) = (TAU * self.unit()).sin_cos();
        let across = (1.0 - z * z).sqrt();
        Vec3::new(across * cos, z, across * sin)
    }
}

fn join(shape: &mut Shape, other: &Shape) {
    let first = shape.positions.len() as u32;
    shape.positions.extend(&other.positions);
    shape.normals.extend(&other.normals);
    shape.indices.extend(other.indices.iter().map(|i| i + first));
}

/// A way that wanders, and turns toward the sky: points with their radii.
#[allow(clippy::too_many_arguments, reason = "a branch is what it is")]
fn bend(
    chance: &mut Chance,
    foot: Vec3,
    way: Vec3,
    length: f32,
    wander: f32,
    rise: f32,
    radius: [f32; 2],
    steps: usize,
) -> Vec<(Vec3, f32)> {
    let mut way = way.normalize();
    let mut at = foot;
    let mut path = vec![(at, radius[0])];
    for i in 1..=steps {
        way = (way + wander * chance.direction() + rise * Vec3::Y / steps as f32).normalize();
        at += way * length / steps as f32;
        let share = i as f32 / steps as f32;
        path.push((at, radius[0] + (radius[1] - radius[0]) * share.sqrt()));
    }
    path
}

#[derive(Clone, Copy)]
struct Branch {
    foot: Vec3,
    way: Vec3,
    length: f32,
    radius: f32,
    /// 1 of a bough's stem; 4 of the finest.
    order: usize,
}

/// A branch and those on it.
fn grow(shape: &mut Shape, chance: &mut Chance, branch: Branch) {
    let Branch { foot, way, length, radius, order } = branch;
    let (steps, sides) = [(10, 6), (6, 4), (4, 3), (2, 3)][order - 1];
    let path = bend(chance, foot, way, length, 0.22, 0.1, [radius, 0.3 * radius], steps);
    join(shape, &rod(&path, sides as u32));
    let children = [7, 5, 3, 0][order - 1];
    for k in 0..children {
        let share = 0.2 + 0.78 * (k as f32 + 0.6 * chance.unit()) / children as f32;
        let place = share * steps as f32;
        let below = (place as usize).min(steps - 1);
        let (from, to) = (path[below], path[below + 1]);
        let along = (to.0 - from.0).normalize();
        let turn = Mat3::from_axis_angle(along, 2.4 * k as f32 + 0.6 * chance.signed());
        let aside = turn * along.any_orthonormal_vector();
        let child = Branch {
            foot: from.0.lerp(to.0, place - below as f32),
            way: 0.75 * along + (0.75 + 0.25 * chance.signed()) * aside,
            length: length * (0.60 - 0.22 * share) * (0.85 + 0.3 * chance.unit()),
            radius: (0.55 * radius).max(0.0032),
            order: order + 1,
        };
        grow(shape, chance, child);
    }
}
