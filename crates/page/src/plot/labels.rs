//! Labels beside marks, where they cover least.

use super::Point;
use super::axis::{Axis, BOTTOM, HEIGHT, LEFT, RIGHT, TOP, WIDTH};
use crate::escaped;

/// A rectangle of the picture.
#[derive(Debug, Clone, Copy)]
pub(super) struct Area {
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
pub(super) fn labels(svg: &mut String, x: &Axis, y: &Axis, points: &[Point], front: &[&Point]) {
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

/// The horizontal parts of the front, slightly above its line.
fn treads(x: &Axis, y: &Axis, front: &[&Point]) -> Vec<Area> {
    let ends = front.iter().skip(1).map(|point| x.at(point.x)).chain([WIDTH - RIGHT]);
    let tread = |(point, end): (&&Point, f64)| {
        let start = x.at(point.x);
        Area { x: start, y: y.at(point.y) - 2.0, width: end - start, height: 4.0 }
    };
    front.iter().zip(ends).map(tread).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::plot;

    #[test]
    fn labels_of_marks_apart_do_not_cover_each_other() {
        let point = |(label, x, y): (&str, f64, f64)| Point { label: label.to_owned(), family: 0, x, y };
        let points = [("one method", 1.0, 0.1), ("another method", 1.3, 0.09), ("a third", 1.1, 0.11)].map(point);
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
