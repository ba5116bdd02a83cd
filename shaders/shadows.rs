//! The parts of a ray that a light reaches, by brute force and independent of silhouettes: what shadows are held against,
//! `shadows.wgsl` of `shadow_planes` and `occluders.wgsl` of `march`.
//!
//! The shadow of a triangle is convex: the space behind it within the pyramid from the light. So each triangle shadows one
//! interval of a ray, and what is left of the ray beside all intervals is lit.

use crate::ray::Ray;
use crate::scene::{Caster, Light};
use glam::DVec3;

/// Where light comes from.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Source {
    /// A point, m.
    At(DVec3),
    /// The way light travels everywhere, a unit vector.
    Along(DVec3),
}

impl Source {
    /// Of a light.
    pub fn of(light: &Light) -> Source {
        match *light {
            Light::Point { position, .. } | Light::Spot { position, .. } => Source::At(position),
            Light::Directional { direction, .. } => Source::Along(direction),
        }
    }
}

/// By what part single precision may have moved a number in all that leads to the height of a light above a triangle:
/// eight roundings.
const ROUNDED: f64 = 8.0 / (1 << 24) as f64;

/// Which way a triangle faces: 1 where its corners run counter-clockwise as the light sees them, -1 clockwise, and 0 where
/// the light sees it edge on, where it has no area, or where a corner is not finite.
///
/// A lamp on a surface is in the plane of its triangles but for the rounding of coordinates, which must not decide whether
/// it lights a room: as near as that is edge on. A lamp that is farther from the plane than its coordinates and the
/// triangle's were rounded is not, however far the triangle reaches. `shadow_of_triangle` in `occluders.wgsl` says the same.
pub fn facing(source: Source, &[a, b, c]: &Caster) -> i8 {
    let normal = (b - a).cross(c - a);
    let (height, rounded) = match source {
        Source::At(light) => height_above(light, normal, &[a, b, c]),
        Source::Along(direction) => (-normal.dot(direction), ROUNDED * normal.length()),
    };
    if height.is_finite() && height.abs() > rounded { height.signum() as i8 } else { 0 }
}

/// Height of a point above the plane of a triangle with this normal, and what rounding leaves open of it; both times the
/// normal's length.
pub fn height_above(point: DVec3, normal: DVec3, &[a, b, c]: &Caster) -> (f64, f64) {
    let largest = a.abs().max(b.abs()).max(c.abs()).max(point.abs());
    (normal.dot(point - a), ROUNDED * normal.abs().dot(largest))
}

/// What is closer to the eye than this many times `nearest` of the camera may not be seen, as that is measured straight
/// ahead.
pub const UNSEEN: f64 = 16.0;

/// Whether an edge passes through the eye: closer than `unseen`, m, or than coordinates are rounded.
pub fn edge_touches(eye: DVec3, unseen: f64, [a, b]: [DVec3; 2]) -> bool {
    // The same whichever end comes first.
    let (a, b) = if a.to_array() <= b.to_array() { (a, b) } else { (b, a) };
    let along = b - a;
    let part = ((eye - a).dot(along) / along.length_squared()).clamp(0.0, 1.0);
    let apart = eye - (a + part * along);
    let largest = a.abs().max(b.abs()).max(eye.abs());
    apart.length_squared() <= ROUNDED * apart.abs().dot(largest) + unseen * apart.length()
}

/// The lit intervals of the first `way` metres of a ray, which may be infinite, in order, m.
pub fn lit_intervals(light: &Light, casters: &[Caster], ray: &Ray, way: f64) -> Vec<[f64; 2]> {
    let source = Source::of(light);
    let mut dark: Vec<[f64; 2]> =
        casters.iter().filter_map(|triangle| shadow(source, triangle, ray)).filter(|[from, _]| *from < way).collect();
    dark.sort_by(|a, b| a[0].total_cmp(&b[0]));
    let mut lit = Vec::new();
    let mut from = 0.0;
    for [start, end] in dark {
        if start > from {
            lit.push([from, start]);
        }
        from = from.max(end);
    }
    if from < way {
        lit.push([from, way]);
    }
    lit
}

/// Whether the light reaches the point at the end of the ray's first `way` metres, seen from the eye's side.
pub fn is_lit(light: &Light, casters: &[Caster], ray: &Ray, way: f64) -> bool {
    lit_intervals(light, casters, ray, way).last().is_some_and(|[_, end]| *end >= way * (1.0 - 1e-5))
}

/// Area over the square of the longest edge below which a triangle has no shadow: a side of it is as short as numbers round,
/// and the plane through it and the light may lie any way. At the poles of spheres there are such.
const NEEDLE: f64 = 1e-12;

/// The part of a ray in the shadow of a triangle. One that the light sees edge on has none, and neither has a needle.
fn shadow(source: Source, triangle: &Caster, ray: &Ray) -> Option<[f64; 2]> {
    let [a, b, c] = *triangle;
    let normal = (b - a).cross(c - a);
    let facing = facing(source, triangle);
    let longest = [b - a, c - b, a - c].map(DVec3::length_squared).into_iter().fold(0.0, f64::max);
    if facing == 0 || normal.length() < NEEDLE * longest {
        return None;
    }
    let side = |from: DVec3, to: DVec3, third: DVec3| {
        let plane = match source {
            Source::At(light) => (from - light).cross(to - light),
            Source::Along(direction) => (to - from).cross(direction),
        };
        (plane * plane.dot(third - from).signum(), from)
    };
    let planes = [side(a, b, c), side(b, c, a), side(c, a, b), (normal * -f64::from(facing), a)];
    let (mut start, mut end) = (0.0_f64, f64::INFINITY);
    for (inward, point) in planes {
        let (height, rise) = (inward.dot(ray.origin - point), inward.dot(ray.direction));
        if rise == 0.0 {
            if height < 0.0 {
                return None;
            }
        } else if rise > 0.0 {
            start = start.max(-height / rise);
        } else {
            end = end.min(-height / rise);
        }
    }
    (start < end).then_some([start, end])
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::DQuat;

    fn point(position: DVec3) -> Light {
        Light::Point { position, intensity: DVec3::ONE, radius: 0.0 }
    }

    fn square(half: f64, y: f64) -> [Caster; 2] {
        let corner = |x: f64, z: f64| DVec3::new(x * half, y, z * half);
        let corners = [corner(-1.0, -1.0), corner(1.0, -1.0), corner(1.0, 1.0), corner(-1.0, 1.0)];
        [[corners[0], corners[1], corners[2]], [corners[0], corners[2], corners[3]]]
    }

    /// A square of half-width 1 at half the height of a lamp shadows a square of half-width 2 on the ground.
    #[test]
    fn shadow_of_a_square() {
        let ray = Ray { origin: DVec3::new(-5.0, 0.0, 0.3), direction: DVec3::X };
        let of = |light: &Light, way: f64| lit_intervals(light, &square(1.0, 2.0), &ray, way);
        let lamp = point(DVec3::new(0.0, 4.0, 0.0));
        let close = |found: &[[f64; 2]], expected: &[[f64; 2]]| {
            let difference = |(a, b): (&[f64; 2], &[f64; 2])| (a[0] - b[0]).abs().max((a[1] - b[1]).abs());
            found.len() == expected.len() && found.iter().zip(expected).all(|pair| difference(pair) < 1e-12)
        };
        assert!(close(&of(&lamp, 9.0), &[[0.0, 3.0], [7.0, 9.0]]));
        assert_eq!(of(&lamp, f64::INFINITY)[1][1], f64::INFINITY);
        let sun = Light::Directional { direction: DVec3::NEG_Y, irradiance: DVec3::ONE };
        assert!(close(&of(&sun, 5.5), &[[0.0, 4.0]]));
        // Above the square nothing is dark.
        assert_eq!(of(&point(DVec3::new(0.0, 1.0, 0.0)), 9.0), [[0.0, 9.0]]);
        assert!(is_lit(&lamp, &square(1.0, 2.0), &ray, 2.9) && !is_lit(&lamp, &square(1.0, 2.0), &ray, 3.1));
    }

    /// A lamp at a rounding error from the plane of a triangle is in it, and one a millimetre from a plane of kilometres not.
    #[test]
    fn a_lamp_on_a_triangle_sees_it_edge_on() {
        let single = |v: DVec3| v.as_vec3().as_dvec3();
        for step in 0..1000 {
            let turn = DQuat::from_euler(glam::EulerRot::XYZ, f64::from(step), 0.3 * f64::from(step), 0.7);
            let shift = DVec3::new(30.0, -20.0, f64::from(step));
            let [a, b, c] = [DVec3::X, DVec3::NEG_X, DVec3::new(0.2, 0.0, 1.3)];
            let triangle = [a, b, c].map(|corner| single(shift + turn * corner));
            let lamp = |height: f64| Source::At(single(shift + turn * ((a + b + c) / 3.0 + height * DVec3::Y)));
            let heights = [0.0, 1e-7, 1e-2, -1e-2].map(|height| facing(lamp(height), &triangle));
            assert_eq!(heights, [0, 0, 1, -1], "step {step}");
        }
        let floor = [DVec3::new(-4e3, 0.0, -4e3), DVec3::new(0.0, 0.0, 4e3), DVec3::new(4e3, 0.0, -4e3)];
        let at = |y: f64| facing(Source::At(DVec3::new(10.0, y, -300.0)), &floor);
        assert_eq!([at(1e-3), at(-1e-3), at(0.0)], [1, -1, 0]);
        let sun = |slope: f64| facing(Source::Along(DVec3::new(1.0, -slope, 0.0).normalize()), &floor);
        assert_eq!([sun(1e-5), sun(-1e-5), sun(1e-8)], [1, -1, 0]);
        assert_eq!(facing(Source::At(DVec3::Y), &[DVec3::NAN, DVec3::X, DVec3::Z]), 0);
        assert_eq!(facing(Source::At(DVec3::Y), &[DVec3::X, DVec3::X, DVec3::Z]), 0);
    }

    /// Two corners that only rounding tells apart.
    #[test]
    fn a_needle_shadows_nothing() {
        let lamp = point(DVec3::new(0.0, 4.0, 0.0));
        for step in 0..1000 {
            let turned = f64::from(step) * 0.37;
            let corner = DVec3::new(turned.cos(), 2.0 + 0.3 * turned.sin(), 0.8 * turned.sin());
            let beside = corner + 2e-16 * DVec3::new((3.0 * turned).sin(), (5.0 * turned).cos(), (7.0 * turned).sin());
            let needle = [corner, beside, DVec3::new(0.2, 1.5, -0.7)];
            let ray = Ray {
                origin: DVec3::new(-5.0, 0.0, 0.3),
                direction: DVec3::new(1.0, 0.1 * turned.sin(), 0.0).normalize(),
            };
            let lit: f64 = lit_intervals(&lamp, &[needle], &ray, 20.0).iter().map(|[from, to]| to - from).sum();
            assert!(lit > 20.0 - 1e-9, "{needle:?} leaves {lit} m of 20 lit");
        }
    }
}
