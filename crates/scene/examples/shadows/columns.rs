//! A row of fluted columns on steps, with a beam above.

use std::f32::consts::TAU;

use glam::{Quat, Vec3};
use serde_json::json;

use crate::glb::{Glb, Shape};
use crate::skin::{skin, turned};

/// How many, and their distance from one another, m.
const COLUMNS: usize = 9;
const APART: f32 = 2.0;
/// Of a column without its plinth and capital, m.
const SHAFT: (f32, f32) = (0.22, 4.7);
const FLUTES: usize = 20;

/// The file `graphs/scenes/shadows/models/columns.glb`.
pub fn columns() -> Vec<u8> {
    let mut glb = Glb::default();
    let marble = glb.material("marble", [0.66, 0.62, 0.56], None);
    let parts = [("shaft", shaft()), ("foot", foot()), ("capital", capital())];
    let meshes = parts.map(|(name, shape)| (name, glb.mesh(name, &[(&shape, marble)])));
    let mut roots = Vec::new();
    for k in 0..COLUMNS {
        let place = Vec3::new((k as f32 - (COLUMNS - 1) as f32 / 2.0) * APART, 0.0, 0.0);
        for (name, mesh) in meshes {
            roots.push(glb.node(&format!("{name} {k}"), place, Quat::IDENTITY, &json!({ "mesh": mesh }), &[]));
        }
    }
    glb.finish(&roots)
}

fn shaft() -> Shape {
    let (low, high) = SHAFT;
    let ring = |share: f32| -> Vec<Vec3> {
        // it swells a third of the way up, and is slimmer at the top
        let radius = 0.36 * (1.0 - 0.17 * share * share);
        let sides = FLUTES * 4;
        let point = |k: usize| {
            let (sin, cos) = (TAU * k as f32 / sides as f32).sin_cos();
            let groove = 1.0 - 0.075 * (TAU * (k % 4) as f32 / 8.0).sin();
            Vec3::new(cos, 0.0, -sin) * radius * groove + Vec3::Y * (low + (high - low) * share)
        };
        (0..sides).map(point).collect()
    };
    let mut rings = vec![vec![Vec3::Y * (low - 0.05)]];
    rings.extend((0..=8).map(|i| ring(i as f32 / 8.0)));
    rings.push(vec![Vec3::Y * (high + 0.05)]);
    skin(&rings)
}

fn foot() -> Shape {
    let profile = [
        (0.0, 0.0),
        (0.47, 0.0),
        (0.48, 0.01),
        (0.48, 0.09),
        (0.45, 0.11),
        (0.42, 0.13),
        (0.41, 0.16),
        (0.43, 0.19),
        (0.41, 0.22),
        (0.37, 0.24),
        (0.0, 0.25),
    ];
    turned(&profile, 32)
}

fn capital() -> Shape {
    let top = SHAFT.1;
    let profile = [
        (0.0, top - 0.02),
        (0.30, top - 0.02),
        (0.33, top),
        (0.33, top + 0.04),
        (0.31, top + 0.06),
        (0.36, top + 0.14),
        (0.46, top + 0.20),
        (0.47, top + 0.21),
        (0.47, top + 0.30),
        (0.0, top + 0.31),
    ];
    turned(&profile, 32)
}
