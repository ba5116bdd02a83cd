//! Airlight in height fog by adaptive quadrature: twin of `height_fog.wgsl`, and independent of its nodes and pieces.

use crate::cone::spot_falloff;
use crate::medium::{density, effective_way, opacity};
use crate::phase::{kinks, phase};
use crate::quadrature::{integrate, integrate_pieces};
use crate::ray::Ray;
use crate::scene::{HeightFog, Light, Medium};
use glam::DVec3;

/// Relative error that is asked of the adaptive rule.
const TOLERANCE: f64 = 1e-8;

/// Light of one light scattered once toward the eye up to `way` metres along the ray, W/(sr m²) per channel; the density
/// of the medium is that of the fog. The distance of a light from the ray is not floored: rays keep away from lights.
/// `attenuated_sun`: the medium takes of directional lights on their way down.
pub fn airlight(light: &Light, medium: &Medium, fog: &HeightFog, ray: &Ray, way: f64, attenuated_sun: bool) -> DVec3 {
    let (height, climb) = (ray.origin.y, ray.direction.y);
    match *light {
        Light::Directional { direction, irradiance } => {
            let w = (direction + ray.direction).length_squared() / 4.0;
            let whole = medium.albedo * irradiance * phase(&medium.phase, w);
            if attenuated_sun {
                whole * sunlit(medium, fog, ray, way, -direction.y)
            } else {
                whole * opacity(medium, effective_way(fog, height, climb, way))
            }
        }
        Light::Point { position, intensity, .. } | Light::Spot { position, intensity, .. } => {
            let t = (position - ray.origin).dot(ray.direction);
            let h = ray.at(t).distance(position);
            let falloff = |point: DVec3| match *light {
                Light::Spot { direction, exponent, cutoff, .. } => {
                    spot_falloff(direction.dot((point - position).normalize()), exponent, cutoff)
                }
                _ => 1.0,
            };
            // x = t + h sinh u, r = h cosh u, w = 1/(1 + e^(-2u)): no peak at the light, nothing cancels
            let at = |u: f64| {
                let (x, r, w) = (t + h * u.sinh(), h * u.cosh(), 1.0 / (1.0 + (-2.0 * u).exp()));
                let point = ray.at(x);
                let to_light = effective_way(fog, point.y, (position.y - point.y) / r, r);
                let ways = effective_way(fog, height, climb, x) + to_light;
                // in one exponent: deep in the fog the density is beyond all bounds
                let exponent = DVec3::splat((fog.base_height - point.y) * fog.falloff) - medium.extinction * ways;
                exponent.exp() * (falloff(point) * phase(&medium.phase, w) / r)
            };
            let u = |x: f64| ((x - t) / h).asinh();
            let end = way.min(far(fog, ray, medium.least_extinction()));
            medium.scattering() * intensity * integrate_pieces(at, u(0.0), u(end), &kinks(&medium.phase), TOLERANCE)
        }
    }
}

/// Metres along the ray beyond which nothing that f64 holds is left.
fn far(fog: &HeightFog, ray: &Ray, extinction: f64) -> f64 {
    let rate = fog.falloff * ray.direction.y;
    let dark = 400.0 / (extinction * density(fog, ray.origin.y)).max(1e-300);
    if rate > 0.0 { 60.0 / rate } else { dark.min(1e9) }
}

/// Part of a light's irradiance, from an elevation of this sine, that the medium would scatter to the eye if it had an
/// albedo and a phase function of 1: the integral over the ray, point by point.
fn sunlit(medium: &Medium, fog: &HeightFog, ray: &Ray, way: f64, sine: f64) -> DVec3 {
    if sine <= 0.0 {
        return DVec3::ZERO;
    }
    // x = e^s - 1: the fog may be near and the end far away
    let at = |s: f64| {
        let x = s.exp_m1();
        let depth = (fog.base_height - ray.at(x).y) * fog.falloff;
        let ways = effective_way(fog, ray.origin.y, ray.direction.y, x) + depth.exp() / (fog.falloff * sine);
        medium.extinction * (DVec3::splat(depth + s) - medium.extinction * ways).exp()
    };
    integrate(at, 0.0, way.min(far(fog, ray, medium.least_extinction())).ln_1p(), TOLERANCE)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::airlight;
    use crate::scene::Phase;

    const MEDIUM: Medium = Medium {
        extinction: DVec3::new(0.02, 0.05, 0.1),
        albedo: DVec3::new(1.0, 0.9, 0.8),
        phase: Phase::HenyeyGreenstein { g: 0.6 },
    };

    fn lights() -> [Light; 3] {
        let (position, intensity) = (DVec3::new(3.0, 6.0, -9.0), DVec3::new(3.0, 2.0, 1.0));
        let direction = DVec3::new(-0.2, -1.0, 0.1).normalize();
        [
            Light::Point { position, intensity, radius: 0.0 },
            Light::Spot { position, intensity, radius: 0.0, direction, exponent: 2.0, cutoff: 90.0 },
            Light::Directional { direction, irradiance: DVec3::ONE },
        ]
    }

    fn close(a: DVec3, b: DVec3, tolerance: f64) -> bool {
        (a - b).abs().cmple(tolerance * b.abs()).all()
    }

    /// A scale height beyond all bounds is a homogeneous medium.
    #[test]
    fn without_falloff_it_is_homogeneous_airlight() {
        let ray = Ray { origin: DVec3::new(0.0, 2.0, 0.0), direction: DVec3::new(0.1, 0.2, -1.0).normalize() };
        for light in lights() {
            for way in [7.0, 30.0, 4000.0] {
                let plain = airlight::airlight(&light, &MEDIUM, &ray, 0.0, way);
                for fog in [HeightFog::NONE, HeightFog { base_height: -5.0, falloff: 1e-9 }] {
                    let value = airlight(&light, &MEDIUM, &fog, &ray, way, false);
                    assert!(close(value, plain, 1e-5), "{light:?}, {way} m: {value} instead of {plain}");
                }
            }
        }
    }

    /// Moving the base by a height is a factor of the density.
    #[test]
    fn the_base_height_is_a_factor_of_the_density() {
        let ray = Ray { origin: DVec3::new(0.0, 2.0, 0.0), direction: DVec3::new(0.1, -0.1, -1.0).normalize() };
        let low = HeightFog { base_height: 0.0, falloff: 0.25 };
        let high = HeightFog { base_height: 4.0, falloff: 0.25 };
        let denser = Medium { extinction: MEDIUM.extinction * 1f64.exp(), ..MEDIUM };
        for light in lights() {
            let value = airlight(&light, &MEDIUM, &high, &ray, 18.0, false);
            assert!(close(value, airlight(&light, &denser, &low, &ray, 18.0, false), 1e-9), "{light:?}");
        }
    }

    /// Light from straight above that crosses the whole medium has lost what the vertical optical depth takes.
    #[test]
    fn an_attenuated_sun_is_darker() {
        let ray = Ray { origin: DVec3::new(0.0, 2.0, 0.0), direction: DVec3::new(0.0, 0.3, -1.0).normalize() };
        let fog = HeightFog { base_height: 0.0, falloff: 0.1 };
        let [_, _, sun] = lights();
        let [whole, less] = [false, true].map(|on| airlight(&sun, &MEDIUM, &fog, &ray, 1e6, on));
        assert!(less.cmplt(whole).all() && less.cmpgt(DVec3::ZERO).all(), "{less} {whole}");
    }
}
