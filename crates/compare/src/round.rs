//! Spheres and tori as casters: where a ray meets them, and which parts of a ray they hide from a light.
//!
//! Each is a function of space, negative inside. Along a straight line it is a polynomial, of degree 2 or 4, whose turning
//! points are found in closed form or between those of its derivative: so it is known for certain whether a segment is
//! blocked. A hidden part begins and ends where a line to the light just touches the caster, which is found by bisection
//! along the ray, in the angle at the light (a point light sees all of an endless ray within half a turn).

use std::f64::consts::FRAC_PI_2;

use glam::{DAffine3, DVec3};
use tyndall_scene::Primitive;
use tyndall_shaders::ray::Ray;
use tyndall_shaders::scene::Light;

/// Places at which a ray is sampled before bisection; between two of them the turning point is found.
const SAMPLES: usize = 64;
/// Bisections after which a place is exact to the last digit.
const BISECTIONS: usize = 60;
/// An angle at the light just below the end of an endless ray.
const END: f64 = FRAC_PI_2 - 1e-9;

/// A sphere or a torus, in its place.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Round {
    from_world: DAffine3,
    /// Metres of the world in one metre of its own space.
    scale: f64,
    shape: Shape,
}

#[derive(Debug, Clone, Copy)]
enum Shape {
    Sphere { radius: f64 },
    Torus { major: f64, minor: f64 },
}

/// A straight segment: its start, its unit direction, and its length, which may be infinite.
#[derive(Debug, Clone, Copy)]
struct Segment {
    origin: DVec3,
    direction: DVec3,
    length: f64,
}

impl Round {
    /// A round primitive; `None` of others, and where `world_from_own` scales axes differently, which leaves it round
    /// no longer.
    pub fn new(primitive: Primitive, world_from_own: DAffine3) -> Option<Self> {
        let shape = match primitive {
            Primitive::Sphere { radius } => Shape::Sphere { radius },
            Primitive::Torus { major, minor } => Shape::Torus { major, minor },
            Primitive::Box { .. } | Primitive::Plane { .. } => return None,
        };
        let axes = world_from_own.matrix3;
        let lengths = DVec3::new(axes.x_axis.length(), axes.y_axis.length(), axes.z_axis.length());
        let scale = lengths.x;
        let uniform = (lengths - DVec3::splat(scale)).abs().max_element() <= 1e-9 * scale;
        uniform.then_some(Self { from_world: world_from_own.inverse(), scale, shape })
    }

    /// Where a ray from outside first meets it within `length`, m.
    pub fn entry(&self, ray: &Ray, length: f64) -> Option<f64> {
        let ray = self.own(ray);
        let segment = Segment { origin: ray.origin, direction: ray.direction, length: length / self.scale };
        let value = |at: f64| self.shape.value(segment.origin + at * segment.direction);
        let turns = self.shape.turns(&segment);
        let first = turns.windows(2).find(|part| value(part[0]) > 0.0 && value(part[1]) <= 0.0)?;
        Some(self.scale * change(first[0], first[1], &|at| value(at) <= 0.0))
    }

    /// The parts of the first `length` metres of a ray that it hides from a light, in order, m.
    pub fn hidden(&self, light: &Light, ray: &Ray, length: f64) -> Vec<[f64; 2]> {
        let (ray, length) = (self.own(ray), length / self.scale);
        let found = match *light {
            Light::Point { position, .. } | Light::Spot { position, .. } => {
                self.hidden_from(self.from_world.transform_point3(position), &ray, length)
            }
            Light::Directional { direction, .. } => {
                self.hidden_along(self.from_world.transform_vector3(direction).normalize(), &ray, length)
            }
        };
        found.into_iter().map(|part| part.map(|at| self.scale * at)).collect()
    }

    fn own(&self, ray: &Ray) -> Ray {
        let direction = self.from_world.transform_vector3(ray.direction).normalize();
        Ray { origin: self.from_world.transform_point3(ray.origin), direction }
    }

    fn hidden_from(&self, light: DVec3, ray: &Ray, length: f64) -> Vec<[f64; 2]> {
        let to_light = light - ray.origin;
        let t = to_light.dot(ray.direction);
        let away = to_light.cross(ray.direction);
        let across = away.cross(ray.direction).normalize_or(ray.direction.any_orthonormal_vector());
        let h = away.length().max(1e-9);
        let place = |angle: f64| t + h * angle.tan();
        let angle = |x: f64| ((x - t) / h).atan().clamp(-END, END);
        // Its bounding ball, as the light sees it in the plane of light and ray.
        let ball = self.shape.ball();
        let (along, beside) = (-light.dot(ray.direction), -light.dot(across));
        let distance = along.hypot(beside);
        let radius2 = ball * ball - (light.length_squared() - distance * distance).max(0.0);
        if radius2 <= 0.0 {
            return Vec::new();
        }
        let (middle, half) = if distance * distance <= radius2 {
            (0.0, FRAC_PI_2)
        } else {
            (along.atan2(beside), (radius2.sqrt() / distance).asin())
        };
        let (from, to) = (angle(0.0).max(middle - half), angle(length).min(middle + half));
        let least = |angle: f64| {
            let direction = across * angle.cos() + ray.direction * angle.sin();
            self.shape.least(&Segment { origin: light, direction, length: h / angle.cos() })
        };
        let end =
            |angle: f64| if length.is_infinite() && angle >= END { length } else { place(angle).clamp(0.0, length) };
        negative(from, to, &least).into_iter().map(|part| part.map(end)).collect()
    }

    fn hidden_along(&self, direction: DVec3, ray: &Ray, length: f64) -> Vec<[f64; 2]> {
        // Where the ray is within the ball's beam: |from + x step| <= ball, both across the light.
        let across = |v: DVec3| v - v.dot(direction) * direction;
        let (from, step) = (across(ray.origin), across(ray.direction));
        let (a, b, c) = (step.length_squared(), from.dot(step), from.length_squared() - self.shape.ball().powi(2));
        let root = (b * b - a * c).max(0.0).sqrt();
        if b * b <= a * c || a < 1e-20 {
            return Vec::new();
        }
        let least = |x: f64| {
            let origin = ray.origin + x * ray.direction;
            self.shape.least(&Segment { origin, direction: -direction, length: f64::INFINITY })
        };
        negative(((-b - root) / a).max(0.0), ((-b + root) / a).min(length), &least)
    }
}

impl Shape {
    /// Radius of a ball about the origin that is slightly larger than the shape.
    fn ball(&self) -> f64 {
        match *self {
            Self::Sphere { radius } => 1.001 * radius,
            Self::Torus { major, minor } => 1.001 * (major + minor),
        }
    }

    /// Negative inside, in units of length² or length⁴.
    fn value(&self, p: DVec3) -> f64 {
        match *self {
            Self::Sphere { radius } => p.length_squared() - radius * radius,
            Self::Torus { major, minor } => {
                let u = p.length_squared() + major * major - minor * minor;
                u * u - 4.0 * major * major * (p.x * p.x + p.z * p.z)
            }
        }
    }

    /// The least value on a segment; positive if the segment misses the shape.
    fn least(&self, segment: &Segment) -> f64 {
        let value = |at: &f64| self.value(segment.origin + *at * segment.direction);
        self.turns(segment).iter().map(value).fold(f64::INFINITY, f64::min)
    }

    /// The ends of the part of a segment that is in the ball, and the turning points of the value between them, in order;
    /// empty if the segment misses the ball.
    fn turns(&self, segment: &Segment) -> Vec<f64> {
        let Segment { origin, direction, length } = *segment;
        let (middle, closest) = (-origin.dot(direction), origin.cross(direction).length_squared());
        let half = self.ball().powi(2) - closest;
        if half <= 0.0 {
            return Vec::new();
        }
        let (start, end) = ((middle - half.sqrt()).max(0.0), (middle + half.sqrt()).min(length));
        if start >= end {
            return Vec::new();
        }
        let mut turns = vec![start];
        match *self {
            Self::Sphere { .. } => turns.extend(Some(middle).filter(|at| *at > start && *at < end)),
            Self::Torus { major, minor } => {
                // From the point nearest to the middle, where numbers are small: |p|² = k' + s², x² + z² = e + 2fs + gs²
                let p = origin + middle * direction;
                let (k, g) = (p.length_squared() + major * major - minor * minor, 1.0 - direction.y * direction.y);
                let f = p.x * direction.x + p.z * direction.z;
                // A quarter of the derivative of (k + s²)² − 4 major² (e + 2fs + gs²)
                let cubic = [-2.0 * major * major * f, k - 2.0 * major * major * g, 0.0, 1.0];
                turns.extend(roots(cubic, start - middle, end - middle).into_iter().map(|s| s + middle));
            }
        }
        turns.push(end);
        turns
    }
}

/// The roots of c[0] + c[1] s + c[2] s² + c[3] s³ between two places, in order: between its turning points.
fn roots(c: [f64; 4], low: f64, high: f64) -> Vec<f64> {
    let value = |s: f64| c[0] + s * (c[1] + s * (c[2] + s * c[3]));
    let discriminant = c[2] * c[2] - 3.0 * c[1] * c[3];
    let mut places = vec![low];
    if discriminant > 0.0 {
        let turns = [-1.0, 1.0].map(|sign| (-c[2] + sign * discriminant.sqrt()) / (3.0 * c[3]));
        places.extend(turns.into_iter().filter(|s| *s > low && *s < high));
    }
    places.push(high);
    let part = |ends: &[f64]| {
        let starts_above = value(ends[0]) > 0.0;
        (starts_above != (value(ends[1]) > 0.0))
            .then(|| change(ends[0], ends[1], &|s| (value(s) > 0.0) != starts_above))
    };
    places.windows(2).filter_map(part).collect()
}

/// Where a condition begins to hold that holds at `high` but not at `low`.
fn change(mut low: f64, mut high: f64, holds: &dyn Fn(f64) -> bool) -> f64 {
    for _ in 0..BISECTIONS {
        let middle = 0.5 * (low + high);
        if holds(middle) { high = middle } else { low = middle }
    }
    high
}

/// The parts of low..high where a function is negative, in order.
fn negative(low: f64, high: f64, of: &dyn Fn(f64) -> f64) -> Vec<[f64; 2]> {
    if low >= high {
        return Vec::new();
    }
    let mut places: Vec<(f64, f64)> = (0..=SAMPLES)
        .map(|sample| low + (high - low) * sample as f64 / SAMPLES as f64)
        .map(|place| (place, of(place)))
        .collect();
    // A value that turns toward zero between samples may cross it there.
    let turning: Vec<(f64, f64)> = places
        .windows(3)
        .filter(|near| near.iter().all(|(_, value)| (*value < 0.0) == (near[1].1 < 0.0)))
        .filter(|near| near[1].1.abs() <= near[0].1.abs() && near[1].1.abs() <= near[2].1.abs())
        .map(|near| nearest_to_zero(near[0].0, near[2].0, of))
        .collect();
    places.extend(turning);
    places.sort_by(|a, b| a.0.total_cmp(&b.0));
    let mut parts = Vec::new();
    let mut start = (places[0].1 < 0.0).then_some(low);
    for pair in places.windows(2) {
        let [(from, before), (to, after)] = [pair[0], pair[1]];
        if (before < 0.0) == (after < 0.0) {
            continue;
        }
        let place = change(from, to, &|place| (of(place) < 0.0) == (after < 0.0));
        match start.take() {
            Some(start) => parts.push([start, place]),
            None => start = Some(place),
        }
    }
    parts.extend(start.map(|start| [start, high]));
    parts
}

/// Where a function that turns once is nearest to zero, or beyond it, by ternary search.
fn nearest_to_zero(mut low: f64, mut high: f64, of: &dyn Fn(f64) -> f64) -> (f64, f64) {
    let sign = of(0.5 * (low + high)).signum();
    for _ in 0..BISECTIONS {
        let [left, right] = [1.0, 2.0].map(|third| low + (high - low) * third / 3.0);
        if sign * of(left) < sign * of(right) { high = right } else { low = left }
    }
    let place = 0.5 * (low + high);
    (place, of(place))
}

#[cfg(test)]
mod tests {
    use glam::DQuat;
    use tyndall_shaders::shadows::lit_intervals;

    use super::*;

    fn lamp(position: DVec3) -> Light {
        Light::Point { position, intensity: DVec3::ONE, radius: 0.0 }
    }

    /// A few rays that pass by and behind something about the origin.
    fn rays() -> Vec<Ray> {
        let ray = |i: u32| {
            let angle = f64::from(i) * 0.61;
            let origin = DVec3::new(5.0 * angle.cos(), 1.1 * (0.7 * angle).sin(), 5.0 * angle.sin());
            let target = DVec3::new(2.5 * (1.3 * angle).sin(), 2.0 * (2.1 * angle).cos(), 2.5 * (1.9 * angle).cos());
            Ray { origin, direction: (target - origin).normalize() }
        };
        (0..60).map(ray).collect()
    }

    fn length(parts: &[[f64; 2]]) -> f64 {
        parts.iter().map(|[from, to]| to.min(50.0) - from.min(50.0)).sum()
    }

    /// A ray beside a ball, lit from the other side: the shadow is a cone of half-angle asin(r/d).
    #[test]
    fn the_shadow_of_a_sphere_is_a_cone() {
        let ball = Round::new(Primitive::Sphere { radius: 0.5 }, DAffine3::from_scale(DVec3::splat(2.0))).unwrap();
        let ray = Ray { origin: DVec3::new(-9.0, 0.0, -4.0), direction: DVec3::X };
        let found = ball.hidden(&lamp(DVec3::new(0.0, 0.0, 3.0)), &ray, f64::INFINITY);
        let reach = 7.0 * (1.0_f64 / 3.0).asin().tan();
        let [[from, to]] = found[..] else { panic!("{found:?}") };
        assert!((from - 9.0 + reach).abs() < 1e-9 && (to - 9.0 - reach).abs() < 1e-9, "{from} {to} {reach}");
        // Sunlight: as wide as the ball. In front of it nothing is dark, and a lamp within lights nothing outside.
        let sun = Light::Directional { direction: DVec3::NEG_Z, irradiance: DVec3::ONE };
        let found = ball.hidden(&sun, &ray, f64::INFINITY);
        assert!((found[0][0] - 8.0).abs() < 1e-9 && (found[0][1] - 10.0).abs() < 1e-9, "{found:?}");
        let before = Ray { origin: DVec3::new(-9.0, 0.0, 1.5), direction: DVec3::X };
        assert!(ball.hidden(&lamp(DVec3::new(0.0, 0.0, 3.0)), &before, 20.0).is_empty());
        assert!(ball.hidden(&sun, &before, 20.0).is_empty());
        let [[from, to]] = ball.hidden(&lamp(DVec3::splat(0.1)), &ray, f64::INFINITY)[..] else { panic!("not dark") };
        assert!(from < 1e-12 && to == f64::INFINITY, "{from} {to}");
        assert!((ball.entry(&Ray { origin: DVec3::new(-9.0, 0.0, 0.0), ..ray }, 20.0).unwrap() - 8.0).abs() < 1e-12);
        assert_eq!(ball.entry(&ray, f64::INFINITY), None);
    }

    /// An ellipsoid is left to its triangles; a mirrored ball is a ball.
    #[test]
    fn what_is_scaled_along_axes_is_not_round() {
        let ball = |scale: DVec3| Round::new(Primitive::Sphere { radius: 1.0 }, DAffine3::from_scale(scale));
        assert!(ball(DVec3::new(1.0, 2.0, 1.0)).is_none());
        let ray = Ray { origin: DVec3::new(-9.0, 0.0, 0.0), direction: DVec3::X };
        let entry = ball(DVec3::new(-2.0, 2.0, 2.0)).unwrap().entry(&ray, 20.0).unwrap();
        assert!((entry - 7.0).abs() < 1e-12, "{entry}");
    }

    /// The mesh that stands for a torus is within 6e-4 of its tube, and so are the shadows of both.
    #[test]
    fn the_shadow_of_a_torus_is_that_of_its_mesh() {
        let primitive = Primitive::Torus { major: 1.0, minor: 0.35 };
        let turned = DQuat::from_rotation_x(0.7) * DQuat::from_rotation_z(0.4);
        let world = DAffine3::from_scale_rotation_translation(DVec3::splat(1.2), turned, DVec3::new(0.1, 0.2, -0.1));
        let torus = Round::new(primitive, world).unwrap();
        let mesh = primitive.mesh();
        let corner = |index: u32| world.transform_point3(mesh.positions[index as usize].as_dvec3());
        let triangles: Vec<[DVec3; 3]> = mesh.triangles.iter().map(|triangle| triangle.map(corner)).collect();
        let sun = Light::Directional { direction: DVec3::new(0.3, -0.8, 0.4).normalize(), irradiance: DVec3::ONE };
        // The second lamp is in the hole.
        let lights = [lamp(DVec3::new(1.0, 3.0, 0.5)), lamp(DVec3::new(0.1, 0.2, -0.1)), sun];
        let (mut compared, mut split) = (0, 0);
        for (light, ray) in lights.iter().flat_map(|light| rays().into_iter().map(move |ray| (light, ray))) {
            let distance = torus.entry(&ray, f64::INFINITY).unwrap_or(f64::INFINITY);
            let found = torus.hidden(light, &ray, distance);
            let lit = lit_intervals(light, &triangles, &ray, distance);
            let dark = distance.min(50.0) - length(&lit);
            assert!((length(&found) - dark).abs() < 0.03 + 0.01 * dark, "{light:?} {ray:?} {found:?} {lit:?}");
            compared += usize::from(dark > 0.1);
            split += usize::from(found.len() > 1);
        }
        assert!(compared > 50 && split > 3, "{compared} {split}");
    }
}
