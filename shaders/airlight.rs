//! Airlight by adaptive quadrature: twin of `airlight.wgsl`, and independent of its nodes.
//!
//! In u = ln v = arsinh(s/h) (see the glossary of `airlight_pieces.wgsl`) a point light's airlight is
//! `σ_s·I/h·∫ p(w)·e^(−σ_t·(t + h·eᵘ))/cosh u du` with w = 1/(1 + e^(−2u)): no peak is narrow, nothing cancels.

use crate::cone::{ray_in_cone, spot_falloff};
use crate::medium::opacity;
use crate::phase::{kinks, phase};
use crate::quadrature::integrate_pieces;
use crate::ray::Ray;
use crate::scene::{Light, Medium};
use glam::DVec3;

/// Relative error that is asked of the adaptive rule.
const TOLERANCE: f64 = 1e-11;

/// Light of one light scattered once toward the eye between `near` and `far` metres along the ray, W/(sr m²) per channel.
/// `far` may be infinite. The light's distance from the ray is floored at its radius, and at 1e-6 of its distance.
pub fn airlight(light: &Light, medium: &Medium, ray: &Ray, near: f64, far: f64) -> DVec3 {
    match *light {
        Light::Directional { direction, irradiance } => {
            let w = (direction + ray.direction).length_squared() / 4.0;
            let opacity = opacity(medium, far) - opacity(medium, near);
            medium.albedo * irradiance * phase(&medium.phase, w) * opacity
        }
        Light::Point { position, intensity, radius } => {
            let beside = Beside::new(ray, position, radius);
            intensity * beside.airlight(medium, &|_| 1.0, near, far, &[[-ENDLESS, ENDLESS]])
        }
        Light::Spot { position, intensity, radius, direction, exponent, cutoff } => {
            let beside = Beside::new(ray, position, radius);
            let along = direction.dot(ray.direction);
            let across = direction.dot(beside.across);
            // no need to cut at the edge here: the intervals do it
            let falloff = |u: f64| spot_falloff((along * u.sinh() + across) / u.cosh(), exponent, 180.0);
            let parts: Vec<[f64; 2]> =
                ray_in_cone(along, across, if exponent > 0.0 { cutoff.min(90.0) } else { cutoff })
                    .into_iter()
                    .map(|part| part.map(|theta: f64| theta.sin().atanh().clamp(-ENDLESS, ENDLESS)))
                    .collect();
            intensity * beside.airlight(medium, &falloff, near, far, &parts)
        }
    }
}

/// Bound of |u|: v stays within the range of doubles.
const ENDLESS: f64 = 300.0;

/// Where a light stands beside a ray.
struct Beside {
    /// Of the ray's nearest point to the light, m.
    t: f64,
    /// Distance of the light from the ray, m, floored.
    h: f64,
    /// Unit vector from the light to that point; zero where the ray goes through the light.
    across: DVec3,
}

/// e^(−σ_t·way), at the cost of one channel where all are alike.
fn attenuation(extinction: DVec3, way: f64) -> DVec3 {
    let red = (-extinction.x * way).exp();
    if extinction == DVec3::splat(extinction.x) {
        return DVec3::splat(red);
    }
    DVec3::new(red, (-extinction.y * way).exp(), (-extinction.z * way).exp())
}

impl Beside {
    fn new(ray: &Ray, position: DVec3, radius: f64) -> Self {
        let to_light = position - ray.origin;
        let t = to_light.dot(ray.direction);
        let away = to_light.cross(ray.direction);
        // (a x b) x b turns the distance into its direction, without a difference that cancels
        let across = away.cross(ray.direction).normalize_or_zero();
        let h = away.length().max(radius).max(1e-6 * to_light.length()).max(1e-12);
        Beside { t, h, across }
    }

    /// u of the point at `x` metres along the ray.
    fn u(&self, x: f64) -> f64 {
        ((x - self.t) / self.h).asinh().clamp(-ENDLESS, ENDLESS)
    }

    fn airlight(
        &self,
        medium: &Medium,
        falloff: &dyn Fn(f64) -> f64,
        near: f64,
        far: f64,
        parts: &[[f64; 2]],
    ) -> DVec3 {
        let light = |u: f64| {
            // w = 1/(1 + e^(-2u)), 1/cosh u = 2/(e^u + e^(-u))
            let v = u.exp();
            let scattered = phase(&medium.phase, v * v / (1.0 + v * v)) * falloff(u) * 2.0 / (v + 1.0 / v);
            scattered * attenuation(medium.extinction, self.t + self.h * v)
        };
        let kinks = kinks(&medium.phase);
        let part = |part: &[f64; 2]| {
            let (start, end) = (self.u(near).max(part[0]), self.u(far).min(part[1]));
            // where the exponent has grown by 60 nothing is left
            let last = (start.exp() + 60.0 / (medium.least_extinction() * self.h)).ln();
            let end = end.min(last);
            if end > start { integrate_pieces(light, start, end, &kinks, TOLERANCE) } else { DVec3::ZERO }
        };
        medium.scattering() / self.h * parts.iter().map(part).sum::<DVec3>()
    }
}
