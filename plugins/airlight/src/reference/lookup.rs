//! Airlight as the papers look it up: from the table that the pass was given, so that errors of the table are not the pass's.

use std::f64::consts::{FRAC_PI_2, FRAC_PI_4, PI};

use glam::DVec3;
use tyndall_plugin::{Outputs, ReferenceInput};
use tyndall_shaders::airlight_table::{Table, legendre_polynomials};
use tyndall_shaders::cone::ray_in_cone;
use tyndall_shaders::medium::opacity;
use tyndall_shaders::phase::{self, phase};
use tyndall_shaders::ray::Ray;
use tyndall_shaders::scene::{Light, Medium, Phase};

use super::of_lights;
use super::tables::TABLE_DEPTH;

/// Parts of a spot's lit interval: as in `airlight_table.wgsl`.
const SPOT_PARTS: u32 = 8;
/// cos^N is left out below 2^-30 of its largest value on the ray, and this much sooner for each metre of v beyond the start:
/// as in `cone.wgsl`.
const FALLOFF_BITS: f64 = 30.0;
const BITS_PER_V: f64 = std::f64::consts::LOG2_E;
const MOST_BITS: f64 = 1000.0;
const V_MAX: f64 = 1e18;
/// A light so far behind the eye leaves nothing in f32.
const LARGEST_EXPONENT: f64 = 80.0;

/// By H.
pub(crate) fn table(input: &ReferenceInput<'_>) -> Outputs {
    of_table(input, [1.0, 0.0, 0.0, 0.0], phase)
}

/// By H_k and the first four terms of the phase function's Legendre series.
pub(crate) fn legendre(input: &ReferenceInput<'_>) -> Outputs {
    let means = phase::legendre(&input.scene()?.medium.phase);
    let weights: [f64; 4] = std::array::from_fn(|k| (2.0 * k as f64 + 1.0) / (4.0 * PI) * means[k]);
    let series = |_: &Phase, w: f64| legendre_polynomials(1.0 - 2.0 * w).iter().zip(weights).map(|(p, b)| p * b).sum();
    of_table(input, weights, series)
}

fn of_table(input: &ReferenceInput<'_>, weights: [f64; 4], phase: impl Fn(&Phase, f64) -> f64 + Sync) -> Outputs {
    let data = input.input("table")?;
    let numbers = data.floats();
    let table = Table { size: [data.width(), data.height()], channels: data.channels(), data: &numbers };
    of_lights(input, |scene, light, ray, far| {
        let medium = &scene.medium;
        if let Light::Directional { direction, irradiance } = *light {
            let w = (direction + ray.direction).length_squared() / 4.0;
            return medium.albedo * irradiance * phase(&medium.phase, w) * opacity(medium, far);
        }
        lamp(light, medium, ray, far, &|u, theta| table.at(weights, [u / TABLE_DEPTH, theta / PI + 0.5]))
    })
}

/// sigma_s I e^(-sigma_t t)/h (H(u, theta_d) - H(u, theta_0)), for a spot in parts.
fn lamp(light: &Light, medium: &Medium, ray: &Ray, far: f64, h_of: &dyn Fn(f64, f64) -> f64) -> DVec3 {
    let (position, intensity, radius) = match *light {
        Light::Point { position, intensity, radius } | Light::Spot { position, intensity, radius, .. } => {
            (position, intensity, radius)
        }
        Light::Directional { .. } => return DVec3::ZERO,
    };
    let to_light = position - ray.origin;
    let (t, away) = (to_light.dot(ray.direction), to_light.cross(ray.direction));
    let h = away.length().max(radius).max(1e-6 * to_light.length()).max(1e-12);
    let whole = [(-t).atan2(h), (far - t).atan2(h)];
    let parts: Vec<([f64; 2], f64)> = match *light {
        Light::Spot { direction, exponent, cutoff, .. } => {
            let across = away.cross(ray.direction).normalize_or_zero();
            spot_parts([direction.dot(ray.direction), direction.dot(across)], exponent, cutoff, whole)
        }
        _ => vec![(whole, 1.0)],
    };
    DVec3::from_array(std::array::from_fn(|i| {
        let extinction = medium.extinction[i];
        let u = extinction * h;
        let sum: f64 = parts.iter().map(|([low, high], falloff)| falloff * (h_of(u, *high) - h_of(u, *low))).sum();
        let exponent = -extinction * t;
        if exponent >= LARGEST_EXPONENT {
            return 0.0;
        }
        medium.albedo[i] * extinction * intensity[i] * sum * exponent.exp() / h
    }))
}

/// Parts of the ray that a spot lights, in theta, each with cos^N in its middle.
fn spot_parts([along, across]: [f64; 2], exponent: f64, cutoff: f64, whole: [f64; 2]) -> Vec<([f64; 2], f64)> {
    let cosine = |theta: f64| along * theta.sin() + across * theta.cos();
    let v = |theta: f64| (FRAC_PI_4 + 0.5 * theta).tan().clamp(0.0, V_MAX);
    let peak = match (across >= 0.0, along >= 0.0) {
        (true, _) => along.atan2(across).max(whole[0]),
        (false, true) => FRAC_PI_2,
        (false, false) => whole[0],
    };
    let bits = FALLOFF_BITS + (BITS_PER_V * (v(peak) - v(whole[0]))).min(MOST_BITS);
    let lowest = cosine(peak).max(0.0) * (-bits / exponent.max(0.01)).exp2();
    let edge = cutoff.to_radians().cos().max(if exponent > 0.0 { lowest } else { -1.0 });
    let lit = ray_in_cone(along, across, edge.clamp(-1.0, 1.0).acos().to_degrees());
    let within = lit.into_iter().map(|part| part.map(|theta| theta.clamp(whole[0], whole[1])));
    within
        .flat_map(|[low, high]| {
            let width = (high - low) / f64::from(SPOT_PARTS);
            (0..SPOT_PARTS).map(move |part| {
                let start = low + f64::from(part) * width;
                ([start, start + width], cosine(start + 0.5 * width).max(1e-30).powf(exponent))
            })
        })
        .collect()
}
