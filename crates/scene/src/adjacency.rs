//! Which triangles meet at which edge, for silhouettes and shadow volumes.
//!
//! Vertices that differ only in normal or texture coordinate are one point here: positions are welded bit for bit.

use std::collections::HashMap;

use glam::Vec3;

/// An edge and the triangles that share it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Edge {
    /// Two vertex indices (into the vertices given), each the first vertex at its position; the lower one first.
    pub vertices: [u32; 2],
    /// Every triangle that has this edge, ascending: one where the edge is open, two in a manifold.
    pub triangles: Vec<Side>,
}

/// One triangle at an edge.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Side {
    /// Index of the triangle.
    pub triangle: u32,
    /// Whether the triangle runs along the edge from its first vertex to its second.
    pub forward: bool,
}

/// What is wrong, or not, with an edge.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum EdgeKind {
    /// Two triangles that run along it in opposite directions.
    Manifold,
    /// One triangle only.
    Open,
    /// Two triangles whose windings contradict each other.
    Inconsistent,
    /// Three or more triangles.
    NonManifold,
}

impl Edge {
    /// How the triangles meet here.
    pub fn kind(&self) -> EdgeKind {
        match self.triangles.as_slice() {
            [_] => EdgeKind::Open,
            [a, b] if a.forward != b.forward => EdgeKind::Manifold,
            [_, _] => EdgeKind::Inconsistent,
            _ => EdgeKind::NonManifold,
        }
    }
}

/// The edges of a triangle mesh.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Adjacency {
    /// Sorted by their vertices.
    pub edges: Vec<Edge>,
    /// Triangles that have two corners at one position; they take no part in `edges`.
    pub degenerate: Vec<u32>,
}

impl Adjacency {
    /// The adjacency of triangles over welded positions. Every index must be below `positions.len()`.
    pub fn of(positions: &[Vec3], triangles: &[[u32; 3]]) -> Adjacency {
        let welded = weld(positions);
        let mut sides = Vec::with_capacity(triangles.len() * 3);
        let mut degenerate = Vec::new();
        for (index, triangle) in triangles.iter().enumerate() {
            let [a, b, c] = triangle.map(|i| welded[i as usize]);
            if a == b || b == c || c == a {
                degenerate.push(index as u32);
                continue;
            }
            for (from, to) in [(a, b), (b, c), (c, a)] {
                let side = Side { triangle: index as u32, forward: from < to };
                sides.push(([from.min(to), from.max(to)], side));
            }
        }
        sides.sort_unstable();
        let groups = sides.chunk_by(|a, b| a.0 == b.0);
        let edges = groups.map(|g| Edge { vertices: g[0].0, triangles: g.iter().map(|s| s.1).collect() });
        Adjacency { edges: edges.collect(), degenerate }
    }

    /// Puts other indices in place of those of vertices and triangles.
    pub(crate) fn rename(&mut self, vertices: &[u32], triangles: &[u32]) {
        let rename = |triangle: &mut u32| *triangle = triangles[*triangle as usize];
        self.degenerate.iter_mut().for_each(rename);
        for edge in &mut self.edges {
            edge.vertices = edge.vertices.map(|vertex| vertices[vertex as usize]);
            edge.triangles.iter_mut().for_each(|side| rename(&mut side.triangle));
        }
    }

    /// Edges of one triangle only.
    pub fn open(&self) -> impl Iterator<Item = &Edge> {
        self.edges.iter().filter(|e| e.kind() == EdgeKind::Open)
    }

    /// Edges that break the manifold: three or more triangles, or two that contradict each other.
    pub fn broken(&self) -> impl Iterator<Item = &Edge> {
        self.edges.iter().filter(|e| matches!(e.kind(), EdgeKind::NonManifold | EdgeKind::Inconsistent))
    }

    /// Whether every edge has exactly two triangles of matching winding: a closed, oriented 2-manifold (apart from
    /// surfaces that touch in a point).
    pub fn is_closed(&self) -> bool {
        self.edges.iter().all(|e| e.kind() == EdgeKind::Manifold)
    }
}

/// For every vertex the first vertex at the same position; −0 and 0 are one.
fn weld(positions: &[Vec3]) -> Vec<u32> {
    let mut first = HashMap::with_capacity(positions.len());
    let entry = |(index, position): (usize, &Vec3)| {
        let key = (*position + Vec3::ZERO).to_array().map(f32::to_bits);
        *first.entry(key).or_insert(index as u32)
    };
    positions.iter().enumerate().map(entry).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn kinds_of_edges() {
        let positions = [(0.0, 0.0), (1.0, 0.0), (0.0, 1.0), (1.0, 1.0), (-1.0, -1.0), (1.0, 0.0)];
        let positions = positions.map(|(x, y)| Vec3::new(x, y, 0.0));
        // Two triangles over the welded edge (0, 1|5), the second wound the same way; a third one makes it worse.
        let two = Adjacency::of(&positions, &[[0, 1, 2], [0, 5, 3]]);
        assert_eq!(two.broken().map(Edge::kind).collect::<Vec<_>>(), [EdgeKind::Inconsistent]);
        let three = Adjacency::of(&positions, &[[0, 1, 2], [1, 0, 4], [0, 5, 3]]);
        assert_eq!(three.broken().map(|e| (e.vertices, e.triangles.len())).collect::<Vec<_>>(), [([0, 1], 3)]);
        assert_eq!(three.broken().next().map(Edge::kind), Some(EdgeKind::NonManifold));
    }

    #[test]
    fn degenerate_triangles_are_set_apart() {
        let positions = [Vec3::ZERO, Vec3::X, Vec3::Y, Vec3::X];
        let adjacency = Adjacency::of(&positions, &[[0, 1, 2], [0, 1, 3]]);
        assert_eq!((adjacency.degenerate.as_slice(), adjacency.edges.len()), ([1].as_slice(), 3));
    }
}
