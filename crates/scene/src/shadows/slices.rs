//! The silhouette of a light, sorted into slices about the axis through light and eye.
//!
//! Every view ray and the light span a half-plane that begins at that axis, so an angle about the axis says which edges a
//! ray can cross: those that span the angle. A slice is a range of angles and lists the edges that span a part of it, in
//! the order in which a ray crosses them.
//!
//! Edges stand in the frame of the light: x and y across the axis, z along it from the light to the eye, the eye at the
//! origin, m. A light at the distance l has the nearness κ = 1/l, a sun 0. As the light sees it, a point is in the
//! direction (x, y, n) with n = 1 + κz. Within a half-plane, with the distance r from the axis, `n/r` falls along every
//! ray, whatever its direction: it says what is crossed first.

use glam::{DMat3, DVec2, DVec3};

use super::silhouette::{SilhouetteEdge, Source};
use crate::layout::{ShadowCrossing, ShadowEdge, ShadowLight};

/// Where light and eye stand to each other.
pub(crate) struct LightFrame {
    eye: DVec3,
    /// Columns: across, upward, and the axis from the light to the eye.
    world_from_light: DMat3,
    /// κ, 1/m.
    nearness: f64,
}

impl LightFrame {
    /// `None` where the light is at the eye: all that is seen is lit then.
    pub(crate) fn new(source: Source, eye: DVec3) -> Option<LightFrame> {
        let (axis, nearness) = match source {
            Source::At(light) => {
                let distance = (eye - light).length();
                ((eye - light) / distance, 1.0 / distance)
            }
            Source::Along(direction) => (direction, 0.0),
        };
        let across = axis.any_orthonormal_vector();
        let upward = axis.cross(across);
        let world_from_light = DMat3::from_cols(across, upward, axis);
        (nearness.is_finite() && world_from_light.is_finite()).then_some(LightFrame { eye, world_from_light, nearness })
    }

    /// A point in the frame of the light.
    pub(crate) fn place(&self, point: DVec3) -> DVec3 {
        self.world_from_light.transpose() * (point - self.eye)
    }

    /// How many triangles there are between the light and the eye.
    ///
    /// It must agree with what rays count from here on, so it asks of each edge of a triangle on which side of it the axis
    /// passes, as [`Turning`] does, and of the triangle which way it faces, and nothing else.
    pub(crate) fn depth_at_eye(&self, places: &[DVec3], triangles: &[[u32; 3]], facing: &[i8]) -> i32 {
        let depth = |(triangle, facing): (&[u32; 3], &i8)| {
            let [a, b, c] = triangle.map(|vertex| places[vertex as usize]);
            let turns = [(a, b), (b, c), (c, a)].map(|(from, to)| Turning::of(from, to).left);
            if *facing == 0 || turns[0] != turns[1] || turns[1] != turns[2] {
                return 0;
            }
            // Beyond the eye, or in its plane?
            let normal = (b - a).cross(c - a);
            let beyond = f64::from(*facing) * normal.dot(a) / normal.length();
            let size = a.length().max(b.length()).max(c.length());
            if beyond <= TOUCHING * size {
                return 0;
            }
            i32::from(*facing) * if turns[0] { -1 } else { 1 }
        };
        triangles.iter().zip(facing).map(depth).sum()
    }

    /// The light's part of the encoded lists, which grow by it.
    pub(crate) fn encode(&self, depth_at_eye: i32, first_slice: usize, slices: u32) -> ShadowLight {
        let floats = crate::encode::floats;
        ShadowLight {
            across: floats(self.world_from_light.x_axis),
            nearness: self.nearness as f32,
            upward: floats(self.world_from_light.y_axis),
            depth_at_eye,
            axis: floats(self.world_from_light.z_axis),
            first_slice: first_slice as u32,
            slices,
            ..Default::default()
        }
    }

    fn distance_from_light(&self, place: DVec3) -> f64 {
        1.0 + self.nearness * place.z
    }
}

/// The eye is in the plane of a triangle where it is closer to it than this part of the triangle's distance.
const TOUCHING: f64 = 1e-7;

/// Which way an edge runs about the axis.
struct Turning {
    /// The axis is to the left of the way from its first vertex to its second (x to the right, y up).
    left: bool,
}

impl Turning {
    /// The same for an edge whichever triangle asks, but for the sign: vertices are ordered by where they are.
    fn of(from: DVec3, to: DVec3) -> Turning {
        let ordered = from.to_array() <= to.to_array();
        let (first, second) = if ordered { (from, to) } else { (to, from) };
        Turning { left: (first.truncate().perp_dot(second.truncate()) >= 0.0) == ordered }
    }
}

/// An edge that runs counter-clockwise about the axis.
pub(crate) struct PlacedEdge {
    a: DVec3,
    b: DVec3,
    /// By how many triangles there are more between the light and a ray that crosses the edge from the axis outward.
    step: i32,
}

impl PlacedEdge {
    /// `None` where a vertex is no number.
    pub(crate) fn of(edge: &SilhouetteEdge, places: &[DVec3]) -> Option<PlacedEdge> {
        let [a, b] = edge.vertices.map(|vertex| places[vertex as usize]);
        let placed = if Turning::of(a, b).left {
            PlacedEdge { a, b, step: edge.excess }
        } else {
            PlacedEdge { a: b, b: a, step: -edge.excess }
        };
        (a.is_finite() && b.is_finite()).then_some(placed)
    }

    pub(crate) fn encode(&self) -> ShadowEdge {
        let floats = crate::encode::floats;
        ShadowEdge { a: floats(self.a), step: self.step, b: floats(self.b), ..Default::default() }
    }

    /// The range of angles, from 0 to 4 and beyond where it passes the end; `None` where it may be any.
    fn angles(&self) -> Option<(f64, f64)> {
        let (a, b) = (self.a.truncate(), self.b.truncate());
        let (start, end) = (angle(a), angle(b));
        let round = a.dot(b) <= 0.0 && a.perp_dot(b) <= 1e-6 * a.length() * b.length();
        if round || !start.is_finite() || !end.is_finite() {
            return None;
        }
        match end < start {
            true if start - end < ANGLE_SLACK => Some((end, start)),
            true => Some((start, end + 4.0)),
            false => Some((start, end)),
        }
    }

    /// Bounds of n/r within a range of angles, of which the edge spans a part at least.
    fn bounds(&self, frame: &LightFrame, (start, end): (f64, f64), within: (f64, f64)) -> (f64, f64) {
        let (a, b) = (self.a.truncate(), self.b.truncate());
        let (na, nb) = (frame.distance_from_light(self.a), frame.distance_from_light(self.b));
        let turn = a.perp_dot(b);
        if turn <= 1e-9 * a.length() * b.length() {
            let (first, last) = (na / a.length(), nb / b.length());
            let slack = 1e-5 * (first.abs() + last.abs());
            return (first.max(last) + slack, first.min(last) - slack);
        }
        // n/r in a direction about the axis is the dot product with this, over `turn`.
        let gradient = DVec2::new(b.y * na - a.y * nb, a.x * nb - b.x * na);
        let at = |angle: f64| {
            let direction = direction(angle);
            let value = match angle {
                _ if angle <= start => na / a.length(),
                _ if angle >= end => nb / b.length(),
                _ => direction.dot(gradient) / turn,
            };
            (direction, value)
        };
        let (first, low) = at(within.0.clamp(start, end));
        let (second, high) = at(within.1.clamp(start, end));
        // Between the two it is a part of a sine, which bulges by 1 - cos of half the angle, at most.
        let bulge = gradient.length() / turn * (first - second).length_squared() / 6.0;
        let slack = bulge + 1e-5 * (low.abs() + high.abs());
        (low.max(high) + slack, low.min(high) - slack)
    }
}

/// What stands for an angle: 0 at +x, 1 at +y, 2 at -x, 3 at -y, monotonous between. `angle_of` of `shadows.wgsl`.
fn angle(v: DVec2) -> f64 {
    let part = v.y / (v.x.abs() + v.y.abs());
    if v.x < 0.0 {
        2.0 - part
    } else if v.y < 0.0 {
        4.0 + part
    } else {
        part
    }
}

/// The unit vector of an angle.
fn direction(angle: f64) -> DVec2 {
    let angle = angle.rem_euclid(4.0);
    let x = if angle < 2.0 { 1.0 - angle } else { angle - 3.0 };
    let y = if angle < 1.0 {
        angle
    } else if angle < 3.0 {
        2.0 - angle
    } else {
        angle - 4.0
    };
    DVec2::new(x, y).normalize()
}

/// More of an angle than single precision can be wrong about.
const ANGLE_SLACK: f64 = 4e-6;

/// Slices of a light with few edges, and of one with many: more than there are pixels along the rim of a picture do not
/// help.
const SLICES: (usize, usize) = (16, 4096);

/// Crossings of all slices of a light at most, about 50 MB: above that slices are wider.
const CROSSINGS_MAX: usize = 1 << 22;

/// How many slices edges are sorted into.
pub(crate) fn slice_count(edges: &[PlacedEdge]) -> usize {
    if edges.is_empty() {
        return 0;
    }
    let mut slices = (4 * edges.len()).next_power_of_two().clamp(SLICES.0, SLICES.1);
    let share = |edge: &PlacedEdge| edge.angles().map_or(1.0, |(start, end)| (end - start) / 4.0);
    let spanned: f64 = edges.iter().map(share).sum();
    while slices > SLICES.0 && spanned * slices as f64 + 2.0 * edges.len() as f64 > CROSSINGS_MAX as f64 {
        slices /= 2;
    }
    slices
}

/// Appends to `crossings` those of each slice and to `starts` where each slice begins, with one more for the end of the
/// last. `first_edge` is the number of the first edge.
pub(crate) fn sort(
    frame: &LightFrame,
    edges: &[PlacedEdge],
    slices: usize,
    first_edge: u32,
    starts: &mut Vec<u32>,
    crossings: &mut Vec<ShadowCrossing>,
) {
    let mut spans: Vec<(u32, ShadowCrossing)> = Vec::with_capacity(4 * edges.len());
    for (edge, number) in edges.iter().zip(first_edge..) {
        let Some(angles) = edge.angles() else {
            let anywhere = ShadowCrossing { nearest: f32::MAX, farthest: f32::MIN, edge: number };
            spans.extend((0..slices as u32).map(|slice| (slice, anywhere)));
            continue;
        };
        let width = 4.0 / slices as f64;
        let [first, last] =
            [angles.0 - ANGLE_SLACK, angles.1 + ANGLE_SLACK].map(|angle| (angle / width).floor() as i64);
        for slice in first..=last.min(first + slices as i64 - 1) {
            let within = (slice as f64 * width, (slice + 1) as f64 * width);
            let (nearest, farthest) = edge.bounds(frame, angles, within);
            let crossing = ShadowCrossing { nearest: nearest as f32, farthest: farthest as f32, edge: number };
            spans.push((slice.rem_euclid(slices as i64) as u32, crossing));
        }
    }
    spans.sort_unstable_by(|(slice, a), (other, b)| {
        slice.cmp(other).then(b.nearest.total_cmp(&a.nearest)).then(a.edge.cmp(&b.edge))
    });
    let mut spans = spans.into_iter().peekable();
    for slice in 0..slices as u32 {
        starts.push(crossings.len() as u32);
        let mut farthest = f32::MAX;
        while let Some((_, mut crossing)) = spans.next_if(|span| span.0 == slice) {
            // Of all up to here, so that a walk knows what it can leave behind.
            farthest = farthest.min(crossing.farthest);
            crossing.farthest = farthest;
            crossings.push(crossing);
        }
    }
    starts.push(crossings.len() as u32);
}
