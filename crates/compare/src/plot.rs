//! Plots as SVG, with logarithmic axes: error over time, with a mark for each method and the Pareto front; and any quantity
//! over another.

use std::fmt::Write;

use crate::page::escaped;

/// A mark.
#[derive(Debug, Clone, PartialEq)]
pub struct Point {
    /// Its label; it may be empty.
    pub label: String,
    /// Marks of one family look alike and are joined in their order.
    pub family: usize,
    /// Its place on the horizontal axis.
    pub x: f64,
    /// Its place on the vertical axis.
    pub y: f64,
}

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

const WIDTH: f64 = 760.0;
const HEIGHT: f64 = 470.0;
const LEFT: f64 = 78.0;
const RIGHT: f64 = 22.0;
const TOP: f64 = 44.0;
const BOTTOM: f64 = 56.0;

/// Smaller errors, 0 included, are drawn at this one: the limit of single precision.
const LEAST_ERROR: f64 = 1e-8;
/// Larger errors are drawn at this one.
const MOST_ERROR: f64 = 1e6;

/// Colours that everybody can tell apart, on white and on black (Okabe and Ito 2008).
const STYLE: &str = "
.plot { font: 12px system-ui, sans-serif; color: #222; }
.plot text { fill: currentColor; }
.plot .title { font-weight: 600; font-size: 14px; }
.plot .grid { stroke: currentColor; stroke-opacity: .14; }
.plot .frame { stroke: currentColor; stroke-opacity: .6; fill: none; }
.plot .front { stroke: currentColor; stroke-width: 2; stroke-opacity: .55; fill: none; }
.plot .family { fill: none; stroke-width: 1.2; stroke-dasharray: 2 4; }
.plot .mark { stroke-width: 2; }
.plot .f0 { stroke: #0072b2; color: #0072b2; }
.plot .f1 { stroke: #d55e00; color: #d55e00; }
.plot .f2 { stroke: #009e73; color: #009e73; }
.plot .f3 { stroke: #cc79a7; color: #cc79a7; }
.plot .f4 { stroke: #b58900; color: #b58900; }
.plot .f5 { stroke: #56b4e9; color: #56b4e9; }
.plot .on { fill: currentColor; }
.plot .off { fill: none; }
@media (prefers-color-scheme: dark) { .plot { color: #ddd; } .plot .f0 { stroke: #4aa8e0; color: #4aa8e0; } }
";
const FAMILIES: usize = 6;

/// Error over the GPU time of a frame, ms, or `None` where no method has a time. `error_name` says which error it is.
pub(crate) fn plot(title: &str, error_name: &str, points: &[Point]) -> Option<String> {
    let points: Vec<Point> = timed(points).map(|point| Point { y: at_least(point.y), ..point.clone() }).collect();
    let (x, y) = axes(&points)?;
    let mut svg = start(title, "Line, and filled: no method is both faster and closer");
    grid(&mut svg, &x, &y, [("GPU time of a frame", Unit::Milliseconds), (error_name, Unit::Percent)]);
    let front = front(&points);
    step(&mut svg, &x, &y, &front);
    families(&mut svg, &x, &y, &points);
    for point in &points {
        mark(&mut svg, &x, &y, point, front.contains(&point));
    }
    labels(&mut svg, &x, &y, &points, &front);
    Some(svg + "</svg>\n")
}

/// One quantity over another as an SVG: a line with marks for each family. `note` is printed below the title; at the vertical
/// value `rule` a line is drawn across. `None` if there is no point with positive numbers.
pub fn curves(
    (title, note): (&str, &str),
    [across, upward]: [Quantity<'_>; 2],
    rule: Option<f64>,
    points: &[Point],
) -> Option<String> {
    let points: Vec<Point> = timed(points).filter(|point| point.y.is_finite() && point.y > 0.0).cloned().collect();
    let ruled = rule.and_then(|rule| Some(Point { y: rule, ..points.first()?.clone() }));
    let (x, y) = axes(&points.iter().cloned().chain(ruled).collect::<Vec<_>>())?;
    let mut svg = start(title, note);
    grid(&mut svg, &x, &y, [across, upward]);
    if let Some(rule) = rule {
        svg += &format!("<path class=\"front\" d=\"M{LEFT} {:.1}H{}\"/>\n", y.at(rule), WIDTH - RIGHT);
    }
    families(&mut svg, &x, &y, &points);
    for point in &points {
        mark(&mut svg, &x, &y, point, true);
    }
    labels(&mut svg, &x, &y, &points, &[]);
    Some(svg + "</svg>\n")
}

/// The points that have a place on a logarithmic horizontal axis.
fn timed(points: &[Point]) -> impl Iterator<Item = &Point> {
    points.iter().filter(|point| point.x.is_finite() && point.x > 0.0)
}

fn axes(points: &[Point]) -> Option<(Axis, Axis)> {
    let x = Axis::around(points.iter().map(|point| point.x), LEFT, WIDTH - RIGHT)?;
    Some((x, Axis::around(points.iter().map(|point| point.y), HEIGHT - BOTTOM, TOP)?))
}

fn start(title: &str, note: &str) -> String {
    format!(
        "<svg class=\"plot\" xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {WIDTH} {HEIGHT}\" role=\"img\" \
         aria-label=\"{0}\">\n<style>{STYLE}</style>\n<text class=\"title\" x=\"{LEFT}\" y=\"16\">{0}</text>\n\
         <text x=\"{LEFT}\" y=\"33\">{1}</text>\n",
        escaped(title),
        escaped(note)
    )
}

fn at_least(error: f64) -> f64 {
    if error.is_nan() { MOST_ERROR } else { error.clamp(LEAST_ERROR, MOST_ERROR) }
}

/// A logarithmic axis.
#[derive(Debug, Clone, Copy)]
struct Axis {
    low: f64,
    high: f64,
    from: f64,
    to: f64,
}

impl Axis {
    /// Whole decades around the values, at least one; `None` without values.
    fn around(values: impl Iterator<Item = f64>, from: f64, to: f64) -> Option<Self> {
        let (least, most) = values.fold((f64::INFINITY, 0.0_f64), |(low, high), v| (low.min(v), high.max(v)));
        if !least.is_finite() {
            return None;
        }
        // A value on the edge would be clipped.
        let (low, high) = ((least * 0.8).log10().floor(), (most * 1.25).log10().ceil());
        Some(Self { low, high: high.max(low + 1.0), from, to })
    }

    fn at(&self, value: f64) -> f64 {
        self.from + (value.log10() - self.low) / (self.high - self.low) * (self.to - self.from)
    }

    fn decades(&self) -> impl Iterator<Item = i32> {
        self.low as i32..=self.high as i32
    }
}

fn grid(svg: &mut String, x: &Axis, y: &Axis, [across, upward]: [Quantity<'_>; 2]) {
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

/// The methods that no other one beats in both time and error, by time.
pub(crate) fn front(points: &[Point]) -> Vec<&Point> {
    let mut sorted: Vec<&Point> = points.iter().collect();
    sorted.sort_by(|a, b| a.x.total_cmp(&b.x).then(a.y.total_cmp(&b.y)));
    let mut least = f64::INFINITY;
    sorted.retain(|point| {
        let passes = point.y < least;
        least = least.min(point.y);
        passes
    });
    sorted
}

/// The Pareto front: from the fastest method to the right and down.
fn step(svg: &mut String, x: &Axis, y: &Axis, front: &[&Point]) {
    let Some(first) = front.first() else { return };
    let mut path = format!("M{:.1} {TOP}", x.at(first.x));
    for point in front {
        // Writing to a string cannot fail.
        let _ = write!(path, "H{:.1}V{:.1}", x.at(point.x), y.at(point.y));
    }
    *svg += &format!("<path class=\"front\" d=\"{path}H{}\"/>\n", WIDTH - RIGHT);
}

/// The horizontal parts of the front, slightly above its line.
fn treads(x: &Axis, y: &Axis, front: &[&Point]) -> Vec<Area> {
    let ends = front.iter().skip(1).map(|point| x.at(point.x)).chain([WIDTH - RIGHT]);
    let tread = |(point, end): (&&Point, f64)| {
        let start = x.at(point.x);
        Area { x: start, y: y.at(point.y) - 2.0, width: end - start, height: 4.0 }
    };
    front.iter().zip(ends).map(tread).collect()
}

fn families(svg: &mut String, x: &Axis, y: &Axis, points: &[Point]) {
    let count = points.iter().map(|point| point.family + 1).max().unwrap_or_default();
    for family in 0..count {
        let members = points.iter().filter(|point| point.family == family);
        let path: Vec<String> = members.map(|point| format!("{:.1} {:.1}", x.at(point.x), y.at(point.y))).collect();
        if path.len() > 1 {
            *svg += &format!("<path class=\"family f{}\" d=\"M{}\"/>\n", family % FAMILIES, path.join("L"));
        }
    }
}

/// Families also differ by shape.
fn mark(svg: &mut String, x: &Axis, y: &Axis, point: &Point, is_on_front: bool) {
    let shape = match point.family % 4 {
        0 => "M-5 0a5 5 0 1 0 10 0a5 5 0 1 0 -10 0Z",
        1 => "M-4.5 -4.5H4.5V4.5H-4.5Z",
        2 => "M0 -6L6 0L0 6L-6 0Z",
        _ => "M0 -6L5.5 4H-5.5Z",
    };
    let (fill, family) = (if is_on_front { "on" } else { "off" }, point.family % FAMILIES);
    let (at_x, at_y) = (x.at(point.x), y.at(point.y));
    let about = format!("{}: {}, {:e}", point.label, point.x, point.y);
    *svg += &format!(
        "<path class=\"mark {fill} f{family}\" transform=\"translate({at_x:.1} {at_y:.1})\" d=\"{shape}\"><title>{}</title></path>\n",
        escaped(&about)
    );
}

/// A rectangle of the picture.
#[derive(Debug, Clone, Copy)]
struct Area {
    x: f64,
    y: f64,
    width: f64,
    height: f64,
}

impl Area {
    fn overlap(&self, other: &Area) -> f64 {
        let width = (self.x + self.width).min(other.x + other.width) - self.x.max(other.x);
        let height = (self.y + self.height).min(other.y + other.height) - self.y.max(other.y);
        width.max(0.0) * height.max(0.0)
    }
}

/// Places each label beside its mark, where it covers least of the marks, the front and the labels before it.
fn labels(svg: &mut String, x: &Axis, y: &Axis, points: &[Point], front: &[&Point]) {
    let plot = Area { x: LEFT, y: TOP, width: WIDTH - RIGHT - LEFT, height: HEIGHT - BOTTOM - TOP };
    let around = |point: &Point| Area { x: x.at(point.x) - 6.0, y: y.at(point.y) - 6.0, width: 12.0, height: 12.0 };
    let mut taken: Vec<Area> = points.iter().map(around).collect();
    taken.extend(treads(x, y, front));
    for point in points.iter().filter(|point| !point.label.is_empty()) {
        let (at_x, at_y) = (x.at(point.x), y.at(point.y));
        // For letters of 12 px.
        let (width, height) = (6.4 * point.label.chars().count() as f64, 13.0);
        let places =
            [(1.0, 0.0), (-1.0, 0.0), (0.0, -1.0), (0.0, 1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, -1.0), (-1.0, 1.0)];
        let at = |(across, down): (f64, f64), away: f64| Area {
            x: at_x + across * (away + 0.5 * width) - 0.5 * width,
            y: at_y + down * (away + 3.0) - 0.5 * height,
            width,
            height,
        };
        let cost = |area: &Area| {
            let outside = area.width * area.height - area.overlap(&plot);
            taken.iter().map(|other| area.overlap(other)).sum::<f64>() + 4.0 * outside
        };
        let candidates = [10.0, 22.0, 36.0].into_iter().flat_map(|away| places.map(|place| at(place, away)));
        let best = candidates.min_by(|a, b| cost(a).total_cmp(&cost(b)));
        if let Some(area) = best {
            *svg += &format!(
                "<text x=\"{:.1}\" y=\"{:.1}\" textLength=\"{width:.0}\" lengthAdjust=\"spacingAndGlyphs\">{}</text>\n",
                area.x,
                area.y + 10.5,
                escaped(&point.label)
            );
            taken.push(area);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn point(label: &str, x: f64, y: f64) -> Point {
        Point { label: label.to_owned(), family: 0, x, y }
    }

    #[test]
    fn the_front_holds_what_nothing_passes() {
        let points =
            [point("slow", 9.0, 0.1), point("fast", 1.0, 0.5), point("best", 3.0, 0.01), point("tie", 3.0, 0.01)];
        let names: Vec<&str> = front(&points).iter().map(|point| point.label.as_str()).collect();
        assert_eq!(names, ["fast", "best"]);
    }

    #[test]
    fn decades_are_far_apart_by_the_same_way() {
        let axis = Axis::around([0.2, 300.0].into_iter(), 0.0, 400.0).unwrap();
        assert_eq!((axis.low, axis.high), (-1.0, 3.0));
        assert!((axis.at(1.0) - 100.0).abs() < 1e-9 && (axis.at(10.0) - 200.0).abs() < 1e-9);
        assert!(Axis::around(std::iter::empty(), 0.0, 1.0).is_none());
    }

    #[test]
    fn errors_of_all_sizes_have_a_place_and_names_are_escaped() {
        let points = [point("a < b", 1.0, 0.0), point("c", 2.0, f64::INFINITY), point("d", 2.5, f64::NAN)];
        let svg = plot("t", "p99", &points).unwrap();
        assert!(svg.contains("a &lt; b") && !svg.contains("NaN") && !svg.contains("inf"), "{svg}");
        assert_eq!(plot("t", "p99", &[point("a", f64::NAN, 0.1)]), None);
    }

    #[test]
    fn a_curve_has_a_mark_for_each_point_and_names_for_some() {
        let points = [point("", 12.0, 0.5), point("cost", 1.4e5, 30.0), point("none", 2.0, 0.0)];
        let units = [("triangles", Unit::Count), ("ratio", Unit::Ratio)];
        let svg = curves(("t", "n < m"), units, Some(1.0), &points).unwrap();
        assert_eq!(svg.matches("class=\"mark").count(), 2);
        assert_eq!((svg.matches("textLength").count(), svg.matches("class=\"front\"").count()), (1, 1));
        for part in [">100 k<", ">0.1×<", "n &lt; m", ">cost</text>", ">triangles</text>"] {
            assert!(svg.contains(part), "{part} in {svg}");
        }
        assert_eq!(curves(("t", ""), units, Some(1.0), &[]), None);
    }

    #[test]
    fn labels_of_marks_apart_do_not_cover_each_other() {
        let points = [point("one method", 1.0, 0.1), point("another method", 1.3, 0.09), point("a third", 1.1, 0.11)];
        let svg = plot("t", "p99", &points).unwrap();
        let attribute = |line: &str, name: &str| -> f64 {
            line.split(&format!(" {name}=\"")).nth(1).unwrap().split('"').next().unwrap().parse().unwrap()
        };
        let labels: Vec<Area> = svg
            .lines()
            .filter(|line| line.contains("textLength"))
            .map(|line| Area {
                x: attribute(line, "x"),
                y: attribute(line, "y"),
                width: attribute(line, "textLength"),
                height: 13.0,
            })
            .collect();
        assert_eq!(labels.len(), 3);
        for (index, label) in labels.iter().enumerate() {
            assert!(labels[..index].iter().all(|other| label.overlap(other) < 1.0), "{labels:?}");
        }
    }
}
