//! Light that a surface reflects toward the eye, straight from a light and scattered once by the medium before: twin of
//! `reflection.wgsl`, by brute force.
//!
//! Scattered light comes from every direction ω, as much as the airlight that an eye at the surface would see there, with
//! nothing in its way. What a surface makes of it are convolutions with max(0, cos)ⁿ: about the normal with n = 1
//! (Lambert), and about the mirrored view ray with the shininess (Phong; not clipped by the surface).

use crate::airlight::airlight;
use crate::lights::incident;
use crate::medium::transmittance;
use crate::phase::phase;
use crate::quadrature::{gauss_legendre, integrate};
use crate::ray::Ray;
use crate::scene::{Light, Medium, Phase};
use glam::DVec3;
use std::f64::consts::PI;

/// A point of a surface and how it reflects.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Surface {
    /// m.
    pub position: DVec3,
    /// Unit vector, turned to the eye.
    pub normal: DVec3,
    /// Unit vector: the view ray mirrored at the surface.
    pub mirrored: DVec3,
    /// Lambert reflectance ρ; the BRDF is ρ/π.
    pub diffuse: DVec3,
    /// k_s of the Phong lobe.
    pub specular: DVec3,
    /// n of the Phong lobe.
    pub shininess: f64,
}

/// Radiance that leaves the surface toward the eye, W/(sr m²): what the light sends straight and what the medium scatters
/// to it. Not attenuated on the way to the eye.
pub fn reflected(light: &Light, medium: &Medium, surface: &Surface) -> DVec3 {
    direct(light, medium, surface) + scattered(light, medium, surface)
}

/// The part that comes straight from the light: Hong 2006, eq. 4.12, with the BRDF ρ/π; 0 where the light is behind.
pub fn direct(light: &Light, medium: &Medium, surface: &Surface) -> DVec3 {
    let incident = incident(light, surface.position);
    let cosine = surface.normal.dot(incident.to_light);
    if cosine <= 0.0 {
        return DVec3::ZERO;
    }
    let lobe = surface.mirrored.dot(incident.to_light).max(0.0).powf(surface.shininess);
    let brdf = surface.diffuse / PI * cosine + surface.specular * lobe;
    brdf * incident.irradiance * transmittance(medium, incident.way)
}

/// The part that the medium scattered once: Hong 2006, eq. 4.15, with the albedo that it leaves out and the BRDF ρ/π,
/// `I·σ_s/d·(ρ/π·J¹ + k_s·Jⁿ)`. Of a directional light, which is not attenuated, `E·albedo·(ρ/π·S¹ + k_s·Sⁿ)`.
/// A spot is integrated direction by direction, to a relative error of about 1e-3.
pub fn scattered(light: &Light, medium: &Medium, surface: &Surface) -> DVec3 {
    match *light {
        Light::Spot { .. } => scattered_from_all_around(light, medium, surface),
        Light::Point { intensity, .. } => {
            let incident = incident(light, surface.position);
            let terms = surface.terms(incident.to_light, |n, angle| {
                per_channel(medium.extinction, |extinction| {
                    if extinction == 0.0 { 0.0 } else { convolution(&medium.phase, n, extinction * incident.way, angle) }
                })
            });
            intensity * medium.scattering() / incident.way * terms
        }
        Light::Directional { direction, irradiance } => {
            let terms = surface.terms(-direction, |n, angle| DVec3::splat(sun_convolution(&medium.phase, n, angle)));
            per_channel(medium.extinction, |extinction| f64::from(extinction > 0.0)) * medium.albedo * irradiance * terms
        }
    }
}

fn per_channel(value: DVec3, f: impl Fn(f64) -> f64) -> DVec3 {
    DVec3::new(f(value.x), f(value.y), f(value.z))
}

impl Surface {
    /// ρ/π·J¹ + k_s·Jⁿ, of a function of n and of the angle between the lobe and the light.
    fn terms(&self, to_light: DVec3, convolution: impl Fn(f64, f64) -> DVec3) -> DVec3 {
        let lobe = |factor: DVec3, n: f64, axis: DVec3| {
            if factor == DVec3::ZERO { DVec3::ZERO } else { factor * convolution(n, axis.angle_between(to_light)) }
        };
        lobe(self.diffuse / PI, 1.0, self.normal) + lobe(self.specular, self.shininess, self.mirrored)
    }
}

/// Jⁿ(T, θ) = ∫ F(T, γ)·max(0, cos)ⁿ dω (Hong 2006, eqs. 4.13 and 4.14): of the radiance around a point in a medium at the
/// optical depth T from a point light, `I·σ_s/d·F`, with a lobe whose axis is θ (radians) from the way to the light.
///
/// `F·sin γ` is [`glow`] and of no other angle, so the lobe is first summed around the way to the light.
pub fn convolution(kind: &Phase, n: f64, depth: f64, theta: f64) -> f64 {
    over_lobe(n, theta, |gamma| glow(kind, depth, gamma))
}

/// Sⁿ(θ) = ∫ p·max(0, cos)ⁿ dω: the same of a directional light of irradiance E, around which the radiance is albedo·p·E.
pub fn sun_convolution(kind: &Phase, n: f64, theta: f64) -> f64 {
    over_lobe(n, theta, |gamma| phase(kind, (gamma / 2.0).sin().powi(2)) * gamma.sin())
}

fn over_lobe(n: f64, theta: f64, around: impl Fn(f64) -> f64) -> f64 {
    let reach = reach(n);
    let integrand = |gamma: f64| around(gamma) * azimuthal_sum(n, theta, gamma);
    let part = |a: f64, b: f64| if b > a { integrate(integrand, a, b, 1e-8) } else { 0.0 };
    part((theta - reach).max(0.0), theta) + part(theta, (theta + reach).min(PI))
}

/// Where cosⁿ is below 1e-14, an angle from its axis; at most a right angle.
fn reach(n: f64) -> f64 {
    (-32.0 / n.max(1e-3)).exp().clamp(0.0, 1.0).acos()
}

/// sin γ·F(T, γ): of the airlight on an endless ray that makes the angle γ with the way to the light, with h = d·sin γ,
/// `∫ p·e^(−T·(cos γ + sin γ·v))·2/(1 + v²) dv` from v = tan(γ/2) on, see the glossary of `airlight.wgsl`.
pub fn glow(kind: &Phase, depth: f64, gamma: f64) -> f64 {
    let start = (gamma / 2.0).tan();
    let rate = depth * gamma.sin();
    // in ln(v - start), in which all scales are alike
    let integrand = |s: f64| {
        let x = s.exp();
        let v = start + x;
        let w = if v > 1e8 { 1.0 } else { v * v / (1.0 + v * v) };
        phase(kind, w) * (-rate * x).exp() * 2.0 * x / (1.0 + v * v)
    };
    let last = if rate > 0.0 { (60.0 / rate).ln().min(25.0) } else { 25.0 };
    (-depth).exp() * integrate(integrand, (last - 30.0).min(-25.0), last, 1e-10)
}

/// ∫ max(0, cos γ·cos θ + sin γ·sin θ·cos φ)ⁿ dφ around the way to the light.
fn azimuthal_sum(n: f64, theta: f64, gamma: f64) -> f64 {
    let (a, b) = (gamma.cos() * theta.cos(), gamma.sin() * theta.sin());
    let horizon = if b <= a.abs() { if a > 0.0 { PI } else { 0.0 } } else { (-a / b).acos() };
    if n == 1.0 {
        return 2.0 * (a * horizon + b * horizon.sin());
    }
    // no further than where the lobe is lost beside its largest value
    let least = (a + b) * (-32.0 / n.max(1e-3)).exp();
    let end = if b <= 0.0 { PI } else { ((least - a) / b).clamp(-1.0, 1.0).acos() }.min(horizon);
    let at = |phi: f64| (a + b * phi.cos()).max(0.0).powf(n);
    RULE.with(|rule| rule.iter().map(|(x, weight)| end * weight * at(0.5 * end * (x + 1.0))).sum())
}

thread_local! {
    static RULE: Vec<(f64, f64)> = gauss_legendre(64);
}

/// Any light, direction by direction: the airlight of `airlight.rs` in each, in polar coordinates about the way to the
/// light, where it is integrable.
pub fn scattered_from_all_around(light: &Light, medium: &Medium, surface: &Surface) -> DVec3 {
    let to_light = incident(light, surface.position).to_light;
    let lobe = |factor: DVec3, n: f64, axis: DVec3| {
        if factor == DVec3::ZERO {
            return DVec3::ZERO;
        }
        let around = |direction| airlight(light, medium, &Ray { origin: surface.position, direction }, 0.0, f64::INFINITY);
        factor * lobe_of_directions(n, axis, to_light, around)
    };
    lobe(surface.diffuse / PI, 1.0, surface.normal) + lobe(surface.specular, surface.shininess, surface.mirrored)
}

fn lobe_of_directions(n: f64, axis: DVec3, pole: DVec3, around: impl Fn(DVec3) -> DVec3) -> DVec3 {
    let theta = axis.angle_between(pole);
    let across = (axis - pole * axis.dot(pole)).try_normalize().unwrap_or_else(|| pole.any_orthonormal_vector());
    let side = pole.cross(across);
    let (low, high) = ((theta - reach(n)).max(0.0), (theta + reach(n)).min(PI));
    RULE.with(|rule| {
        let mut sum = DVec3::ZERO;
        for (x, weight) in rule {
            // nodes crowd at the pole
            let t = 0.5 * (x + 1.0);
            let gamma = low + (high - low) * t * t;
            let (a, b) = (gamma.cos() * theta.cos(), gamma.sin() * theta.sin());
            let least = (a + b).max(0.0) * (-32.0 / n.max(1e-3)).exp();
            let end = if b <= 0.0 { PI } else { ((least - a) / b).clamp(-1.0, 1.0).acos() };
            for (y, part) in rule {
                let phi = end * y;
                let direction = pole * gamma.cos() + (across * phi.cos() + side * phi.sin()) * gamma.sin();
                let kernel = direction.dot(axis).max(0.0).powf(n);
                sum += around(direction) * (kernel * gamma.sin() * weight * part * end * (high - low) * t);
            }
        }
        sum
    })
}
