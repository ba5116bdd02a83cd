//! The silhouette of a light, sorted into slices about the axis through light and eye.
//!
//! Every view ray and the light span a half-plane that begins at that axis, so an angle about the axis says which edges a
//! ray can cross: those that span the angle. A slice is a range of angles and lists the edges that span a part of it, in
//! the order in which a ray crosses them. Slices are narrow where edges begin and end, and wide elsewhere: the turn is
//! divided into equal bins, and each bin into equal slices, the more the more edges end in it.
//!
//! Edges stand in the frame of the light: x and y across the axis, z along it from the light to the eye, the eye at the
//! origin, m. A light at the distance l has the nearness κ = 1/l, a sun 0. As the light sees it, a point is in the
//! direction (x, y, n) with n = 1 + κz. Within a half-plane, with the distance r from the axis, `n/r` falls along every
//! ray, whatever its direction: it says what is crossed first.

use std::ops::Range;

use glam::{DMat3, DVec3};
use tyndall_plugin::scene::layout::floats;
use tyndall_shaders::shadows::Source;

use super::layout::{ShadowCrossing, ShadowEdge, ShadowLight};
use super::silhouette::SilhouetteEdge;
use super::spans::{Borders, Span, angles};

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

    pub(crate) fn eye(&self) -> DVec3 {
        self.eye
    }

    /// From the light to the eye, a unit vector.
    pub(crate) fn axis(&self) -> DVec3 {
        self.world_from_light.z_axis
    }

    /// The light's part of the encoded lists, but for where the rest stands in them.
    pub(crate) fn encode(&self, depth_at_eye: i32) -> ShadowLight {
        ShadowLight {
            across: floats(self.world_from_light.x_axis),
            nearness: self.nearness as f32,
            upward: floats(self.world_from_light.y_axis),
            depth_at_eye,
            axis: floats(self.world_from_light.z_axis),
            ..Default::default()
        }
    }

    /// n of a point in this frame: as a part of the distance from the light to the eye.
    pub(crate) fn distance_from_light(&self, place: DVec3) -> f64 {
        1.0 + self.nearness * place.z
    }
}

/// Which way an edge runs about the axis.
pub(crate) struct Turning {
    /// The axis is to the left of the way from its first vertex to its second (x to the right, y up).
    pub left: bool,
}

impl Turning {
    /// The same for an edge whichever triangle asks, but for the sign: vertices are ordered by where they are.
    pub(crate) fn of(from: DVec3, to: DVec3) -> Turning {
        let ordered = from.to_array() <= to.to_array();
        let (first, second) = if ordered { (from, to) } else { (to, from) };
        Turning { left: (first.truncate().perp_dot(second.truncate()) >= 0.0) == ordered }
    }
}

/// An edge that runs counter-clockwise about the axis.
#[derive(Clone, Copy, Debug)]
pub(crate) struct PlacedEdge {
    /// m.
    pub a: DVec3,
    /// m.
    pub b: DVec3,
    /// By how many triangles there are more between the light and a ray that crosses the edge from the axis outward.
    step: i32,
    /// Of a triangle that touches the eye: z where the axis meets its plane, m.
    away: Option<f32>,
}

impl PlacedEdge {
    /// `None` if a vertex is not finite.
    pub(crate) fn of(edge: &SilhouetteEdge, places: &[DVec3]) -> Option<PlacedEdge> {
        let [a, b] = edge.vertices.map(|vertex| places[vertex as usize]);
        let placed = if Turning::of(a, b).left {
            PlacedEdge { a, b, step: edge.excess, away: None }
        } else {
            PlacedEdge { a: b, b: a, step: -edge.excess, away: None }
        };
        (a.is_finite() && b.is_finite()).then_some(placed)
    }

    /// The same of a triangle that touches the eye: rays that pass behind it are in the triangle's shadow from the start.
    pub(crate) fn at_eye(self, away: f64) -> PlacedEdge {
        let (least, most) = (1e-18, 1e18);
        let away = away.signum() * away.abs().clamp(least, most);
        PlacedEdge { step: -self.step, away: Some(away as f32), ..self }
    }

    /// The least cosine of the angle between the axis and a point of the edge, as the eye sees it.
    fn least_cosine(&self) -> f64 {
        let (a, b) = (self.a.normalize(), self.b.normalize());
        let normal = a.cross(b).normalize_or_zero();
        // of the whole circle, at the point that is farthest from the axis
        let farthest = normal * normal.z - DVec3::Z;
        let is_within = normal.dot(a.cross(farthest)) >= 0.0 && normal.dot(farthest.cross(b)) >= 0.0;
        let of_ends = a.z.min(b.z);
        if normal == DVec3::ZERO {
            -1.0
        } else if is_within {
            -farthest.length()
        } else {
            of_ends
        }
    }

    /// The same as walks hold it. What is at the eye may be at any angle.
    pub(crate) fn cosine_bits(&self) -> u32 {
        let along = self.b - self.a;
        let part = (-self.a.dot(along) / along.length_squared()).clamp(0.0, 1.0);
        let nearest = (self.a + along * part).length();
        // where the walk meets an edge it errs by a part of the edge's farther end
        let slack = COSINE_SLACK * self.a.length().max(self.b.length()) / nearest;
        let cosine = self.least_cosine() - slack;
        if self.is_at_eye() || !cosine.is_finite() { 0 } else { cosine_bits(cosine) }
    }

    /// Whether it is of a triangle that touches the eye.
    pub(crate) fn is_at_eye(&self) -> bool {
        self.away.is_some()
    }

    pub(crate) fn encode(&self) -> ShadowEdge {
        let with = |place: DVec3, last: f32| place.as_vec3().extend(last).to_array();
        ShadowEdge { a: with(self.a, self.step as f32), b: with(self.b, self.away.unwrap_or(0.0)) }
    }
}

/// Slices of a light with few edges, and of one with many: more than there are pixels along the rim of a picture do not
/// help.
const SLICES: (usize, usize) = (16, 4096);

/// Crossings of all slices of a light at most, 32 MiB: above that slices are wider.
const CROSSINGS_OF_LIGHT: usize = 1 << 22;

/// Crossings of all lights at most, as many as a binding of 128 MiB holds, which every device has, beside its header.
pub(crate) const CROSSINGS_MAX: usize = (1 << 24) - 2;

/// More of an angle, rad, than single precision can be wrong about where both ends of an edge are as far away.
const COSINE_SLACK: f64 = 1e-5;

/// Fewer crossings are not worth a thread.
const CROSSINGS_OF_THREAD: usize = 1 << 14;

/// Where slices lie so that there are no more crossings than that, unless there are as many edges.
pub(crate) fn lay_out(frame: &LightFrame, edges: &[PlacedEdge], first_edge: u32, most: usize) -> (Borders, Vec<Span>) {
    let most = most.min(CROSSINGS_OF_LIGHT);
    let ranges: Vec<Option<(f64, f64)>> = edges.iter().map(angles).collect();
    let mut slices = (4 * edges.len()).next_power_of_two().clamp(SLICES.0, SLICES.1);
    loop {
        let borders = Borders::new(&ranges, slices);
        let crossings: usize = ranges.iter().map(|range| borders.spanned(*range).count()).sum();
        if crossings <= most || slices == 1 {
            let placed = edges.iter().zip(&ranges).zip(first_edge..);
            let spans = placed.map(|((edge, range), number)| Span::of(edge, *range, number, frame, &borders)).collect();
            return (borders, spans);
        }
        slices /= 2;
    }
}

/// Appends to `crossings` those of each slice and to `starts` the bins and where each slice begins.
pub(crate) fn sort(borders: &Borders, spans: &[Span], starts: &mut Vec<u32>, crossings: &mut Vec<ShadowCrossing>) {
    let mut ends = vec![0; borders.slices()];
    for slice in spans.iter().flat_map(|span| span.slices(borders)) {
        ends[slice] += 1;
    }
    let mut end = 0;
    for slice in &mut ends {
        end += *slice;
        *slice = end;
    }
    let first = crossings.len();
    starts.extend(borders.bins.windows(2).map(|slices| slices[0] << 16 | (slices[1] - slices[0])));
    starts.extend([0].iter().chain(&ends).map(|end| (first + end) as u32));
    crossings.resize(first + end, ShadowCrossing::default());
    let threads = rayon::current_num_threads().min(1 + end / CROSSINGS_OF_THREAD);
    rayon::scope(|scope| {
        let mut rest = &mut crossings[first..];
        let mut done = 0;
        for thread in 1..=threads {
            let until = ends.partition_point(|slice_end| *slice_end <= end * thread / threads).max(done);
            let before = if done == 0 { 0 } else { ends[done - 1] };
            let count = if until == done { 0 } else { ends[until - 1] - before };
            let (part, others) = rest.split_at_mut(count);
            rest = others;
            let (ends, range) = (&ends, done..until);
            let fill = move || fill(spans, borders, range, ends, part);
            done = until;
            // The last part is for this thread.
            if thread == threads {
                fill();
            } else {
                scope.spawn(|_| fill());
            }
        }
    });
}

/// Fills the crossings of a range of slices, sorted by how near they are. `ends` are of all slices; `crossings` begin with
/// the first of the range.
fn fill(spans: &[Span], borders: &Borders, range: Range<usize>, ends: &[usize], crossings: &mut [ShadowCrossing]) {
    let start = |slice: usize| if slice == 0 { 0 } else { ends[slice - 1] };
    let first = start(range.start);
    let mut next: Vec<usize> = range.clone().map(|slice| start(slice) - first).collect();
    let mut keys = vec![0; crossings.len()];
    for span in spans {
        for (slice, nearest) in span.crossings(borders) {
            if range.contains(&slice) {
                let next = &mut next[slice - range.start];
                keys[*next] = key(with_cosine(nearest, span.least_cosine), span.edge);
                *next += 1;
            }
        }
    }
    for slice in range {
        keys[start(slice) - first..ends[slice] - first].sort_unstable();
    }
    for (crossing, key) in crossings.iter_mut().zip(keys) {
        *crossing = [nearest_of(key), key as u32];
    }
}

/// A number that is the smaller the nearer a crossing is, and the smaller its edge's number where two are equally near.
fn key(bits: u32, edge: u32) -> u64 {
    // The bits of floating-point numbers, the sign apart, are in the order of the numbers.
    let descending = if bits & SIGN == 0 { !(bits | SIGN) } else { bits };
    u64::from(descending) << 32 | u64::from(edge)
}

fn nearest_of(key: u64) -> u32 {
    let descending = (key >> 32) as u32;
    if descending & SIGN == 0 { !descending & !SIGN } else { descending }
}

/// `COSINE_BITS` of `shadows.wgsl`.
const COSINE_BITS: u32 = 0x3ff;

/// The first number of a crossing: `nearest`, rounded up, its lower bits those of the cosine, rounded down.
fn with_cosine(nearest: f32, cosine: u32) -> u32 {
    let bits = nearest.to_bits();
    let above = if bits & SIGN == 0 { bits + COSINE_BITS } else { bits };
    above & !COSINE_BITS | cosine
}

/// What stands for a cosine, or for a smaller one.
fn cosine_bits(cosine: f64) -> u32 {
    ((cosine + 1.0) * 0.5 * f64::from(COSINE_BITS)).clamp(0.0, f64::from(COSINE_BITS)) as u32
}

const SIGN: u32 = 1 << 31;

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn keys_sort_from_the_nearest_to_the_farthest() {
        let crossings = [(f32::MAX, 2), (3.5, 0), (3.5, 7), (1e-30, 1), (0.0, 4), (-0.0, 1), (-2.0, 3), (f32::MIN, 0)];
        let keys = crossings.map(|(nearest, edge)| key(nearest.to_bits(), edge));
        assert!(keys.is_sorted());
        assert_eq!(keys.map(|key| (f32::from_bits(nearest_of(key)), key as u32)), crossings);
    }

    /// What rounding leaves is a bound still, and in the same order.
    #[test]
    fn a_cosine_beside_what_is_nearest_loosens_it_upward() {
        let nearest = [f32::MIN, -3.5, -1e-30, 0.0, 1e-30, 1.000_001, 3.5, 1e30];
        let loosened = nearest.map(|nearest| f32::from_bits(with_cosine(nearest, 0x155) & !COSINE_BITS));
        assert!(loosened.is_sorted());
        for (nearest, loosened) in nearest.into_iter().zip(loosened) {
            assert!(loosened >= nearest && loosened - nearest <= 2e-4 * nearest.abs() + 2e-42, "{nearest} {loosened}");
        }
        assert_eq!(with_cosine(f32::MAX, 0) & !COSINE_BITS, f32::INFINITY.to_bits());
    }

    /// Of an edge that passes the way to the light, the least cosine is not at an end.
    #[test]
    fn least_cosine_of_an_edge() {
        let edge = |a, b| PlacedEdge { a, b, step: 1, away: None };
        let beyond = edge(DVec3::new(1.0, 0.1, -1.0), DVec3::new(-1.0, 0.1, -1.0));
        let sampled = |edge: &PlacedEdge| {
            let cosine = |i: u32| edge.a.lerp(edge.b, f64::from(i) / 1000.0).normalize().z;
            (0..=1000).map(cosine).fold(1.0, f64::min)
        };
        let mut random = 1_u32;
        let mut number = move || {
            random = random.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            f64::from(random >> 8) / f64::from(1 << 23) - 1.0
        };
        let mut point = || DVec3::new(number(), number(), number());
        for edge in std::iter::once(beyond).chain((0..500).map(|_| edge(point(), point()))) {
            let (found, expected) = (edge.least_cosine(), sampled(&edge));
            assert!(found <= expected + 1e-12 && found >= expected - 1e-2, "{edge:?}: {found} {expected}");
        }
    }

    /// Edges of a ring of small squares about the axis, seen from the side, all within a degree of one another or all round.
    fn ring(width: f64) -> (LightFrame, Vec<PlacedEdge>) {
        let frame = LightFrame::new(Source::Along(DVec3::Z), DVec3::ZERO).unwrap();
        let edge = |index: u32| {
            let at = |turn: f64| DVec3::new(turn.cos(), turn.sin(), 0.3 * turn.sin()) * (1.0 + f64::from(index % 7));
            let turn = 1.0 + width * f64::from(index) / 1000.0;
            PlacedEdge { a: at(turn), b: at(turn + width / 1000.0), step: 1, away: None }
        };
        (frame, (0..1000).map(edge).collect())
    }

    fn crossings_by_slice(width: f64, most: usize) -> Vec<usize> {
        let (frame, edges) = ring(width);
        let (borders, spans) = lay_out(&frame, &edges, 0, most);
        let (mut starts, mut crossings) = (Vec::new(), Vec::new());
        sort(&borders, &spans, &mut starts, &mut crossings);
        let slices = &starts[borders.bins.len() - 1..];
        assert_eq!(slices.last().map(|end| *end as usize), Some(crossings.len()));
        slices.windows(2).map(|pair| (pair[1] - pair[0]) as usize).collect()
    }

    /// However small the part of the turn is that edges are in, no slice has many.
    #[test]
    fn slices_lie_where_edges_are() {
        for width in [std::f64::consts::TAU, 0.1, 0.01] {
            let most = crossings_by_slice(width, usize::MAX).into_iter().max();
            assert!(most.is_some_and(|most| most <= 10), "{most:?} crossings in a slice, edges within {width} rad");
        }
    }

    /// Where there is little room, slices are wider, down to one that holds every edge.
    #[test]
    fn crossings_keep_within_their_room() {
        for room in [100_000, 5_000, 2_500, 1_100] {
            let crossings: usize = crossings_by_slice(0.3, room).iter().sum();
            assert!(crossings <= room && crossings >= 1000, "{crossings} of {room}");
        }
        assert_eq!(crossings_by_slice(0.3, 10), [1000]);
    }
}
