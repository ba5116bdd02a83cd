//! The primitives of a scene file as meshes: centred on the origin, fine enough that a view 512 pixels wide shows no
//! facets, closed 2-manifolds (all but the plane) without duplicate positions along seams.

mod cuboid;
mod plane;
mod sphere;
mod torus;

use crate::mesh::Mesh;

/// A primitive and its measures, in metres.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Primitive {
    /// A sphere about the origin.
    Sphere {
        /// Above 0.
        radius: f64,
    },
    /// A box with faces along the axes.
    Box {
        /// Whole edge lengths along x, y, z, each above 0.
        size: [f64; 3],
    },
    /// A ring in the x-z plane, its axis +y.
    Torus {
        /// Radius of the tube's centre line; above `minor`.
        major: f64,
        /// Radius of the tube, above 0.
        minor: f64,
    },
    /// A rectangle in the x-z plane that faces +y. Not closed: four open edges.
    Plane {
        /// Whole edge lengths along x and z, each above 0.
        size: [f64; 2],
    },
}

impl Primitive {
    /// The primitive's mesh.
    pub fn mesh(&self) -> Mesh {
        match *self {
            Primitive::Sphere { radius } => sphere::mesh(radius),
            Primitive::Box { size } => cuboid::mesh(size),
            Primitive::Torus { major, minor } => torus::mesh(major, minor),
            Primitive::Plane { size } => plane::mesh(size),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::adjacency::Adjacency;

    /// Signed volume by the divergence theorem; positive where triangles face outward.
    fn volume(mesh: &Mesh) -> f64 {
        let corner = |i: u32| mesh.positions[i as usize].as_dvec3();
        mesh.triangles.iter().map(|t| corner(t[0]).dot(corner(t[1]).cross(corner(t[2]))) / 6.0).sum()
    }

    fn closed(primitive: Primitive) -> Mesh {
        let mesh = primitive.mesh();
        let adjacency = Adjacency::of(&mesh.positions, &mesh.triangles);
        assert!(adjacency.is_closed(), "{primitive:?}: {adjacency:?}");
        for &triangle in &mesh.triangles {
            let face = mesh.area_normal(triangle).normalize();
            for index in triangle {
                assert!(mesh.normals[index as usize].dot(face) > 0.9, "a normal points inward");
                assert!((mesh.normals[index as usize].length() - 1.0).abs() < 1e-6);
            }
        }
        mesh
    }

    #[test]
    fn closed_primitives_enclose_their_volume() {
        let pi = std::f64::consts::PI;
        let sphere = volume(&closed(Primitive::Sphere { radius: 2.0 }));
        assert!((sphere / (4.0 / 3.0 * pi * 8.0) - 1.0).abs() < 4e-4, "{sphere}");
        let cuboid = volume(&closed(Primitive::Box { size: [1.0, 2.0, 3.0] }));
        assert!((cuboid - 6.0).abs() < 1e-6, "{cuboid}");
        let torus = volume(&closed(Primitive::Torus { major: 1.0, minor: 0.3 }));
        assert!((torus / (2.0 * pi * pi * 0.09) - 1.0).abs() < 1.5e-3, "{torus}");
    }

    #[test]
    fn plane_faces_up_and_is_open() {
        let mesh = Primitive::Plane { size: [4.0, 2.0] }.mesh();
        let adjacency = Adjacency::of(&mesh.positions, &mesh.triangles);
        assert_eq!((adjacency.open().count(), mesh.triangles.len()), (4, 2));
        assert!(mesh.triangles.iter().all(|&t| mesh.area_normal(t).y > 0.0));
    }

    #[test]
    fn sphere_sag_is_below_the_bound() {
        let mesh = Primitive::Sphere { radius: 1.0 }.mesh();
        // The nearest point of a triangle's plane to the centre is the deepest chord of that triangle.
        let deepest = mesh.triangles.iter().map(|&t| {
            let normal = mesh.area_normal(t).as_dvec3().normalize();
            normal.dot(mesh.positions[t[0] as usize].as_dvec3())
        });
        let deepest = deepest.fold(1.0, f64::min);
        assert!(1.0 - deepest < 1.5e-4, "{}", 1.0 - deepest);
        assert!(mesh.positions.iter().all(|p| (p.length() - 1.0).abs() < 1e-6));
    }
}
