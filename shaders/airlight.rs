//! Airlight by adaptive quadrature: twin of `airlight.wgsl`, and independent of its nodes.
//!
//! In u = ln v = arsinh(s/h) (see the glossary of `airlight.wgsl`) a point light's airlight is
//! `σ_s·I/h·∫ p(w)·e^(−σ_t·(t + h·eᵘ))/cosh u du` with w = 1/(1 + e^(−2u)): no peak is narrow, nothing cancels.

use crate::cone::{ray_in_cone, spot_falloff};
use crate::medium::opacity;
use crate::phase::phase;
use crate::quadrature::integrate;
use crate::ray::Ray;
use crate::scene::{Light, Medium, Phase};
use glam::DVec3;

/// Relative error that is asked of the adaptive rule.
const TOLERANCE: f64 = 1e-11;
/// The same where the phase function is a table, which is not smooth at its rows.
const TABLE_TOLERANCE: f64 = 1e-7;

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
        let channel = |i: usize| {
            let extinction = medium.extinction[i];
            let light = |u: f64| {
                let w = 1.0 / (1.0 + (-2.0 * u).exp());
                let path = self.t + self.h * u.exp();
                phase(&medium.phase, w) * falloff(u) * (-extinction * path).exp() / u.cosh()
            };
            let tolerance = if matches!(medium.phase, Phase::Measured(_)) { TABLE_TOLERANCE } else { TOLERANCE };
            let part = |part: &[f64; 2]| {
                let (start, end) = (self.u(near).max(part[0]), self.u(far).min(part[1]));
                // where the exponent has grown by 60 nothing is left
                let last = (start.exp() + 60.0 / (extinction * self.h)).ln();
                let end = end.min(last);
                if end > start { integrate(light, start, end, tolerance) } else { 0.0 }
            };
            if extinction == 0.0 { 0.0 } else { parts.iter().map(part).sum::<f64>() * extinction / self.h }
        };
        medium.albedo * DVec3::new(channel(0), channel(1), channel(2))
    }
}
