//! A valley between ranges of mountains, 44 km deep, as one sees it from the place of the scene's camera.
//!
//! The mesh is a fan before that place, its rows farther apart the farther they are: on the picture all triangles are
//! about equally large.

use std::io::Cursor;

use glam::{DVec2, DVec3, Quat, Vec3};
use image::codecs::jpeg::JpegEncoder;
use image::{Rgb, RgbImage};
use serde_json::json;

use crate::erosion::{CELL, Heights};
use crate::glb::{Glb, Shape};
use crate::noise::{fractal, noise};

/// Cells of the ground: 50 by 50 km.
const CELLS: usize = 400;
/// The eye stands this far from the near edge, in the middle, m.
const BEHIND: f64 = 4000.0;
/// Rows and columns of the mesh.
const MESH: [usize; 2] = [168, 104];
/// First and last row of the mesh, m from the eye.
const NEAR: f64 = 900.0;
const FAR: f64 = 45_000.0;
/// Half the width of the fan over its depth.
const SPREAD: f64 = 0.55;
const TEXTURE: [u32; 2] = [896, 768];
const QUALITY: u8 = 82;

/// The file `graphs/scenes/models/terrain.glb`.
pub fn terrain() -> Vec<u8> {
    let ground = Ground::new();
    let mut glb = Glb::default();
    let view = glb.view(&ground.picture());
    let image = glb.add("images", json!({ "name": "ground", "bufferView": view, "mimeType": "image/jpeg" }));
    let sampler = glb.add("samplers", json!({ "wrapS": 33071, "wrapT": 33071 }));
    let texture = glb.add("textures", json!({ "source": image, "sampler": sampler }));
    let material = glb.material("ground", [1.0; 3], Some(texture));
    let mesh = glb.mesh("terrain", &[(&ground.mesh(), material)]);
    let root = glb.node("terrain", Vec3::ZERO, Quat::IDENTITY, &json!({ "mesh": mesh }), &[]);
    glb.finish(&[root])
}

/// Smoothly 0 below `from`, 1 above `to`.
fn ramp(from: f64, to: f64, value: f64) -> f64 {
    let t = ((value - from) / (to - from)).clamp(0.0, 1.0);
    t * t * (3.0 - 2.0 * t)
}

struct Ground(Heights);

impl Ground {
    fn new() -> Self {
        let place = |column: usize, row: usize| {
            let side = CELLS as f64 * CELL;
            DVec2::new(column as f64 * CELL - side / 2.0, row as f64 * CELL - side + BEHIND)
        };
        let uplift = |column, row| {
            let at = place(column, row);
            let depth = -at.y;
            // a valley that winds away from the eye between spurs of the mountains, and higher ranges behind
            let winding = 1500.0 * noise(depth / 5200.0, 0.5, 90) + 1400.0 * noise(depth / 14_000.0, 0.5, 91);
            let width = 350.0 + 900.0 * ramp(8000.0, 0.0, depth);
            let valley = ramp(width, width + 2600.0, (at.x - winding).abs());
            let ranges = 0.85 + 0.9 * fractal(at.x / 9000.0, at.y / 6000.0, 3, 20);
            let distance = 0.20 + 0.95 * ramp(1500.0, 8000.0, depth) + 0.65 * ramp(12_000.0, 30_000.0, depth);
            // the range that closes the valley
            let end = ramp(25_000.0, 33_000.0, depth);
            340.0 * (0.07 + 0.93 * valley.max(end)) * ranges.max(0.15) * distance
        };
        let first = |column, row| {
            let at = place(column, row);
            60.0 * fractal(at.x / 3000.0, at.y / 3000.0, 6, 40) + 60.0
        };
        Self(Heights::eroded(CELLS, CELLS, uplift, first))
    }

    /// Height at a place, m; the eye stands above (0, 0) and looks to −z.
    fn height(&self, at: DVec2) -> f64 {
        let side = CELLS as f64 * CELL;
        let rough = self.0.at(at.x + side / 2.0, at.y + side - BEHIND);
        rough + 26.0 * fractal(at.x / 260.0, at.y / 260.0, 4, 60)
    }

    fn normal(&self, at: DVec2, step: f64) -> DVec3 {
        let (x, z) = (DVec2::new(step, 0.0), DVec2::new(0.0, step));
        let across = self.height(at + x) - self.height(at - x);
        let along = self.height(at + z) - self.height(at - z);
        DVec3::new(-across, 2.0 * step, -along).normalize()
    }

    /// The colour of the ground, linear.
    fn albedo(&self, at: DVec2, step: f64) -> [f64; 3] {
        let height = self.height(at);
        let normal = self.normal(at, step.max(20.0));
        let patches = fractal(at.x / 900.0, at.y / 900.0, 6, 70);
        let grain = noise(at.x / 31.0, at.y / 31.0, 80);
        let mut color = mix([0.062, 0.090, 0.030], [0.115, 0.120, 0.050], ramp(-0.2, 0.4, patches));
        let forest = ramp(0.05, -0.15, patches) * ramp(1250.0, 850.0, height + 260.0 * patches);
        color = mix(color, [0.030, 0.055, 0.022], forest);
        let rock = mix([0.105, 0.098, 0.090], [0.165, 0.152, 0.138], 0.5 + 0.5 * grain);
        color = mix(color, rock, ramp(0.80, 0.70, normal.y + 0.10 * patches));
        color = mix(color, rock, ramp(1250.0, 1650.0, height + 320.0 * patches));
        let snow = ramp(1500.0, 1900.0, height + 450.0 * patches) * ramp(0.60, 0.74, normal.y + 0.06 * grain);
        color = mix(color, [0.80, 0.83, 0.88], snow);
        color.map(|channel| channel * (1.0 + 0.12 * grain))
    }

    /// Place of a point of the fan, both coordinates 0..1: from the left to the right, and from far to near. Depths are
    /// whole metres, so that roots of other machines give the same.
    fn place(u: f64, v: f64) -> DVec2 {
        let depth = (NEAR * (FAR / NEAR).powf(1.0 - v)).round();
        DVec2::new((2.0 * u - 1.0) * SPREAD * (depth + 1200.0), -depth)
    }

    fn mesh(&self) -> Shape {
        let [rows, columns] = MESH;
        let mut shape = Shape::default();
        for row in 0..rows {
            for column in 0..columns {
                let (u, v) = (column as f64 / (columns - 1) as f64, row as f64 / (rows - 1) as f64);
                let at = Self::place(u, v);
                shape.positions.push(DVec3::new(at.x, self.height(at), at.y).as_vec3());
                shape.normals.push(self.normal(at, (0.005 * at.y.abs()).max(12.0)).as_vec3());
                shape.uvs.push(DVec2::new(u, v).as_vec2());
            }
        }
        for row in 0..rows - 1 {
            for column in 0..columns - 1 {
                let far = (row * columns + column) as u32;
                let near = far + columns as u32;
                shape.indices.extend([far, near, far + 1, far + 1, near, near + 1]);
            }
        }
        shape
    }

    /// The ground's colour over the fan, sRGB.
    fn picture(&self) -> Vec<u8> {
        let [width, height] = TEXTURE;
        let picture = RgbImage::from_fn(width, height, |x, y| {
            let at = Self::place((f64::from(x) + 0.5) / f64::from(width), (f64::from(y) + 0.5) / f64::from(height));
            Rgb(self.albedo(at, 0.002 * at.y.abs()).map(|c| (255.0 * encoded(c.clamp(0.0, 1.0))).round() as u8))
        });
        let mut bytes = Cursor::new(Vec::new());
        JpegEncoder::new_with_quality(&mut bytes, QUALITY).encode_image(&picture).expect("memory takes every picture");
        bytes.into_inner()
    }
}

/// sRGB of linear light (IEC 61966-2-1).
fn encoded(linear: f64) -> f64 {
    if linear <= 0.003_130_8 { 12.92 * linear } else { 1.055 * linear.powf(1.0 / 2.4) - 0.055 }
}

fn mix(a: [f64; 3], b: [f64; 3], t: f64) -> [f64; 3] {
    std::array::from_fn(|i| a[i] + (b[i] - a[i]) * t)
}
