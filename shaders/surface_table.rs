//! Hong's J and J_k by nested adaptive quadrature: twin of `surface_table.wgsl`, whose glossary this follows.

use crate::airlight_table::{ENDLESS, legendre_terms, raised_polynomials};
use crate::phase::{kinks, phase};
use crate::quadrature::{Value, integrate, integrate_pieces};
use crate::scene::Phase;
use glam::DVec4;
use std::f64::consts::{FRAC_PI_2, PI};

/// Relative errors that are asked of the adaptive rule, of the outer integral and of those in it.
const TOLERANCE: f64 = 1e-8;
const TOLERANCE_WITHIN: f64 = 1e-10;

/// J(T, θ_s), sr⁻¹·sr, of the lobe cosⁿ; θ_s in radians from 0 to π (Hong 2006, eq. 4.13 and 4.14).
pub fn j(kind: &Phase, n: f64, depth: f64, angle: f64) -> f64 {
    integral(&|w| phase(kind, w), &kinks(kind), n, depth, angle)
}

/// J_0 to J_3 of the same arguments (Hong 2006, eq. 4.19).
pub fn j_k(n: f64, depth: f64, angle: f64) -> [f64; 4] {
    legendre_terms(integral(&raised_polynomials, &[], n, depth, angle))
}

/// Γ_l(T) = ∫ P_l(cos γ)·A(γ) dγ for l = 0, 1, 2 and 4 (Biri, Arques and Michelin 2006, eq. 11, is that of l = 1).
pub fn gamma_l(kind: &Phase, depth: f64) -> [f64; 4] {
    let (f, kinks) = (|w| phase(kind, w), kinks(kind));
    let ring = |gamma: f64| DVec4::from_array(zonal_polynomials(gamma.cos())) * along(&f, &kinks, depth, gamma);
    integrate(ring, 0.0, PI, TOLERANCE).to_array()
}

/// P_0, P_1, P_2 and P_4.
pub fn zonal_polynomials(cosine: f64) -> [f64; 4] {
    let square = cosine * cosine;
    [1.0, cosine, 1.5 * square - 0.5, (35.0 * square * square - 30.0 * square + 3.0) / 8.0]
}

/// The part of the clamped cosine in each of them (Ramamoorthi and Hanrahan 2001).
pub const CLAMPED_COSINE: [f64; 4] = [1.0 / 4.0, 1.0 / 2.0, 5.0 / 16.0, -3.0 / 32.0];

fn integral<V: Value>(f: &impl Fn(f64) -> V, kinks: &[f64], n: f64, depth: f64, angle: f64) -> V {
    let ring = |gamma: f64| along(f, kinks, depth, gamma) * lobe_over_circle(gamma, angle, n);
    // the lobe's edge cuts a ring between the second and the third
    let edges = [
        (angle - FRAC_PI_2).max(0.0),
        (FRAC_PI_2 - angle).clamp(0.0, PI),
        (1.5 * PI - angle).min(PI),
        (angle + FRAC_PI_2).min(PI),
    ];
    let mut edges: Vec<f64> = edges.into_iter().filter(|edge| *edge >= edges[0] && *edge <= edges[3]).collect();
    edges.sort_by(f64::total_cmp);
    edges.windows(2).filter(|pair| pair[1] > pair[0]).map(|pair| integrate(ring, pair[0], pair[1], TOLERANCE)).sum()
}

/// K(γ).
fn lobe_over_circle(gamma: f64, angle: f64, n: f64) -> f64 {
    let (a, b) = (gamma.cos() * angle.cos(), gamma.sin() * angle.sin());
    let half = if a >= b { PI } else { (-a / b).clamp(-1.0, 1.0).acos() };
    let lobe = |phi: f64| (a + b * phi.cos()).max(0.0).powf(n);
    if a + b > 0.0 { 2.0 * integrate(lobe, 0.0, half, TOLERANCE_WITHIN) } else { 0.0 }
}

/// A(γ).
fn along<V: Value>(f: &impl Fn(f64) -> V, kinks: &[f64], depth: f64, gamma: f64) -> V {
    let start = (gamma / 2.0).tan();
    let integrand = |x: f64| {
        let w = 1.0 / (1.0 + (-2.0 * x).exp());
        f(w) * ((-depth * gamma.sin() * (x.exp() - start)).exp() / x.cosh())
    };
    integrate_pieces(integrand, start.ln().max(-ENDLESS), ENDLESS, kinks, TOLERANCE_WITHIN) * (-depth).exp()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Light from all sides, T = 0 and isotropic: A(γ) = (π − γ)/(4π), so J has a closed form where the light is overhead.
    #[test]
    fn closed_form_without_extinction() {
        // ∫ (π − γ)/(4π)·2π·cos γ dγ over 0..π/2
        let expected = 0.5 * (FRAC_PI_2 + 1.0);
        assert!((j(&Phase::Isotropic, 1.0, 0.0, 0.0) - expected).abs() < 1e-9);
    }

    /// The sum of few degrees is Hong's J¹ to 2.5 % of its largest value, at any angle; what is published is it only where the
    /// surface faces the lamp, and loses everything at 90°.
    #[test]
    fn few_degrees_are_nearly_the_clamped_hemisphere() {
        for kind in [Phase::Isotropic, Phase::HenyeyGreenstein { g: 0.75 }, Phase::Rayleigh] {
            for depth in [0.01, 1.0, 6.0] {
                let terms = gamma_l(&kind, depth);
                let largest = j(&kind, 1.0, depth, 0.0);
                for step in 0..=12 {
                    let angle = f64::from(step) * PI / 12.0;
                    let polynomials = zonal_polynomials(angle.cos());
                    let sum: f64 = (0..4).map(|i| 2.0 * PI * CLAMPED_COSINE[i] * terms[i] * polynomials[i]).sum();
                    let error = (sum - j(&kind, 1.0, depth, angle)).abs() / largest;
                    assert!(error < 0.025, "{kind:?}, T = {depth}, {step}/12 of 180 degrees: {error}");
                }
            }
        }
    }

    /// Vector irradiance is light from the front less light from behind.
    #[test]
    fn the_published_integral_takes_off_what_comes_from_behind() {
        let kind = Phase::HenyeyGreenstein { g: 0.5 };
        for angle in [0.0, 0.7, FRAC_PI_2] {
            let published = 2.0 * PI * angle.cos() * gamma_l(&kind, 1.0)[1];
            let both = j(&kind, 1.0, 1.0, angle) - j(&kind, 1.0, 1.0, PI - angle);
            assert!((published - both).abs() < 1e-7, "{angle}: {published} beside {both}");
        }
    }

    /// Scattered light does not end where the table of the thesis does.
    #[test]
    fn what_turns_away_is_lit_by_fog() {
        let at = |degrees: f64| j(&Phase::Isotropic, 1.0, 1.0, degrees.to_radians());
        assert!(at(90.0) > 0.2 * at(0.0) && at(180.0) > 0.05 * at(0.0));
    }
}
