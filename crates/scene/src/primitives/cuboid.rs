//! A box with flat normals: four vertices for each of six faces.

use glam::{Vec2, Vec3};

use crate::mesh::Mesh;

/// Normal and the two in-plane axes u, v of each face, with u × v = normal.
const FACES: [[Vec3; 3]; 6] = [
    [Vec3::X, Vec3::Y, Vec3::Z],
    [Vec3::NEG_X, Vec3::Z, Vec3::Y],
    [Vec3::Y, Vec3::Z, Vec3::X],
    [Vec3::NEG_Y, Vec3::X, Vec3::Z],
    [Vec3::Z, Vec3::X, Vec3::Y],
    [Vec3::NEG_Z, Vec3::Y, Vec3::X],
];

pub(super) fn mesh(size: [f64; 3]) -> Mesh {
    let half = Vec3::from_array(size.map(|s| (s / 2.0) as f32));
    let mut mesh = Mesh::default();
    for [normal, u, v] in FACES {
        let first = mesh.positions.len() as u32;
        for (a, b) in [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)] {
            mesh.positions.push((normal + u * a + v * b) * half);
            mesh.normals.push(normal);
            mesh.uvs.push(Vec2::new((a + 1.0) / 2.0, (1.0 - b) / 2.0));
        }
        mesh.triangles.push([first, first + 1, first + 2]);
        mesh.triangles.push([first, first + 2, first + 3]);
    }
    mesh
}
