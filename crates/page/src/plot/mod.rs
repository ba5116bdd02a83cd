//! Plots as SVG, with logarithmic axes: error over time, with a mark for each method and the Pareto front; and any quantity
//! over another.

mod axis;
mod labels;

use std::fmt::Write;

use crate::escaped;
use axis::{Axis, HEIGHT, LEFT, RIGHT, TOP, WIDTH, axes, grid};
use labels::labels;

pub use axis::{Quantity, Unit};

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
pub fn plot(title: &str, error_name: &str, points: &[Point]) -> Option<String> {
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

/// The methods that no other one beats in both time and error, by time.
fn front(points: &[Point]) -> Vec<&Point> {
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
}
