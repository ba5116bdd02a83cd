//! Which slices an edge spans, and how near it is in each as the light sees it.

use std::ops::RangeInclusive;

use glam::DVec2;

use super::slices::{LightFrame, PlacedEdge};

/// More of an angle than single precision can be wrong about.
const ANGLE_SLACK: f64 = 4e-6;

/// More of n/r, as a part of it, than single precision can be wrong about.
const NEARNESS_SLACK: f64 = 1e-5;

/// Bins of a light with many edges.
const BINS_MAX: usize = 1024;

/// Where slices begin. Those below 0, and above their number, are of another turn.
pub(crate) struct Borders {
    /// The first slice of each bin, and one more for the end of the last.
    pub bins: Vec<u32>,
    /// The angles, one for each slice, and one more for the end of the last.
    angles: Vec<f64>,
    /// Unit vectors of these angles.
    directions: Vec<DVec2>,
}

impl Borders {
    /// Of about so many slices, for edges with these ranges of angles.
    pub(crate) fn new(ranges: &[Option<(f64, f64)>], slices: usize) -> Borders {
        let bins = (slices / 4).clamp(1, BINS_MAX);
        let width = 4.0 / bins as f64;
        let mut ends = vec![0_usize; bins];
        for angle in ranges.iter().flatten().flat_map(|(start, end)| [*start, *end]) {
            ends[((angle.rem_euclid(4.0) / width) as usize).min(bins - 1)] += 1;
        }
        let all: usize = ends.iter().sum();
        let narrowest = (width / (2.0 * ANGLE_SLACK)) as usize;
        let slices_of = |ends: &usize| ((slices - bins) * ends / all.max(1) + 1).min(narrowest);
        let mut first = 0;
        let mut borders = Borders { bins: vec![0], angles: Vec::new(), directions: Vec::new() };
        for (bin, count) in ends.iter().map(slices_of).enumerate() {
            borders.angles.extend((0..count).map(|slice| (bin as f64 + slice as f64 / count as f64) * width));
            first += count as u32;
            borders.bins.push(first);
        }
        borders.angles.push(4.0);
        borders.directions = borders.angles.iter().map(|angle| direction(*angle)).collect();
        borders
    }

    /// How many.
    pub(crate) fn slices(&self) -> usize {
        self.angles.len() - 1
    }

    /// A slice of any turn as one of the first.
    fn wrapped(&self, slice: i64) -> usize {
        slice.rem_euclid(self.slices() as i64) as usize
    }

    /// Where a slice of any turn begins.
    fn angle(&self, slice: i64) -> f64 {
        self.angles[self.wrapped(slice)] + 4.0 * slice.div_euclid(self.slices() as i64) as f64
    }

    /// The slice of an angle of any turn. `shadow_ray` of `shadows.wgsl` finds the same, but for rounding.
    fn slice(&self, angle: f64) -> i64 {
        let bins = self.bins.len() - 1;
        let place = angle.rem_euclid(4.0) * 0.25 * bins as f64;
        let bin = (place as usize).min(bins - 1);
        let (first, end) = (i64::from(self.bins[bin]), i64::from(self.bins[bin + 1]));
        let within = ((place - bin as f64) * (end - first) as f64) as i64;
        (angle * 0.25).floor() as i64 * self.slices() as i64 + first + within.min(end - first - 1)
    }

    /// The slices of a range of angles, of all where it may be any, with slack for single precision.
    pub(crate) fn spanned(&self, range: Option<(f64, f64)>) -> RangeInclusive<i64> {
        let slices = self.slices() as i64;
        let (first, last) = match range {
            Some((start, end)) => (self.slice(start - ANGLE_SLACK), self.slice(end + ANGLE_SLACK)),
            None => (0, slices - 1),
        };
        first..=last.min(first + slices - 1)
    }
}

/// The slices of an edge.
pub(crate) struct Span {
    /// Its number.
    pub edge: u32,
    /// Of its angle with the axis, see [`PlacedEdge::cosine_bits`].
    pub least_cosine: u32,
    /// Its slices; below 0, and above their number, where it passes the end of the turn.
    slices: RangeInclusive<i64>,
    nearest: Nearest,
}

/// The largest n/r of an edge within a slice.
enum Nearest {
    /// The same in all slices.
    Everywhere(f64),
    /// In a direction about the axis n/r is the dot product with `gradient`; it ends at angles with these values.
    Sine { start: (f64, f64), end: (f64, f64), gradient: DVec2 },
}

impl Span {
    pub(crate) fn of(
        edge: &PlacedEdge,
        range: Option<(f64, f64)>,
        number: u32,
        frame: &LightFrame,
        borders: &Borders,
    ) -> Span {
        let nearest = match range {
            Some(range) if !edge.is_at_eye() => Nearest::of(edge, frame, range),
            _ => Nearest::Everywhere(f64::from(f32::MAX)),
        };
        Span { edge: number, least_cosine: edge.cosine_bits(), slices: borders.spanned(range), nearest }
    }

    /// The slices, from 0 on.
    pub(crate) fn slices(&self, borders: &Borders) -> impl Iterator<Item = usize> {
        self.slices.clone().map(|slice| borders.wrapped(slice))
    }

    /// The slices with the largest n/r in each.
    pub(crate) fn crossings(&self, borders: &Borders) -> impl Iterator<Item = (usize, f32)> {
        let mut start = borders.angle(*self.slices.start());
        let mut before = self.nearest.at(*self.slices.start(), start, borders);
        self.slices.clone().map(move |slice| {
            let end = borders.angle(slice + 1);
            let behind = self.nearest.at(slice + 1, end, borders);
            let slack = self.nearest.bulge(end - start) + NEARNESS_SLACK * (before.abs() + behind.abs());
            let nearest = before.max(behind) + slack;
            (start, before) = (end, behind);
            (borders.wrapped(slice), nearest as f32)
        })
    }
}

impl Nearest {
    fn of(edge: &PlacedEdge, frame: &LightFrame, (start, end): (f64, f64)) -> Nearest {
        let (a, b) = (edge.a.truncate(), edge.b.truncate());
        let (na, nb) = (frame.distance_from_light(edge.a), frame.distance_from_light(edge.b));
        let turn = a.perp_dot(b);
        let (at_start, at_end) = (na / a.length(), nb / b.length());
        if turn <= 1e-9 * a.length() * b.length() {
            return Nearest::Everywhere(at_start.max(at_end));
        }
        let gradient = DVec2::new(b.y * na - a.y * nb, a.x * nb - b.x * na) / turn;
        Nearest::Sine { start: (start, at_start), end: (end, at_end), gradient }
    }

    /// n/r where a slice begins, which is at this angle, or at the end of the edge.
    fn at(&self, slice: i64, angle: f64, borders: &Borders) -> f64 {
        match self {
            Nearest::Everywhere(value) => *value,
            Nearest::Sine { start, .. } if angle <= start.0 => start.1,
            Nearest::Sine { end, .. } if angle >= end.0 => end.1,
            Nearest::Sine { gradient, .. } => gradient.dot(borders.directions[borders.wrapped(slice)]),
        }
    }

    /// What n/r may be more between two borders this far apart: it is a part of a sine, which bulges by 1 - cos of half the
    /// angle, at most; an angle in rad is at most twice what stands for it, and an edge spans less than half a turn.
    fn bulge(&self, width: f64) -> f64 {
        match self {
            Nearest::Everywhere(_) => 0.0,
            Nearest::Sine { gradient, .. } => gradient.length() * (4.0 * width * width).min(6.0) / 6.0,
        }
    }
}

/// The range of angles of an edge, from 0 to 4 and beyond where it passes the end; `None` where it may be any.
pub(crate) fn angles(edge: &PlacedEdge) -> Option<(f64, f64)> {
    let (a, b) = (edge.a.truncate(), edge.b.truncate());
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
