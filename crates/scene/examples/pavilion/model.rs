//! An octagonal garden pavilion, open to all sides, 7 m across its steps and 7 m high, lit by lanterns.

use std::f32::consts::{FRAC_PI_4, FRAC_PI_8, TAU};

use glam::{Mat3, Quat, Vec3};
use serde_json::json;

use crate::build::{Turning, cuboid, turned};
use crate::glb::{Glb, Shape};
use crate::pictures;

/// Height of the floor.
const FLOOR: f32 = 0.45;
/// Distance of the columns from the axis.
const COLUMNS: f32 = 2.75;
/// Upper end of the columns.
const CAPITALS: f32 = 3.4;
/// Lamps in the four lanterns between the columns: distance from the axis and height.
const LANTERN: (f32, f32) = (1.95, 2.65);
/// Height of the lamp in the middle.
const CHANDELIER: f32 = 2.95;

const OCTAGON: Turning = Turning { sides: 8, round: false, ring: false, uv_scale: 1.0 };
const ROUND: Turning = Turning { sides: 24, round: true, ring: false, uv_scale: 1.0 };

/// The file `graphs/scenes/models/pavilion.glb`.
pub fn pavilion() -> Vec<u8> {
    let mut glb = Glb::default();
    let paving = glb.texture("paving", &pictures::paving());
    let tiles = glb.texture("tiles", &pictures::tiles());
    let stone = glb.material("stone", [0.62, 0.58, 0.52], Some(paving));
    let marble = glb.material("marble", [0.78, 0.74, 0.68], None);
    let roof = glb.material("roof tiles", [0.30, 0.52, 0.50], Some(tiles));
    let ceiling = glb.material("ceiling", [0.42, 0.27, 0.16], None);
    let wood = glb.material("bench wood", [0.36, 0.19, 0.09], None);
    let iron = glb.material("iron", [0.06, 0.06, 0.07], None);
    let gold = glb.material("gilding", [0.80, 0.58, 0.20], None);
    let leaves = glb.material("leaves", [0.09, 0.22, 0.06], None);
    let grass = glb.material("grass", [0.13, 0.24, 0.08], None);
    let still = Quat::IDENTITY;

    let mut roots = Vec::new();
    let mut fixed = |glb: &mut Glb, name: &str, parts: &[(&Shape, usize)]| {
        let mesh = glb.mesh(name, parts);
        roots.push(glb.node(name, Vec3::ZERO, still, &json!({ "mesh": mesh }), &[]));
    };
    fixed(&mut glb, "steps", &[(&steps(), stone)]);
    fixed(&mut glb, "beam", &[(&beam(), marble)]);
    fixed(&mut glb, "roof", &[(&roof_tiles(), roof), (&roof_underside(), ceiling)]);
    fixed(&mut glb, "finial", &[(&finial(), gold)]);
    fixed(&mut glb, "garden", &[(&lawn(), grass), (&paths(), stone), (&hedges(), leaves)]);

    let column = glb.mesh("column", &[(&column(), marble)]);
    for k in 0..8 {
        let place = around(FRAC_PI_8 + k as f32 * FRAC_PI_4, COLUMNS, FLOOR);
        roots.push(glb.node(&format!("column {k}"), place, still, &json!({ "mesh": column }), &[]));
    }
    let bench = glb.mesh("bench", &[(&bench(), wood)]);
    for k in [1, 3, 5, 7] {
        let angle = k as f32 * FRAC_PI_4;
        let turn = Quat::from_rotation_y(angle + TAU / 4.0);
        roots.push(glb.node(&format!("bench {k}"), around(angle, 2.25, FLOOR), turn, &json!({ "mesh": bench }), &[]));
    }
    let lantern = glb.mesh("lantern", &[(&lantern(), iron)]);
    let lamp = json!({ "type": "point", "name": "lantern", "color": [1.0, 0.72, 0.42], "intensity": 7.0 });
    let lamp = glb.light(lamp);
    for k in 0..4 {
        let flame = glb.node(&format!("lamp {k}"), Vec3::ZERO, still, &lamp, &[]);
        let place = around(k as f32 * TAU / 4.0, LANTERN.0, LANTERN.1);
        roots.push(glb.node(&format!("lantern {k}"), place, still, &json!({ "mesh": lantern }), &[flame]));
    }
    let lamp =
        glb.light(json!({ "type": "point", "name": "chandelier", "color": [1.0, 0.82, 0.58], "intensity": 12.0 }));
    let flame = glb.node("lamp in the middle", Vec3::ZERO, still, &lamp, &[]);
    let middle = Vec3::new(0.0, CHANDELIER, 0.0);
    roots.push(glb.node("chandelier", middle, still, &json!({ "mesh": lantern }), &[flame]));
    let cone = json!({ "outerConeAngle": 0.5 });
    let spot = glb.light(
        json!({ "type": "spot", "name": "moonlight", "color": [0.6, 0.75, 1.0], "intensity": 60.0, "spot": cone }),
    );
    let down = Quat::from_rotation_arc(Vec3::NEG_Z, Vec3::new(-0.62, -1.0, -0.1).normalize());
    roots.push(glb.node("spot above the trees", Vec3::new(6.2, 8.2, 0.5), down, &spot, &[]));
    let perspective = json!({ "yfov": 0.8, "znear": 0.1, "aspectRatio": 1.5 });
    let camera = glb.add("cameras", json!({ "type": "perspective", "perspective": perspective }));
    let eye = Vec3::new(-3.1, 1.65, 11.2);
    let forward = (Vec3::new(0.0, 3.0, 0.0) - eye).normalize();
    let right = forward.cross(Vec3::Y).normalize();
    let turn = Quat::from_mat3(&Mat3::from_cols(right, right.cross(forward), -forward));
    roots.push(glb.node("eye", eye, turn, &json!({ "camera": camera }), &[]));
    glb.finish(&roots)
}

/// A point at an angle about +y, 0 toward +z.
fn around(angle: f32, radius: f32, height: f32) -> Vec3 {
    Vec3::new(radius * angle.sin(), height, radius * angle.cos())
}

fn steps() -> Shape {
    let profile =
        [(0.0, -0.1), (3.9, -0.1), (3.9, 0.15), (3.6, 0.15), (3.6, 0.3), (3.3, 0.3), (3.3, FLOOR), (0.0, FLOOR)];
    turned(&profile, OCTAGON)
}

/// Foot on the origin: plinth, torus mouldings, a shaft that swells, and a capital.
fn column() -> Shape {
    let top = CAPITALS - FLOOR;
    let profile = [
        (0.0, 0.0),
        (0.24, 0.0),
        (0.24, 0.10),
        (0.225, 0.11),
        (0.235, 0.14),
        (0.225, 0.17),
        (0.19, 0.19),
        (0.185, 0.23),
        (0.165, 0.26),
        (0.166, 0.7),
        (0.164, 1.2),
        (0.155, 1.8),
        (0.142, 2.3),
        (0.135, top - 0.38),
        (0.16, top - 0.36),
        (0.16, top - 0.33),
        (0.14, top - 0.31),
        (0.15, top - 0.22),
        (0.19, top - 0.14),
        (0.25, top - 0.10),
        (0.25, top),
        (0.0, top),
    ];
    turned(&profile, ROUND)
}

fn beam() -> Shape {
    let profile = [
        (2.6, CAPITALS),
        (3.15, CAPITALS),
        (3.15, CAPITALS + 0.16),
        (3.22, CAPITALS + 0.2),
        (3.22, CAPITALS + 0.34),
        (2.6, CAPITALS + 0.34),
    ];
    turned(&profile, Turning { ring: true, ..OCTAGON })
}

/// From the eaves to the neck of the finial, a flared, then steep curve.
const ROOF: [(f32, f32); 10] = [
    (3.75, 3.66),
    (3.3, 3.86),
    (2.8, 4.1),
    (2.3, 4.38),
    (1.8, 4.72),
    (1.3, 5.12),
    (0.85, 5.55),
    (0.5, 5.95),
    (0.25, 6.3),
    (0.14, 6.55),
];

fn roof_tiles() -> Shape {
    let mut profile = vec![(3.75, 3.6)];
    profile.extend(ROOF);
    profile.push((0.0, 6.55));
    turned(&profile, OCTAGON)
}

/// Closes the roof from below; it rests in the beam, so that no edge of the two coincides.
fn roof_underside() -> Shape {
    let profile = [(0.0, 4.5), (2.5, 3.9), (2.65, 3.7), (3.15, 3.7), (3.75, 3.6)];
    turned(&profile, OCTAGON)
}

fn finial() -> Shape {
    let mut profile = vec![(0.0, 6.5), (0.17, 6.5), (0.17, 6.6), (0.09, 6.64), (0.07, 6.7)];
    profile.extend((1..12).map(|i| {
        let (sin, cos) = (i as f32 / 12.0 * TAU / 2.0).sin_cos();
        (0.06 + 0.11 * sin, 6.84 - 0.14 * cos)
    }));
    profile.extend([(0.05, 7.0), (0.03, 7.1), (0.0, 7.5)]);
    turned(&profile, ROUND)
}

/// The lamp hangs in the origin, free to the sides: foot, four posts, roof, chain.
fn lantern() -> Shape {
    let four = Turning { sides: 4, ..OCTAGON };
    let mut shape = turned(&[(0.0, -0.2), (0.06, -0.2), (0.13, -0.16), (0.13, -0.14), (0.0, -0.14)], four);
    let roof = turned(&[(0.0, 0.16), (0.17, 0.16), (0.17, 0.18), (0.1, 0.23), (0.03, 0.3), (0.0, 0.3)], four);
    shape.join(&roof, Vec3::ZERO, Mat3::IDENTITY);
    for (x, z) in [(1.0, 1.0), (1.0, -1.0), (-1.0, 1.0), (-1.0, -1.0)] {
        let post = cuboid(Vec3::new(0.085 * x, 0.01, 0.085 * z), Vec3::new(0.014, 0.3, 0.014));
        shape.join(&post, Vec3::ZERO, Mat3::IDENTITY);
    }
    let chain = cuboid(Vec3::new(0.0, 0.75, 0.0), Vec3::new(0.015, 0.92, 0.015));
    shape.join(&chain, Vec3::ZERO, Mat3::IDENTITY);
    shape
}

/// Along x, its back toward +z.
fn bench() -> Shape {
    let mut shape = cuboid(Vec3::new(0.0, 0.44, 0.0), Vec3::new(1.5, 0.05, 0.42));
    for x in [-0.6, 0.6] {
        shape.join(&cuboid(Vec3::new(x, 0.21, 0.0), Vec3::new(0.08, 0.41, 0.36)), Vec3::ZERO, Mat3::IDENTITY);
    }
    shape
}

fn lawn() -> Shape {
    // Its edge lies beyond the fog.
    cuboid(Vec3::new(0.0, -0.5, 0.0), Vec3::new(160.0, 1.0, 160.0))
}

/// From the steps to the south and to the north.
fn paths() -> Shape {
    let mut shape = Shape::default();
    for z in [1.0, -1.0] {
        let path = cuboid(Vec3::new(0.0, 0.0, z * 8.3), Vec3::new(1.8, 0.06, 9.4));
        shape.join(&path, Vec3::ZERO, Mat3::IDENTITY);
    }
    shape
}

/// Eight pieces around the steps, two of them left out where the paths run.
fn hedges() -> Shape {
    let mut shape = Shape::default();
    for k in [1, 2, 3, 5, 6, 7] {
        let angle = k as f32 * FRAC_PI_4;
        let turn = Mat3::from_rotation_y(angle);
        let piece = cuboid(Vec3::new(0.0, 0.3, 0.0), Vec3::new(3.9, 0.66, 0.5));
        shape.join(&piece, around(angle, 5.6, 0.0), turn);
    }
    for (x, z) in [(1.0, 1.0), (1.0, -1.0), (-1.0, 1.0), (-1.0, -1.0)] {
        // A clipped ball beside each end of the path.
        let ball: Vec<(f32, f32)> = (0..=12)
            .map(|i| (i as f32 / 12.0 * TAU / 2.0).sin_cos())
            .map(|(sin, cos)| (if sin < 1e-6 { 0.0 } else { 0.42 * sin }, 0.38 - 0.42 * cos))
            .collect();
        shape.join(&turned(&ball, ROUND), Vec3::new(1.55 * x, 0.0, 5.9 * z), Mat3::IDENTITY);
    }
    shape
}
