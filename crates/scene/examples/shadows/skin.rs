//! Closed solids from cross-sections, smooth all over.

use std::f32::consts::TAU;

use glam::Vec3;

use crate::glb::Shape;

/// The solid whose skin runs through rings of as many points each, counter-clockwise as seen from where it goes on to. It
/// begins and ends in a point: a ring of one.
pub fn skin(rings: &[Vec<Vec3>]) -> Shape {
    let mut shape = Shape::default();
    let mut starts = Vec::new();
    for ring in rings {
        starts.push(shape.positions.len() as u32);
        shape.positions.extend(ring);
    }
    for (pair, start) in rings.windows(2).zip(starts.windows(2)) {
        let sides = pair[0].len().max(pair[1].len()) as u32;
        for k in 0..sides {
            // at a tip all corners are the one
            let corner = |ring: usize, k: u32| start[ring] + k % pair[ring].len() as u32;
            let (a, b, c, d) = (corner(0, k), corner(0, k + 1), corner(1, k + 1), corner(1, k));
            if a != b {
                shape.indices.extend([a, b, c]);
            }
            if c != d {
                shape.indices.extend([c, d, a]);
            }
        }
    }
    shade(&mut shape);
    shape
}

/// Normals that blend those of the triangles around a vertex, by their areas.
fn shade(shape: &mut Shape) {
    shape.normals = vec![Vec3::ZERO; shape.positions.len()];
    for triangle in shape.indices.chunks_exact(3) {
        let [a, b, c] = [0, 1, 2].map(|k| shape.positions[triangle[k] as usize]);
        let normal = (b - a).cross(c - a);
        triangle.iter().for_each(|vertex| shape.normals[*vertex as usize] += normal);
    }
    shape.normals.iter_mut().for_each(|normal| *normal = normal.normalize_or(Vec3::Y));
}

/// A solid of revolution about +y: a profile of (radius, height), upward on the outside, from the axis to the axis.
pub fn turned(profile: &[(f32, f32)], sides: u32) -> Shape {
    let rings: Vec<Vec<Vec3>> = profile.iter().map(|&(radius, height)| circle(radius, height, sides)).collect();
    skin(&rings)
}

fn circle(radius: f32, height: f32, sides: u32) -> Vec<Vec3> {
    if radius <= 0.0 {
        return vec![Vec3::new(0.0, height, 0.0)];
    }
    let angle = |k: u32| TAU * k as f32 / sides as f32;
    (0..sides).map(|k| Vec3::new(radius * angle(k).cos(), height, -radius * angle(k).sin())).collect()
}

/// A round rod along points, each with its radius; its ends are pointed by half their radius.
pub fn rod(path: &[(Vec3, f32)], sides: u32) -> Shape {
    let last = path.len() - 1;
    let way = |i: usize| (path[(i + 1).min(last)].0 - path[i.saturating_sub(1)].0).normalize();
    let (start, end) = (path[0], path[last]);
    let mut rings = vec![vec![start.0 - way(0) * 0.5 * start.1]];
    let mut across = way(0).any_orthonormal_vector();
    for (i, &(center, radius)) in path.iter().enumerate() {
        across = (across - way(i) * across.dot(way(i))).normalize();
        let up = way(i).cross(across);
        let angle = |k: u32| TAU * k as f32 / sides as f32;
        rings.push((0..sides).map(|k| center + radius * (across * angle(k).cos() + up * angle(k).sin())).collect());
    }
    rings.push(vec![end.0 + way(last) * 0.5 * end.1]);
    skin(&rings)
}
