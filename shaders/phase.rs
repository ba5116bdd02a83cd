//! Phase functions, 1/sr: twin of `phase.wgsl`.

use crate::scene::Phase;
use std::f64::consts::PI;

/// The share of scattered light that goes into a direction, 1/sr; `w` is sin² of half the scattering angle, (1 − µ)/2,
/// where µ = 1 is forward. Henyey and Greenstein 1941; Blasi, Le Saëc and Schlick 1993, eq. 3, with k above 0 forward;
/// Cornette and Shanks 1992, eq. 8.
pub fn phase(phase: &Phase, w: f64) -> f64 {
    let mu = 1.0 - 2.0 * w;
    match *phase {
        Phase::Isotropic => 1.0 / (4.0 * PI),
        Phase::HenyeyGreenstein { g } => henyey_greenstein(g, w),
        Phase::DoubleHenyeyGreenstein { g1, g2, f } => {
            (1.0 - f) * henyey_greenstein(g1, w) + f * henyey_greenstein(g2, w)
        }
        // 1 - k mu = 1 - k + 2 k w
        Phase::Schlick { k } => (1.0 - k) * (1.0 + k) / (4.0 * PI * (1.0 - k + 2.0 * k * w).powi(2)),
        Phase::Rayleigh => 3.0 / (16.0 * PI) * (1.0 + mu * mu),
        Phase::CornetteShanks { g } => henyey_greenstein(g, w) * 1.5 * (1.0 + mu * mu) / (2.0 + g * g),
    }
}

/// 1 + g² − 2gµ = (1 − g)² + 4gw, which does not cancel near µ = 1.
fn henyey_greenstein(g: f64, w: f64) -> f64 {
    (1.0 - g) * (1.0 + g) / (4.0 * PI * ((1.0 - g).powi(2) + 4.0 * g * w).powf(1.5))
}

/// The widths of the lobes that `Medium` of `scene.wgsl` holds as `rho1` and `rho2`: (1 − g)/(1 + g), of Schlick's
/// function √((1 − k)/(1 + k)), 1 where a lobe has none.
pub fn lobe_widths(phase: &Phase) -> [f64; 2] {
    let width = |g: f64| (1.0 - g) / (1.0 + g);
    match *phase {
        Phase::Isotropic | Phase::Rayleigh => [1.0, 1.0],
        Phase::HenyeyGreenstein { g } | Phase::CornetteShanks { g } => [width(g), 1.0],
        Phase::DoubleHenyeyGreenstein { g1, g2, .. } => [width(g1), width(g2)],
        Phase::Schlick { k } => [width(k).sqrt(), 1.0],
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::quadrature::integrate;

    /// ∫ p·weight(µ) over the sphere, in u where w = 1/(1 + e^(−2u)), so that no peak is narrow.
    fn over_the_sphere(kind: &Phase, weight: impl Fn(f64) -> f64) -> f64 {
        let f = |u: f64| {
            let w = 1.0 / (1.0 + (-2.0 * u).exp());
            // dµ = -2 dw, dw = 2 w (1 - w) du
            let rest = 1.0 / (1.0 + (2.0 * u).exp());
            phase(kind, w) * weight(rest - w) * 2.0 * PI * 4.0 * w * rest
        };
        integrate(f, -40.0, 40.0, 1e-12)
    }

    fn all() -> Vec<Phase> {
        let mut all = vec![Phase::Isotropic, Phase::Rayleigh];
        for g in [-0.99, -0.5, 0.0, 0.3, 0.75, 0.9, 0.99, 0.999_999] {
            all.push(Phase::HenyeyGreenstein { g });
            all.push(Phase::Schlick { k: g });
            all.push(Phase::CornetteShanks { g });
            all.push(Phase::DoubleHenyeyGreenstein { g1: g, g2: -0.3, f: 0.25 });
        }
        all
    }

    #[test]
    fn each_integrates_to_one() {
        for kind in all() {
            let integral = over_the_sphere(&kind, |_| 1.0);
            assert!((integral - 1.0).abs() < 1e-9, "{kind:?}: {integral}");
        }
    }

    #[test]
    fn mean_cosines() {
        for g in [-0.99, -0.4, 0.0, 0.5, 0.99] {
            let mean = |kind| over_the_sphere(&kind, |mu| mu);
            assert!((mean(Phase::HenyeyGreenstein { g }) - g).abs() < 1e-9);
            let two = Phase::DoubleHenyeyGreenstein { g1: g, g2: -0.3, f: 0.25 };
            assert!((mean(two) - (0.75 * g - 0.075)).abs() < 1e-9);
            // Cornette and Shanks 1992, eq. 9
            let expected = g * 3.0 * (4.0 + g * g) / (5.0 * (2.0 + g * g));
            assert!((mean(Phase::CornetteShanks { g }) - expected).abs() < 1e-9);
        }
        assert!(over_the_sphere(&Phase::Schlick { k: 0.5 }, |mu| mu) > 0.1, "k > 0 is forward");
        assert!(over_the_sphere(&Phase::Rayleigh, |mu| mu).abs() < 1e-12);
    }

    #[test]
    fn limits() {
        for w in [0.0, 0.1, 0.5, 1.0] {
            let close = |a: Phase, b: Phase| (phase(&a, w) - phase(&b, w)).abs() < 1e-12;
            assert!(close(Phase::HenyeyGreenstein { g: 0.0 }, Phase::Isotropic));
            assert!(close(Phase::Schlick { k: 0.0 }, Phase::Isotropic));
            assert!(close(Phase::CornetteShanks { g: 0.0 }, Phase::Rayleigh));
            let two = Phase::DoubleHenyeyGreenstein { g1: 0.7, g2: -0.2, f: 1.0 };
            assert!(close(two, Phase::HenyeyGreenstein { g: -0.2 }));
        }
    }

    /// Schlick's function with k = 1.55 g − 0.55 g³ stands in for Henyey and Greenstein's (Pharr, Jakob and Humphreys,
    /// section 11.3): the mean cosines agree within a few hundredths.
    #[test]
    fn schlick_follows_henyey_greenstein() {
        for g in [0.1_f64, 0.3, 0.5, 0.7] {
            let k = 1.55 * g - 0.55 * g.powi(3);
            let mean = over_the_sphere(&Phase::Schlick { k }, |mu| mu);
            assert!((mean - g).abs() < 0.07, "g {g}: {mean}");
        }
    }
}
