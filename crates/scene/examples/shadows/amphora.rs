//! An amphora, 1 m high, its belly pierced by rows of openings.

use std::f32::consts::TAU;

use glam::{Mat3, Quat, Vec2, Vec3};
use serde_json::json;

use crate::glb::{Glb, Shape};
use crate::skin::rod;

/// (radius, height) of the outside from foot to lip, a curve through them.
const PROFILE: [(f32, f32); 12] = [
    (0.130, 0.00),
    (0.075, 0.04),
    (0.100, 0.10),
    (0.200, 0.22),
    (0.285, 0.38),
    (0.310, 0.50),
    (0.285, 0.62),
    (0.190, 0.73),
    (0.105, 0.80),
    (0.085, 0.88),
    (0.100, 0.95),
    (0.150, 1.00),
];
/// Of the wall, m.
const THICKNESS: f32 = 0.018;
/// Tiles of the wall: around, and from foot to lip.
const TILES: [usize; 2] = [18, 22];
/// Rows of tiles with openings in every other tile.
const PIERCED: [usize; 5] = [7, 9, 11, 13, 15];
/// Points on each side of a tile, and as many of a quarter of an opening.
const SIDE: usize = 4;
/// Half-axes of an opening, in tiles.
const OPENING: [f32; 2] = [0.40, 0.46];

/// The file `graphs/scenes/shadows/models/amphora.glb`.
pub fn amphora() -> Vec<u8> {
    let mut glb = Glb::default();
    let clay = glb.material("clay", [0.62, 0.30, 0.16], None);
    let mesh = glb.mesh("amphora", &[(&pot(), clay)]);
    let root = glb.node("amphora", Vec3::ZERO, Quat::IDENTITY, &json!({ "mesh": mesh }), &[]);
    glb.finish(&[root])
}

fn pot() -> Shape {
    let mut shape = wall();
    let path: Vec<(Vec3, f32)> = (0..=16)
        .map(|i| {
            let (sin, cos) = (i as f32 / 16.0 * 0.62 * TAU - 0.28 * TAU).sin_cos();
            (Vec3::new(0.165 + 0.105 * cos, 0.80 + 0.125 * sin, 0.0), 0.019 + 0.004 * sin.abs())
        })
        .collect();
    let handle = rod(&path, 12);
    for turn in [0.0, 0.5] {
        join(&mut shape, &handle, Mat3::from_rotation_y(turn * TAU));
    }
    shape
}

fn join(shape: &mut Shape, other: &Shape, turn: Mat3) {
    let first = shape.positions.len() as u32;
    shape.positions.extend(other.positions.iter().map(|p| turn * *p));
    shape.normals.extend(other.normals.iter().map(|n| turn * *n));
    shape.indices.extend(other.indices.iter().map(|i| i + first));
}

/// Of the outside at a share of the way from foot to lip: (radius, height) by Catmull and Rom's spline.
fn outline(share: f32) -> Vec2 {
    let last = PROFILE.len() - 1;
    let at = share * last as f32;
    let segment = (at as usize).min(last - 1);
    let t = at - segment as f32;
    let point = |i: usize| Vec2::from(PROFILE[i.min(last)]);
    let [a, b, c, d] = [point(segment.saturating_sub(1)), point(segment), point(segment + 1), point(segment + 2)];
    0.5 * (2.0 * b + (c - a) * t + (2.0 * a - 5.0 * b + 4.0 * c - d) * t * t + (3.0 * (b - c) + d - a) * t * t * t)
}

/// A point of the wall: around in tiles, up in tiles, outside or inside; and which way it looks.
fn point(place: Vec2, inside: bool) -> (Vec3, Vec3) {
    let share = place.y / TILES[1] as f32;
    let height = |y: f32| if inside { THICKNESS + y * (1.0 - THICKNESS) } else { y };
    let at = outline(share);
    let slope = outline((share + 1e-3).min(1.0)) - outline((share - 1e-3).max(0.0));
    let radius = at.x - if inside { THICKNESS } else { 0.0 };
    // the same number on both sides of where the circle closes
    let (sin, cos) = (TAU * (place.x % TILES[0] as f32) / TILES[0] as f32).sin_cos();
    let out = Vec3::new(cos, 0.0, -sin);
    let normal = (out * slope.y - Vec3::Y * slope.x).normalize();
    (out * radius + Vec3::Y * height(at.y), if inside { -normal } else { normal })
}

/// Collects quadrilaterals; corners that agree in place and normal are one vertex.
#[derive(Default)]
struct Wall {
    shape: Shape,
    known: std::collections::HashMap<[u32; 6], u32>,
}

impl Wall {
    fn vertex(&mut self, (position, normal): (Vec3, Vec3)) -> u32 {
        let key = [position.x, position.y, position.z, normal.x, normal.y, normal.z].map(f32::to_bits);
        *self.known.entry(key).or_insert_with(|| {
            self.shape.positions.push(position);
            self.shape.normals.push(normal);
            self.shape.positions.len() as u32 - 1
        })
    }

    /// Counter-clockwise.
    fn quad(&mut self, corners: [(Vec3, Vec3); 4]) {
        let [a, b, c, d] = corners.map(|corner| self.vertex(corner));
        for triangle in [[a, b, c], [a, c, d]] {
            if triangle[0] != triangle[1] && triangle[1] != triangle[2] && triangle[2] != triangle[0] {
                self.shape.indices.extend(triangle);
            }
        }
    }

    /// Between two lines of places, on the outside or the inside; `low` runs with the angle, `high` is above it.
    fn strip(&mut self, low: [Vec2; 2], high: [Vec2; 2], inside: bool) {
        let corners = [low[0], low[1], high[1], high[0]].map(|place| point(place, inside));
        let [a, b, c, d] = corners;
        self.quad(if inside { [b, a, d, c] } else { corners });
    }

    /// From the outside at an edge of the wall to the inside.
    fn edge(&mut self, from: Vec2, to: Vec2) {
        let [a, b, c, d] = [(from, true), (to, true), (to, false), (from, false)].map(|(p, inside)| point(p, inside).0);
        let normal = (c - a).cross(d - b).normalize();
        self.quad([a, b, c, d].map(|position| (position, normal)));
    }
}

fn wall() -> Shape {
    let mut wall = Wall::default();
    for (row, column) in (0..TILES[1]).flat_map(|row| (0..TILES[0]).map(move |column| (row, column))) {
        let corner = Vec2::new(column as f32, row as f32);
        let pierced = PIERCED.contains(&row) && (column + row / 2) % 2 == 0;
        for inside in [false, true] {
            if pierced {
                let (rim, hole) = rim_and_hole(corner);
                for k in 0..4 * SIDE {
                    let next = (k + 1) % (4 * SIDE);
                    wall.strip([rim[k], rim[next]], [hole[k], hole[next]], inside);
                }
            } else {
                let at = |i: usize, j: usize| corner + Vec2::new(i as f32, j as f32) / SIDE as f32;
                for (i, j) in (0..SIDE).flat_map(|j| (0..SIDE).map(move |i| (i, j))) {
                    wall.strip([at(i, j), at(i + 1, j)], [at(i, j + 1), at(i + 1, j + 1)], inside);
                }
            }
        }
        if pierced {
            let (_, hole) = rim_and_hole(corner);
            (0..4 * SIDE).for_each(|k| wall.edge(hole[(k + 1) % (4 * SIDE)], hole[k]));
        }
    }
    let top = TILES[1] as f32;
    for k in 0..TILES[0] * SIDE {
        let [from, to] = [k, k + 1].map(|k| (k % (TILES[0] * SIDE)) as f32 / SIDE as f32);
        wall.edge(Vec2::new(to, top), Vec2::new(from, top));
        // under the foot, and the floor within
        for inside in [false, true] {
            let down = if inside { Vec3::Y } else { Vec3::NEG_Y };
            let [a, b] = [from, to].map(|x| point(Vec2::new(x, 0.0), inside).0);
            let middle = Vec3::new(0.0, a.y, 0.0);
            let corners = if inside { [middle, a, b, b] } else { [middle, b, a, a] };
            wall.quad(corners.map(|position| (position, down)));
        }
    }
    wall.shape
}

/// The sides of a tile, counter-clockwise, and the opening's outline.
fn rim_and_hole(corner: Vec2) -> (Vec<Vec2>, Vec<Vec2>) {
    let sides = [(Vec2::ZERO, Vec2::X), (Vec2::X, Vec2::Y), (Vec2::ONE, Vec2::NEG_X), (Vec2::Y, Vec2::NEG_Y)];
    let rim: Vec<Vec2> = sides
        .iter()
        .flat_map(|(start, way)| (0..SIDE).map(move |k| corner + *start + *way * (k as f32 / SIDE as f32)))
        .collect();
    let middle = corner + Vec2::splat(0.5);
    let hole = rim.iter().map(|place| middle + (*place - middle).normalize() * Vec2::from(OPENING)).collect();
    (rim, hole)
}
