//! Hong's H and H_k by adaptive quadrature: twin of `airlight_table.wgsl`, whose glossary this follows.
//!
//! In x = ln τ, `H(u, θ) = ∫ p(w)·e^(−u·eˣ)/cosh x dx` with w = 1/(1 + e^(−2x)): no peak is narrow.

use crate::phase::{kinks, phase};
use crate::quadrature::{Value, integrate, integrate_pieces};
use crate::scene::Phase;
use glam::DVec4;
use std::f64::consts::{FRAC_PI_4, PI};

/// Relative error that is asked of the adaptive rule.
const TOLERANCE: f64 = 1e-11;

/// Bound of |x|: behind it 1/cosh x leaves 1e-17.
pub(crate) const ENDLESS: f64 = 40.0;

/// H(u, θ), 1/sr, θ in radians from −π/2 to π/2 (Hong 2006, eq. 4.7).
pub fn h(kind: &Phase, u: f64, theta: f64) -> f64 {
    integral(|w| phase(kind, w), &kinks(kind), u, theta)
}

/// H_0 to H_3 of the same arguments (Hong 2006, eq. 4.17).
pub fn h_k(u: f64, theta: f64) -> [f64; 4] {
    legendre_terms(integral(raised_polynomials, &[], u, theta))
}

/// Biri's Γ(λ, γ) as the paper writes it, over an angle from 0 (Biri, Arques and Michelin 2006, eq. 6, its exponent without
/// the second k_t; its phase functions integrate to 4π). It is `4π·(H(λ, γ) − H(λ, 0))`.
pub fn gamma(kind: &Phase, lambda: f64, angle: f64) -> f64 {
    let integrand = |alpha: f64| {
        let (sine, cosine) = alpha.sin_cos();
        let w = (1.0 + sine) / 2.0;
        4.0 * PI * phase(kind, w) * (-lambda * (sine + 1.0) / cosine).exp()
    };
    if angle < 0.0 { -integrate(integrand, angle, 0.0, TOLERANCE) } else { integrate(integrand, 0.0, angle, TOLERANCE) }
}

/// A table of up to four channels as the passes look it up: linear in both coordinates, both ends included.
#[derive(Debug, Clone, Copy)]
pub struct Table<'a> {
    /// Texels in x and y.
    pub size: [u32; 2],
    /// Numbers of a texel.
    pub channels: u32,
    /// Row by row.
    pub data: &'a [f32],
}

impl Table<'_> {
    /// At a place, 0 to 1 from its first to its last texels, clamped; each channel times its weight, summed.
    pub fn at(&self, weights: [f64; 4], place: [f64; 2]) -> f64 {
        let axis = |axis: usize| {
            let last = f64::from(self.size[axis] - 1);
            let at = place[axis].clamp(0.0, 1.0) * last;
            let low = at.floor().min((last - 1.0).max(0.0));
            [(low, 1.0 - (at - low)), ((low + 1.0).min(last), at - low)]
        };
        let texel = |x: f64, y: f64| {
            let first = ((y as u32 * self.size[0] + x as u32) * self.channels) as usize;
            let channels = self.data[first..first + self.channels as usize].iter().zip(weights);
            channels.map(|(value, weight)| f64::from(*value) * weight).sum::<f64>()
        };
        let rows = axis(1).into_iter();
        rows.map(|(y, down)| axis(0).iter().map(|(x, across)| down * across * texel(*x, y)).sum::<f64>()).sum()
    }
}

/// 1, and P_1 to P_3 at w with 1 added: never below 0, so that no integral of them cancels.
pub(crate) fn raised_polynomials(w: f64) -> DVec4 {
    DVec4::from_array(legendre_polynomials(1.0 - 2.0 * w)) + DVec4::new(0.0, 1.0, 1.0, 1.0)
}

/// Integrals of the polynomials from those of [`raised_polynomials`].
pub(crate) fn legendre_terms(raised: DVec4) -> [f64; 4] {
    let [all, first, second, third] = raised.to_array();
    [all, first - all, second - all, third - all]
}

/// P_0 to P_3.
pub fn legendre_polynomials(mu: f64) -> [f64; 4] {
    [1.0, mu, 1.5 * mu * mu - 0.5, mu * (2.5 * mu * mu - 1.5)]
}

fn integral<V: Value>(f: impl Fn(f64) -> V, kinks: &[f64], u: f64, theta: f64) -> V {
    let end = (theta / 2.0 + FRAC_PI_4).tan().ln().min(ENDLESS);
    let integrand = |x: f64| f(1.0 / (1.0 + (-2.0 * x).exp())) * ((-u * x.exp()).exp() / x.cosh());
    if end > -ENDLESS {
        integrate_pieces(integrand, end.min(0.0) - ENDLESS, end, kinks, TOLERANCE)
    } else {
        V::default()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The two papers' functions are one, from two zeros: looked up at two ends of a ray, they give the same light.
    #[test]
    fn hongs_h_and_biris_gamma_are_one_function() {
        for kind in [Phase::Isotropic, Phase::HenyeyGreenstein { g: 0.75 }, Phase::HenyeyGreenstein { g: -0.4 }] {
            for lambda in [0.01, 0.3, 1.0, 4.0, 10.0] {
                for angle in [-1.5, -0.7, -0.1, 0.2, 0.9, 1.4] {
                    let expected = 4.0 * PI * (h(&kind, lambda, angle) - h(&kind, lambda, 0.0));
                    let value = gamma(&kind, lambda, angle);
                    assert!((value - expected).abs() < 1e-9 * h(&kind, 0.0, 1.5), "{kind:?}, {lambda}, {angle}");
                }
            }
        }
    }

    /// Where the phase function is its own series, H is the sum of the H_k.
    #[test]
    fn a_short_series_is_exact() {
        for (u, theta) in [(0.0, 1.5), (0.2, 0.3), (3.0, -0.8)] {
            let terms = h_k(u, theta);
            let rayleigh = (terms[0] + 0.5 * terms[2]) / (4.0 * PI);
            assert!((h(&Phase::Rayleigh, u, theta) - rayleigh).abs() < 1e-10);
        }
    }
}
