//! Axes with a line for each power of ten.

use super::Point;
use crate::escaped;

/// The unit of the numbers on an axis.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Unit {
    /// Milliseconds.
    Milliseconds,
    /// Fractions, written as percentages.
    Percent,
    /// A number of things.
    Count,
    /// MiB.
    Mebibytes,
    /// A ratio.
    Ratio,
}

/// An axis: its title and its unit.
pub type Quantity<'a> = (&'a str, Unit);

pub(super) const WIDTH: f64 = 760.0;
pub(super) const HEIGHT: f64 = 470.0;
pub(super) const LEFT: f64 = 78.0;
pub(super) const RIGHT: f64 = 22.0;
pub(super) const TOP: f64 = 44.0;
pub(super) const BOTTOM: f64 = 56.0;

pub(super) fn axes(points: &[Point]) -> Option<(Axis, Axis)> {
    let x = Axis::around(points.iter().map(|point| point.x), LEFT, WIDTH - RIGHT)?;
    Some((x, Axis::around(points.iter().map(|point| point.y), HEIGHT - BOTTOM, TOP)?))
}

/// A logarithmic axis.
#[derive(Debug, Clone, Copy)]
pub(super) struct Axis {
    low: f64,
    high: f64,
    from: f64,
    to: f64,
}

impl Axis {
    /// Whole decades around the values, at least one; `None` without values.
    pub fn around(values: impl Iterator<Item = f64>, from: f64, to: f64) -> Option<Self> {
        let (least, most) = values.fold((f64::INFINITY, 0.0_f64), |(low, high), v| (low.min(v), high.max(v)));
        if !least.is_finite() {
            return None;
        }
        // A value on the edge would be clipped.
        let (low, high) = ((least * 0.8).log10().floor(), (most * 1.25).log10().ceil());
        Some(Self { low, high: high.max(low + 1.0), from, to })
    }

    pub fn at(&self, value: f64) -> f64 {
        self.from + (value.log10() - self.low) / (self.high - self.low) * (self.to - self.from)
    }

    fn decades(&self) -> impl Iterator<Item = i32> {
        self.low as i32..=self.high as i32
    }
}

pub(super) fn grid(svg: &mut String, x: &Axis, y: &Axis, [across, upward]: [Quantity<'_>; 2]) {
    let (right, bottom) = (WIDTH - RIGHT, HEIGHT - BOTTOM);
    for decade in x.decades() {
        let at = x.at(10f64.powi(decade));
        let (text, below) = (across.1.text(decade), bottom + 18.0);
        *svg += &format!(
            "<path class=\"grid\" d=\"M{at:.1} {TOP}V{bottom}\"/><text x=\"{at:.1}\" y=\"{below}\" text-anchor=\"middle\">{text}</text>\n"
        );
    }
    for decade in y.decades() {
        let at = y.at(10f64.powi(decade));
        let (text, before) = (upward.1.text(decade), LEFT - 8.0);
        *svg += &format!(
            "<path class=\"grid\" d=\"M{LEFT} {at:.1}H{right}\"/><text x=\"{before}\" y=\"{:.1}\" text-anchor=\"end\">{text}</text>\n",
            at + 4.0
        );
    }
    *svg += &format!("<path class=\"frame\" d=\"M{LEFT} {TOP}V{bottom}H{right}\"/>\n");
    let (middle, end) = (0.5 * (LEFT + right), HEIGHT - 12.0);
    *svg += &format!("<text x=\"{middle}\" y=\"{end}\" text-anchor=\"middle\">{}</text>\n", escaped(across.0));
    let middle = 0.5 * (TOP + bottom);
    *svg += &format!(
        "<text transform=\"translate(16 {middle}) rotate(-90)\" text-anchor=\"middle\">{}</text>\n",
        escaped(upward.0)
    );
}

impl Unit {
    /// A power of ten.
    fn text(self, decade: i32) -> String {
        match self {
            Self::Milliseconds => milliseconds(decade),
            Self::Percent => percent(decade),
            Self::Mebibytes => format!("{} MiB", 10f64.powi(decade)),
            Self::Count => match decade {
                6.. => format!("{} M", 10f64.powi(decade - 6)),
                3.. => format!("{} k", 10f64.powi(decade - 3)),
                _ => format!("{}", 10f64.powi(decade)),
            },
            Self::Ratio => format!("{}×", 10f64.powi(decade)),
        }
    }
}

fn milliseconds(decade: i32) -> String {
    match decade {
        ..=-4 => format!("1e{decade} ms"),
        -3..=-1 => format!("{} µs", 10i32.pow((decade + 3) as u32)),
        0..=2 => format!("{} ms", 10i32.pow(decade as u32)),
        _ => format!("{} s", 10f64.powi(decade - 3)),
    }
}

fn percent(decade: i32) -> String {
    match decade {
        ..=-6 => format!("1e{decade}"),
        1.. => format!("{}×", 10f64.powi(decade)),
        _ => format!("{} %", 10f64.powi(decade + 2)),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn decades_are_far_apart_by_the_same_way() {
        let axis = Axis::around([0.2, 300.0].into_iter(), 0.0, 400.0).unwrap();
        assert_eq!((axis.low, axis.high), (-1.0, 3.0));
        assert!((axis.at(1.0) - 100.0).abs() < 1e-9 && (axis.at(10.0) - 200.0).abs() < 1e-9);
        assert!(Axis::around(std::iter::empty(), 0.0, 1.0).is_none());
    }
}
