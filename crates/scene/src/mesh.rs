//! Triangle meshes in their own space, before any transform.

use std::cmp::Ordering;

use glam::{Vec2, Vec3};

/// An indexed triangle mesh. `positions`, `normals` and `uvs` have one entry per vertex, `colors` too or none at all.
///
/// Triangles run counter-clockwise seen from outside (right-handed space).
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Mesh {
    /// Metres, in the space of the object or glTF node.
    pub positions: Vec<Vec3>,
    /// Unit normals.
    pub normals: Vec<Vec3>,
    /// Texture coordinates, (0, 0) the first texel of the image's top row, as in glTF.
    pub uvs: Vec<Vec2>,
    /// Linear colours that multiply the diffuse reflectance.
    pub colors: Vec<Vec3>,
    /// Three vertex indices each, all below `positions.len()`.
    pub triangles: Vec<[u32; 3]>,
}

impl Mesh {
    /// Not normalised; its length is twice the triangle's area.
    pub(crate) fn area_normal(&self, triangle: [u32; 3]) -> Vec3 {
        let [a, b, c] = triangle.map(|i| self.positions[i as usize]);
        (b - a).cross(c - a)
    }

    /// Turns the indices of each triangle until the corner with the least position comes first. Of a thin triangle what
    /// single precision makes depends on that, and so it would on how a file happens to list the corners.
    pub(crate) fn turn_triangles(&mut self) {
        let Mesh { positions, triangles, .. } = self;
        for triangle in triangles {
            let place = |corner: &usize| positions[triangle[*corner] as usize].to_array();
            let order = |a: &usize, b: &usize| {
                let pairs = place(a).into_iter().zip(place(b));
                pairs.map(|(a, b)| a.total_cmp(&b)).fold(Ordering::Equal, Ordering::then)
            };
            let first = (0..3).min_by(order).unwrap_or_default();
            triangle.rotate_left(first);
        }
    }

    /// Gives every triangle three vertices of its own with the triangle's normal (glTF 2.0, 3.7.2.1: a primitive
    /// without normals is shaded flat).
    pub(crate) fn flattened(&self) -> Mesh {
        let mut flat = Mesh::default();
        for &triangle in &self.triangles {
            let normal = self.area_normal(triangle).try_normalize().unwrap_or(Vec3::Y);
            let first = flat.positions.len() as u32;
            for index in triangle {
                flat.positions.push(self.positions[index as usize]);
                flat.uvs.push(self.uvs[index as usize]);
                flat.normals.push(normal);
                flat.colors.extend(self.colors.get(index as usize));
            }
            flat.triangles.push([first, first + 1, first + 2]);
        }
        flat
    }

    /// Brings normals to unit length; a normal of no length becomes the mean of its triangles' normals.
    pub(crate) fn repair_normals(&mut self) {
        let mut missing = Vec::new();
        for (index, normal) in self.normals.iter_mut().enumerate() {
            match normal.try_normalize() {
                Some(unit) => *normal = unit,
                None => missing.push(index),
            }
        }
        if missing.is_empty() {
            return;
        }
        let mut sums = vec![Vec3::ZERO; self.positions.len()];
        for &triangle in &self.triangles {
            let normal = self.area_normal(triangle);
            triangle.iter().for_each(|&i| sums[i as usize] += normal);
        }
        for index in missing {
            self.normals[index] = sums[index].try_normalize().unwrap_or(Vec3::Y);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn triangles_begin_with_the_same_corner_however_they_are_listed() {
        let positions = vec![Vec3::new(1.0, 2.0, 3.0), Vec3::new(1.0, -2.0, 9.0), Vec3::new(4.0, 0.0, 0.0)];
        for listed in [[0, 1, 2], [1, 2, 0], [2, 0, 1]] {
            let mut mesh = Mesh { positions: positions.clone(), triangles: vec![listed], ..Mesh::default() };
            mesh.turn_triangles();
            assert_eq!(mesh.triangles, [[1, 2, 0]], "and its winding is kept");
        }
    }
}
