//! What lies between a light and the eye, and what touches the eye.
//!
//! Of a triangle in whose plane the eye is there is no saying whether it lies between light and eye: it hides the light
//! from one half of the view rays, from their first metre on, and not from the other. So it is not counted with the rest.
//! A ray passes behind it where it passes behind one of its edges: those are listed, and each ray asks them. Where the eye
//! is on an edge or on a vertex the edges that pass through it are left out, here and among the silhouettes, and the
//! others of the triangle say it all.
//!
//! The same triangles hide nothing that is seen: what the eye touches no picture shows.

use std::collections::BTreeMap;

use glam::DVec3;
use tyndall_shaders::shadows::{edge_touches, height_above};

use super::silhouette::SilhouetteEdge;
use super::slices::{LightFrame, PlacedEdge, Turning};

/// The edges of triangles that pass through the eye. They are the same for all lights.
#[derive(Clone, Debug, Default)]
pub(crate) struct EdgesAtEye {
    /// By triangle: of its edges from its first vertex on those that pass through the eye.
    triangles: BTreeMap<usize, [bool; 3]>,
    /// What is closer to the eye may not be seen, m.
    unseen: f64,
}

impl EdgesAtEye {
    pub(crate) fn of(eye: DVec3, unseen: f64, positions: &[DVec3], triangles: &[[u32; 3]]) -> EdgesAtEye {
        let at_eye = |(number, triangle): (usize, &[u32; 3])| {
            let corners = triangle.map(|vertex| positions[vertex as usize]);
            let touching =
                is_near(eye, unseen, corners).then(|| sides(corners).map(|side| edge_touches(eye, unseen, side)))?;
            touching.contains(&true).then_some((number, touching))
        };
        EdgesAtEye { triangles: triangles.iter().enumerate().filter_map(at_eye).collect(), unseen }
    }

    /// Whether this edge passes through the eye.
    pub(crate) fn touches(&self, eye: DVec3, edge: [DVec3; 2]) -> bool {
        !self.triangles.is_empty() && edge_touches(eye, self.unseen, edge)
    }

    fn of_triangle(&self, triangle: usize) -> [bool; 3] {
        self.triangles.get(&triangle).copied().unwrap_or_default()
    }
}

/// Whether an edge of a triangle may touch the eye: what is cheap to ask of all.
fn is_near(eye: DVec3, unseen: f64, [a, b, c]: [DVec3; 3]) -> bool {
    let (low, high) = (a.min(b).min(c), a.max(b).max(c));
    let largest = low.abs().max(high.abs()).max(eye.abs());
    (low - eye).max(eye - high).max_element() <= unseen + 1e-6 * largest.element_sum()
}

fn sides<T: Copy>([a, b, c]: [T; 3]) -> [[T; 2]; 3] {
    [[a, b], [b, c], [c, a]]
}

/// What a light meets before the eye, and at it.
#[derive(Clone, Debug, Default)]
pub(crate) struct AtEye {
    /// Triangles between the light and the eye.
    pub depth: i32,
    /// Edges of those that touch it.
    pub touching: Vec<PlacedEdge>,
}

impl AtEye {
    /// It must agree with what rays count from here on, so it asks of each edge of a triangle on which side of it the axis
    /// passes, as [`Turning`] does, and of the triangle on which sides of it light and eye are, and nothing else. `positions`
    /// are in the world, `places` in the frame of the light.
    pub(crate) fn of(
        frame: &LightFrame,
        (positions, places): (&[DVec3], &[DVec3]),
        triangles: &[[u32; 3]],
        facing: &[i8],
        edges: &EdgesAtEye,
    ) -> AtEye {
        let mut at_eye = AtEye::default();
        for (number, (triangle, facing)) in triangles.iter().zip(facing).enumerate() {
            let touches = edges.of_triangle(number);
            let left = sides(triangle.map(|vertex| places[vertex as usize])).map(|[a, b]| Turning::of(a, b).left);
            // It does not matter on which side of the axis the edges through the eye are.
            let mut others = left.iter().zip(touches).filter(|(_, touches)| !touches).map(|(left, _)| *left);
            let Some(first) = others.next() else { continue };
            if *facing == 0 || others.any(|left| left != first) {
                continue;
            }
            let corners = triangle.map(|vertex| positions[vertex as usize]);
            let plane = EyeAbovePlane::of(frame, corners, *facing);
            if touches.contains(&true) || plane.touches(edges.unseen) {
                let sides = sides(*triangle).into_iter().zip(touches).filter(|(_, touches)| !touches);
                let edges = sides.map(|(vertices, _)| SilhouetteEdge { vertices, excess: i32::from(*facing) });
                let placed = edges.filter_map(|edge| PlacedEdge::of(&edge, places));
                at_eye.touching.extend(placed.map(|edge| edge.at_eye(plane.away)));
            } else if plane.height < 0.0 {
                at_eye.depth += i32::from(*facing) * if first { -1 } else { 1 };
            }
        }
        at_eye
    }
}

/// The eye beside the plane of a triangle.
struct EyeAbovePlane {
    /// Toward the light, m.
    height: f64,
    /// What rounding leaves open of it, m.
    rounded: f64,
    /// Where the axis meets the plane behind the eye, m; below 0 only where the eye is behind the plane for certain.
    away: f64,
}

impl EyeAbovePlane {
    fn of(frame: &LightFrame, corners: [DVec3; 3], facing: i8) -> EyeAbovePlane {
        let [a, b, c] = corners;
        let normal = (b - a).cross(c - a);
        let (height, rounded) = height_above(frame.eye(), normal, &corners);
        let (height, rounded) = (f64::from(facing) * height / normal.length(), rounded / normal.length());
        let beside = if height < -rounded { height } else { height.max(0.0) + rounded };
        let away = beside * normal.length() / normal.dot(frame.axis()).abs();
        EyeAbovePlane { height, rounded, away }
    }

    /// The eye is in the plane, as near as that can be told, or so little before it that nothing of it is seen.
    fn touches(&self, unseen: f64) -> bool {
        self.height >= -self.rounded && self.height <= self.rounded + unseen
    }
}
