//! Which slices an edge spans, and how near it is in each as the light sees it.

use glam::DVec2;

use super::slices::{LightFrame, PlacedEdge};

/// More of an angle than single precision can be wrong about.
const ANGLE_SLACK: f64 = 4e-6;

/// More of n/r, as a part of it, than single precision can be wrong about.
const NEARNESS_SLACK: f64 = 1e-5;

/// The directions between slices.
pub(crate) struct Borders {
    /// Unit vectors; one for each slice, at which it begins.
    directions: Vec<DVec2>,
    /// Of a slice, as an angle.
    width: f64,
}

impl Borders {
    pub(crate) fn new(slices: usize) -> Borders {
        let width = 4.0 / slices as f64;
        Borders { directions: (0..slices).map(|slice| direction(slice as f64 * width)).collect(), width }
    }

    fn slices(&self) -> i64 {
        self.directions.len() as i64
    }

    /// A slice of any turn as one of the first.
    fn wrapped(&self, slice: i64) -> usize {
        slice.rem_euclid(self.slices()) as usize
    }
}

/// The slices of an edge.
pub(crate) struct Span {
    /// Its number.
    pub edge: u32,
    /// From the first to the last slice; below 0, and above the number of slices, where it passes the end of the turn.
    first: i64,
    last: i64,
    nearest: Nearest,
}

/// The largest n/r of an edge within a slice.
enum Nearest {
    /// The same in all slices.
    Everywhere(f64),
    /// In a direction about the axis n/r is the dot product with `gradient`; it ends at angles with these values.
    Sine { start: (f64, f64), end: (f64, f64), gradient: DVec2, bulge: f64 },
}

impl Span {
    pub(crate) fn of(edge: &PlacedEdge, number: u32, frame: &LightFrame, borders: &Borders) -> Span {
        let Some((start, end)) = angles(edge) else {
            let nearest = Nearest::Everywhere(f64::from(f32::MAX));
            return Span { edge: number, first: 0, last: borders.slices() - 1, nearest };
        };
        let slice = |angle: f64| (angle / borders.width).floor() as i64;
        let (first, last) = (slice(start - ANGLE_SLACK), slice(end + ANGLE_SLACK));
        let nearest = Nearest::of(edge, frame, (start, end), borders.width);
        Span { edge: number, first, last: last.min(first + borders.slices() - 1), nearest }
    }

    /// The slices, from 0 on.
    pub(crate) fn slices(&self, borders: &Borders) -> impl Iterator<Item = usize> {
        (self.first..=self.last).map(|slice| borders.wrapped(slice))
    }

    /// The slices with the largest n/r in each.
    pub(crate) fn crossings(&self, borders: &Borders) -> impl Iterator<Item = (usize, f32)> {
        let mut before = self.nearest.at(self.first, borders);
        (self.first..=self.last).map(move |slice| {
            let behind = self.nearest.at(slice + 1, borders);
            let slack = self.nearest.bulge() + NEARNESS_SLACK * (before.abs() + behind.abs());
            let nearest = before.max(behind) + slack;
            before = behind;
            (borders.wrapped(slice), nearest as f32)
        })
    }
}

impl Nearest {
    fn of(edge: &PlacedEdge, frame: &LightFrame, (start, end): (f64, f64), width: f64) -> Nearest {
        let (a, b) = (edge.a.truncate(), edge.b.truncate());
        let (na, nb) = (frame.distance_from_light(edge.a), frame.distance_from_light(edge.b));
        let turn = a.perp_dot(b);
        let (at_start, at_end) = (na / a.length(), nb / b.length());
        if turn <= 1e-9 * a.length() * b.length() {
            return Nearest::Everywhere(at_start.max(at_end));
        }
        let gradient = DVec2::new(b.y * na - a.y * nb, a.x * nb - b.x * na) / turn;
        // Between two borders it is a part of a sine, which bulges by 1 - cos of half the angle, at most; an angle in rad is
        // at most twice what stands for it.
        let bulge = gradient.length() * (4.0 * width * width).min(4.0) / 6.0;
        Nearest::Sine { start: (start, at_start), end: (end, at_end), gradient, bulge }
    }

    /// n/r where a slice begins, or at the end of the edge.
    fn at(&self, slice: i64, borders: &Borders) -> f64 {
        match self {
            Nearest::Everywhere(value) => *value,
            Nearest::Sine { start, end, gradient, .. } => match slice as f64 * borders.width {
                angle if angle <= start.0 => start.1,
                angle if angle >= end.0 => end.1,
                _ => gradient.dot(borders.directions[borders.wrapped(slice)]),
            },
        }
    }

    /// What n/r may be more between two borders.
    fn bulge(&self) -> f64 {
        match self {
            Nearest::Everywhere(_) => 0.0,
            Nearest::Sine { bulge, .. } => *bulge,
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
