//! Solids: boxes and solids of revolution, closed and wound outward.

use std::f32::consts::TAU;

use glam::{Mat3, Vec2, Vec3};

use crate::glb::Shape;

/// Corners of a profile sharper than this stay sharp (cosine of the angle between the normals on both sides).
const SHARP: f32 = 0.75;

impl Shape {
    /// Adds another shape, moved.
    pub fn join(&mut self, other: &Shape, place: Vec3, turn: Mat3) {
        let first = self.positions.len() as u32;
        self.positions.extend(other.positions.iter().map(|p| turn * *p + place));
        self.normals.extend(other.normals.iter().map(|n| turn * *n));
        self.uvs.extend(&other.uvs);
        self.indices.extend(other.indices.iter().map(|i| i + first));
    }

    /// A flat quadrilateral, counter-clockwise, textured by its place in metres.
    fn quad(&mut self, corners: [Vec3; 4], normals: [Vec3; 4], uvs: [Vec2; 4]) {
        let first = self.positions.len() as u32;
        self.positions.extend(corners);
        self.normals.extend(normals);
        self.uvs.extend(uvs);
        // At the axis of a solid of revolution one edge has no length.
        if corners[0] != corners[1] {
            self.indices.extend([first, first + 1, first + 2]);
        }
        if corners[2] != corners[3] {
            self.indices.extend([first, first + 2, first + 3]);
        }
    }
}

/// A box about its centre.
pub fn cuboid(center: Vec3, size: Vec3) -> Shape {
    let mut shape = Shape::default();
    for (normal, u, v) in [
        (Vec3::X, Vec3::NEG_Z, Vec3::Y),
        (Vec3::NEG_X, Vec3::Z, Vec3::Y),
        (Vec3::Y, Vec3::X, Vec3::NEG_Z),
        (Vec3::NEG_Y, Vec3::X, Vec3::Z),
        (Vec3::Z, Vec3::X, Vec3::Y),
        (Vec3::NEG_Z, Vec3::NEG_X, Vec3::Y),
    ] {
        let corner = |a: f32, b: f32| center + (normal + u * a + v * b) * size / 2.0;
        let corners = [corner(-1.0, -1.0), corner(1.0, -1.0), corner(1.0, 1.0), corner(-1.0, 1.0)];
        let uvs = corners.map(|c| Vec2::new(c.dot(u), -c.dot(v)));
        shape.quad(corners, [normal; 4], uvs);
    }
    shape
}

/// How a profile is turned around +y.
#[derive(Clone, Copy)]
pub struct Turning {
    /// Number of sides.
    pub sides: u32,
    /// Whether the sides are shaded as one round surface.
    pub round: bool,
    /// Whether the last point joins the first (a ring) instead of both lying on the axis.
    pub ring: bool,
    /// Texture repeats along the circumference of the widest point, and along the profile, per metre.
    pub uv_scale: f32,
}

/// A solid of revolution. The profile is (radius, height), outside on the right of its way: upward on the outside.
/// Corners of a polygonal one stand at odd multiples of half a side, so that a side faces each axis.
pub fn turned(profile: &[(f32, f32)], turning: Turning) -> Shape {
    let Turning { sides, round, ring, uv_scale } = turning;
    let points: Vec<Vec2> = profile.iter().map(|&(r, y)| Vec2::new(r, y)).collect();
    let segments = if ring { points.len() } else { points.len() - 1 };
    let point = |i: usize| points[i % points.len()];
    let normal = |i: usize| (point(i + 1) - point(i)).normalize().perp() * -1.0;
    // The normal of segment i at its end point `at`, averaged with that of a neighbour that continues it.
    let blended = |i: usize, at: usize| {
        let neighbour = if at == i { i.checked_sub(1) } else { Some(i + 1).filter(|n| *n < segments) };
        let other = neighbour.map_or(normal(i), normal);
        if other.dot(normal(i)) > SHARP { (normal(i) + other).normalize() } else { normal(i) }
    };
    let angle = |k: u32| TAU * (k as f32 - 0.5) / sides as f32;
    // The angle of the last side is that of the first: bit for bit, so that the solid closes.
    let ray = |k: u32| {
        let (sin, cos) = angle(k % sides).sin_cos();
        Vec3::new(cos, 0.0, -sin)
    };
    let lift = |p: Vec2, ray: Vec3| ray * p.x + Vec3::Y * p.y;
    let widest = points.iter().map(|p| p.x).fold(0.0, f32::max);
    let around = (TAU * widest * uv_scale).round().max(1.0);
    let mut shape = Shape::default();
    let mut along = 0.0;
    for i in 0..segments {
        let (low, high) = (point(i), point(i + 1));
        let length = (high - low).length() * uv_scale;
        for k in 0..sides {
            let (from, to) = (ray(k), ray(k + 1));
            let flat = (from + to).normalize();
            let rays = if round { [from, to, to, from] } else { [flat; 4] };
            let ends = [blended(i, i), blended(i, i), blended(i, i + 1), blended(i, i + 1)];
            let corners = [lift(low, from), lift(low, to), lift(high, to), lift(high, from)];
            let normals = [0, 1, 2, 3].map(|c| lift(ends[c], rays[c]).normalize());
            let level = (high.y - low.y).abs() < 1e-4;
            let uvs = [0, 1, 2, 3].map(|c| {
                let u = around * (k as f32 + if c == 1 || c == 2 { 1.0 } else { 0.0 }) / sides as f32;
                let v = along + if c < 2 { 0.0 } else { length };
                let place = corners[c] * uv_scale;
                if level { Vec2::new(place.x, place.z) } else { Vec2::new(u, -v) }
            });
            shape.quad(corners, normals, uvs);
        }
        along += length;
    }
    shape
}
