//! A rectangle in x-z that faces +y: two triangles are exact.

use glam::{Vec2, Vec3};

use crate::mesh::Mesh;

pub(super) fn mesh(size: [f64; 2]) -> Mesh {
    let [x, z] = size.map(|s| (s / 2.0) as f32);
    let corners = [(-x, z, 0.0, 1.0), (x, z, 1.0, 1.0), (x, -z, 1.0, 0.0), (-x, -z, 0.0, 0.0)];
    Mesh {
        positions: corners.iter().map(|c| Vec3::new(c.0, 0.0, c.1)).collect(),
        normals: vec![Vec3::Y; 4],
        uvs: corners.iter().map(|c| Vec2::new(c.2, c.3)).collect(),
        colors: Vec::new(),
        triangles: vec![[0, 1, 2], [0, 2, 3]],
    }
}
