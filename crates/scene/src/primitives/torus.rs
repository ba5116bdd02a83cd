//! A torus about +y: two angles, wrapped around, so that no seam repeats a vertex.

use std::f64::consts::TAU;

use glam::{DVec3, Vec2};

use crate::mesh::Mesh;

/// Around the axis; the chord of the outer rim sags by 1.4e-4 of its radius.
const AROUND: u32 = 192;
/// Around the tube; the chord sags by 5.4e-4 of the (smaller) tube radius.
const TUBE: u32 = 96;

pub(super) fn mesh(major: f64, minor: f64) -> Mesh {
    let mut mesh = Mesh::default();
    for i in 0..AROUND {
        let (sin, cos) = (TAU * f64::from(i) / f64::from(AROUND)).sin_cos();
        let outward = DVec3::new(cos, 0.0, -sin);
        for j in 0..TUBE {
            let (rise, reach) = (TAU * f64::from(j) / f64::from(TUBE)).sin_cos();
            let normal = outward * reach + DVec3::Y * rise;
            mesh.positions.push((outward * major + normal * minor).as_vec3());
            mesh.normals.push(normal.as_vec3());
            mesh.uvs.push(Vec2::ZERO);
        }
    }
    let vertex = |i: u32, j: u32| (i % AROUND) * TUBE + j % TUBE;
    for i in 0..AROUND {
        for j in 0..TUBE {
            let [a, b, c, d] = [vertex(i, j), vertex(i + 1, j), vertex(i + 1, j + 1), vertex(i, j + 1)];
            mesh.triangles.push([a, b, c]);
            mesh.triangles.push([a, c, d]);
        }
    }
    mesh
}
