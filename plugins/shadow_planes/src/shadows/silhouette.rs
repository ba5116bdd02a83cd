//! Edges at which a shadow begins or ends, as a light sees them.

use glam::DVec3;
use tyndall_plugin::scene::Scene;
use tyndall_plugin::scene::adjacency::Adjacency;
use tyndall_shaders::shadows::{Source, facing};

/// An edge of the casters at which the number of triangles between the light and what is behind changes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct SilhouetteEdge {
    /// Its vertices, which edges share.
    pub vertices: [u32; 2],
    /// Triangles to the left of the way from the first vertex to the second as the light sees it, less those to the right.
    pub excess: i32,
}

/// The triangles that cast shadows, and their edges. It depends on the meshes alone, not on where anything is.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Casters {
    /// Vertex indices. Which of them come first does not change with the time, as `sides` refer to it.
    pub triangles: Vec<[u32; 3]>,
    edges: Vec<Edge>,
    sides: Vec<Side>,
}

#[derive(Clone, Copy, Debug, PartialEq)]
struct Edge {
    vertices: [u32; 2],
    /// Into the sides.
    first_side: u32,
}

/// A triangle at an edge.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Side {
    triangle: u32,
    forward: bool,
}

impl Casters {
    /// Of a scene's objects that cast shadows. Triangles with two corners at one position are left out.
    pub(crate) fn of(scene: &Scene) -> Casters {
        let triangles: Vec<[u32; 4]> = scene.moment(0.0, 1.0).triangles().collect();
        let casts = |triangle: u32| scene.instances[triangles[triangle as usize][3] as usize].casts_shadow;
        let corners = |triangle: u32| triangles[triangle as usize].first_chunk().copied().unwrap_or_default();
        let mut casters = Casters::default();
        let mut renamed = vec![u32::MAX; triangles.len()];
        for Adjacency { edges, .. } in scene.adjacency() {
            for edge in edges {
                let sides = edge.triangles.iter().filter(|side| casts(side.triangle));
                let first_side = casters.sides.len() as u32;
                for side in sides {
                    let name = &mut renamed[side.triangle as usize];
                    if *name == u32::MAX {
                        *name = casters.triangles.len() as u32;
                        casters.triangles.push(corners(side.triangle));
                    }
                    casters.sides.push(Side { triangle: *name, forward: side.forward });
                }
                if casters.sides.len() as u32 > first_side {
                    casters.edges.push(Edge { vertices: edge.vertices, first_side });
                }
            }
        }
        casters
    }

    /// Which way each triangle faces, as [`facing`] says.
    pub(crate) fn facing(&self, positions: &[DVec3], source: Source) -> Vec<i8> {
        let corners = |triangle: &[u32; 3]| triangle.map(|vertex| positions[vertex as usize]);
        self.triangles.iter().map(|triangle| facing(source, &corners(triangle))).collect()
    }

    /// The silhouette: of a closed mesh the edges between a triangle that faces the light and one that does not; of any
    /// mesh those that have more triangles on one side than on the other as the light sees them: open edges, folds, and
    /// edges of three triangles and more (Kim, Kim and Turk 2008 weight edges alike). It takes no winding for granted.
    pub(crate) fn silhouette(&self, facing: &[i8]) -> Vec<SilhouetteEdge> {
        let ends = self.edges.iter().skip(1).map(|edge| edge.first_side).chain([self.sides.len() as u32]);
        let excess = |(edge, end): (&Edge, u32)| {
            let sides = &self.sides[edge.first_side as usize..end as usize];
            let side = |side: &Side| i32::from(facing[side.triangle as usize]) * if side.forward { 1 } else { -1 };
            let excess = sides.iter().map(side).sum();
            (excess != 0).then_some(SilhouetteEdge { vertices: edge.vertices, excess })
        };
        self.edges.iter().zip(ends).filter_map(excess).collect()
    }
}
