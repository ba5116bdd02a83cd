//! Phase functions, 1/sr: twin of `phase.wgsl`.

#[doc(inline)]
pub use crate::phase_functions::{Interval, PHASE_FUNCTIONS, Parameter, Phase, PhaseFunction, lobes, phase};
#[doc(inline)]
pub use crate::phase_table::PhaseTable;
use crate::quadrature::integrate;
use std::f64::consts::PI;

/// Where a phase function is not smooth, in u with w = 1/(1 + e^(−2u)): at the rows of a table.
pub fn kinks(phase: &Phase) -> Vec<f64> {
    match phase {
        // e^u = tan(θ/2)
        Phase::Measured(table) => table.angles().iter().map(|angle| (angle / 2.0).tan().ln()).collect(),
        _ => Vec::new(),
    }
}

/// One lobe of a phase function: twin of `Lobe` of `scene.wgsl`, `scale·q^(−3/2 or −2)·(1 + mu_squared·µ²)` with
/// `q = rho²·(1 − w) + w`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Lobe {
    /// Width: (1 − g)/(1 + g), of Schlick's function √((1 − k)/(1 + k)), 1 where a lobe has none.
    pub rho: f64,
    /// 1/sr.
    pub scale: f64,
    /// Whether the power of q is −2 (Schlick) and not −3/2.
    pub squared: bool,
    /// Factor of µ².
    pub mu_squared: f64,
}

impl Lobe {
    /// Henyey and Greenstein's: (1 − g²)/(1 + g)³ = rho·(1 + rho)/2.
    pub(crate) fn henyey_greenstein(g: f64, weight: f64) -> Self {
        let rho = (1.0 - g) / (1.0 + g);
        Lobe { rho, scale: weight * rho * (1.0 + rho) / (8.0 * PI), squared: false, mu_squared: 0.0 }
    }

    /// Schlick's.
    pub(crate) fn schlick(k: f64) -> Self {
        let rho = ((1.0 - k) / (1.0 + k)).sqrt();
        Lobe { rho, scale: rho * rho / (4.0 * PI), squared: true, mu_squared: 0.0 }
    }

    /// Times (1 + c·µ²), and as much smaller as that makes it larger: over the sphere, the mean of µ² over Henyey and
    /// Greenstein's function is (1 + 2·g²)/3.
    pub(crate) fn times_mu_squared(self, c: f64, g: f64) -> Self {
        Lobe { scale: self.scale / (1.0 + c * (1.0 + 2.0 * g * g) / 3.0), mu_squared: c, ..self }
    }

    /// At w, 1/sr.
    pub fn at(&self, w: f64) -> f64 {
        let (q, mu) = (self.rho * self.rho * (1.0 - w) + w, 1.0 - 2.0 * w);
        self.scale * q.powf(if self.squared { -2.0 } else { -1.5 }) * (1.0 + self.mu_squared * mu * mu)
    }
}

/// Mean of a function of µ over a phase function.
pub fn mean(kind: &Phase, of: impl Fn(f64) -> f64) -> f64 {
    if let Phase::Measured(table) = kind {
        return table.mean(of);
    }
    // in u where w = 1/(1 + e^(-2u)), so that no peak is narrow; dmu = -2 dw, dw = 2 w (1 - w) du
    let integrand = |u: f64| {
        let w = 1.0 / (1.0 + (-2.0 * u).exp());
        let rest = 1.0 / (1.0 + (2.0 * u).exp());
        phase(kind, w) * of(rest - w) * 2.0 * PI * 4.0 * w * rest
    };
    integrate(integrand, -40.0, 40.0, 1e-12)
}

/// Means of the Legendre polynomials P₀…P₃ of µ over a phase function: its expansion is Σ (2k + 1)/(4π)·mean·P_k.
/// Of Henyey and Greenstein's function they are gᵏ.
pub fn legendre(kind: &Phase) -> [f64; 4] {
    let polynomials: [fn(f64) -> f64; 4] =
        [|_| 1.0, |mu| mu, |mu| 1.5 * mu * mu - 0.5, |mu| mu * (2.5 * mu * mu - 1.5)];
    // never below -1, so with 1 added no integral is 0, of which there is no relative error
    polynomials.map(|polynomial| mean(kind, |mu| polynomial(mu) + 1.0) - 1.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Each phase function with parameters all over their ranges, and some that are hard.
    fn all() -> Vec<Phase> {
        let shares = [0.005, 0.1, 0.25, 0.5, 0.65, 0.875, 0.95, 0.995];
        let at = |share: f64| PHASE_FUNCTIONS.iter().map(move |of| (of.make)(&mut |p| Some(p.range.at(share))));
        let mut all: Vec<Phase> = shares.into_iter().flat_map(at).flatten().collect();
        assert_eq!(all.len(), shares.len() * PHASE_FUNCTIONS.len());
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
            let integral = mean(&kind, |_| 1.0);
            assert!((integral - 1.0).abs() < 1e-9, "{kind:?}: {integral}");
        }
    }

    #[test]
    fn mean_cosines() {
        for g in [-0.99, -0.4, 0.0, 0.5, 0.99] {
            let cosine = |kind| mean(&kind, |mu| mu);
            assert!((cosine(Phase::HenyeyGreenstein { g }) - g).abs() < 1e-9);
            let two = Phase::DoubleHenyeyGreenstein { g1: g, g2: -0.3, f: 0.25 };
            assert!((cosine(two) - (0.75 * g - 0.075)).abs() < 1e-9);
            // Cornette and Shanks 1992, eq. 9
            let expected = g * 3.0 * (4.0 + g * g) / (5.0 * (2.0 + g * g));
            assert!((cosine(Phase::CornetteShanks { g }) - expected).abs() < 1e-9);
        }
        assert!(mean(&Phase::Schlick { k: 0.5 }, |mu| mu) > 0.1, "k > 0 is forward");
        assert!(mean(&Phase::Rayleigh, |mu| mu).abs() < 1e-12);
    }

    #[test]
    fn lobes_are_the_function() {
        for kind in all() {
            for w in [0.0, 1e-12, 1e-6, 0.01, 0.3, 0.5, 0.9, 1.0] {
                let sum: f64 = lobes(&kind).iter().map(|lobe| lobe.at(w)).sum();
                assert!((sum / phase(&kind, w) - 1.0).abs() < 1e-9, "{kind:?} at {w}: {sum}");
            }
        }
    }

    #[test]
    fn legendre_means() {
        let close = |a: [f64; 4], b: [f64; 4]| a.iter().zip(b).all(|(a, b)| (a - b).abs() < 1e-9);
        for g in [-0.9_f64, 0.0, 0.5, 0.99] {
            assert!(close(legendre(&Phase::HenyeyGreenstein { g }), [1.0, g, g * g, g.powi(3)]), "g {g}");
        }
        assert!(close(legendre(&Phase::Rayleigh), [1.0, 0.0, 0.1, 0.0]));
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
            let mean = mean(&Phase::Schlick { k }, |mu| mu);
            assert!((mean - g).abs() < 0.07, "g {g}: {mean}");
        }
    }
}
