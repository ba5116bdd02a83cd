//! Phase functions, 1/sr: twin of `phase.wgsl`.

#[doc(inline)]
pub use crate::phase_table::PhaseTable;
use crate::quadrature::integrate;
use crate::scene::Phase;
use std::f64::consts::PI;

/// The share of scattered light that goes into a direction, 1/sr; `w` is sin² of half the scattering angle, (1 − µ)/2,
/// where µ = 1 is forward. Henyey and Greenstein 1941; Blasi, Le Saëc and Schlick 1993, eq. 3, with k above 0 forward;
/// Cornette and Shanks 1992, eq. 8; Jendersie and d'Eon 2023.
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
        Phase::Droplets { diameter } => {
            let Droplets { g_hg, g_d, alpha, w_d } = droplets(diameter);
            let draine =
                henyey_greenstein(g_d, w) * (1.0 + alpha * mu * mu) / (1.0 + alpha * (1.0 + 2.0 * g_d * g_d) / 3.0);
            (1.0 - w_d) * henyey_greenstein(g_hg, w) + w_d * draine
        }
        Phase::Measured(table) => table.at(2.0 * w.max(0.0).sqrt().atan2((1.0 - w).max(0.0).sqrt())),
    }
}

/// Where a phase function is not smooth, in u with w = 1/(1 + e^(−2u)): at the rows of a table.
pub fn kinks(phase: &Phase) -> Vec<f64> {
    match phase {
        // e^u = tan(θ/2)
        Phase::Measured(table) => table.angles().iter().map(|angle| (angle / 2.0).tan().ln()).collect(),
        _ => Vec::new(),
    }
}

/// Parameters of the mixture of Henyey and Greenstein's function and Draine's, after Jendersie and d'Eon 2023.
struct Droplets {
    /// g of Henyey and Greenstein's function: the diffraction peak.
    g_hg: f64,
    /// g and α of Draine's function (Draine 2003).
    g_d: f64,
    alpha: f64,
    /// Weight of Draine's function.
    w_d: f64,
}

/// Jendersie and d'Eon 2023, "An approximate Mie scattering function for fog and cloud rendering": their fit for droplets
/// of water of a diameter from 5 to 50 µm, in visible light.
fn droplets(diameter: f64) -> Droplets {
    Droplets {
        g_hg: (-0.099_056_7 / (diameter - 1.671_54)).exp(),
        g_d: (-2.206_79 / (diameter + 3.910_29) - 0.428_934).exp(),
        alpha: (3.624_89 - 8.292_88 / (diameter + 5.528_25)).exp(),
        w_d: (-0.599_085 / (diameter - 0.641_583) - 0.665_888).exp(),
    }
}

/// 1 + g² − 2gµ = (1 − g)² + 4gw, which does not cancel near µ = 1.
fn henyey_greenstein(g: f64, w: f64) -> f64 {
    let q = (1.0 - g).powi(2) + 4.0 * g * w;
    (1.0 - g) * (1.0 + g) / (4.0 * PI * q * q.sqrt())
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
    fn henyey_greenstein(g: f64, weight: f64) -> Self {
        let rho = (1.0 - g) / (1.0 + g);
        Lobe { rho, scale: weight * rho * (1.0 + rho) / (8.0 * PI), squared: false, mu_squared: 0.0 }
    }

    /// Times (1 + c·µ²), and as much smaller as that makes it larger: over the sphere, the mean of µ² over Henyey and
    /// Greenstein's function is (1 + 2·g²)/3.
    fn times_mu_squared(self, c: f64, g: f64) -> Self {
        Lobe { scale: self.scale / (1.0 + c * (1.0 + 2.0 * g * g) / 3.0), mu_squared: c, ..self }
    }

    /// At w, 1/sr.
    pub fn at(&self, w: f64) -> f64 {
        let (q, mu) = (self.rho * self.rho * (1.0 - w) + w, 1.0 - 2.0 * w);
        self.scale * q.powf(if self.squared { -2.0 } else { -1.5 }) * (1.0 + self.mu_squared * mu * mu)
    }
}

/// The lobes of a phase function, one or two. A measured one has none of its own: what is given for it has its mean
/// cosine, and says only about how wide it is.
pub fn lobes(phase: &Phase) -> Vec<Lobe> {
    match *phase {
        Phase::Isotropic => vec![Lobe::henyey_greenstein(0.0, 1.0)],
        Phase::HenyeyGreenstein { g } => vec![Lobe::henyey_greenstein(g, 1.0)],
        Phase::DoubleHenyeyGreenstein { g1, g2, f } => {
            vec![Lobe::henyey_greenstein(g1, 1.0 - f), Lobe::henyey_greenstein(g2, f)]
        }
        Phase::Schlick { k } => {
            let rho = ((1.0 - k) / (1.0 + k)).sqrt();
            vec![Lobe { rho, scale: rho * rho / (4.0 * PI), squared: true, mu_squared: 0.0 }]
        }
        Phase::Rayleigh => vec![Lobe::henyey_greenstein(0.0, 1.0).times_mu_squared(1.0, 0.0)],
        Phase::CornetteShanks { g } => vec![Lobe::henyey_greenstein(g, 1.0).times_mu_squared(1.0, g)],
        Phase::Droplets { diameter } => {
            let Droplets { g_hg, g_d, alpha, w_d } = droplets(diameter);
            let draine = Lobe::henyey_greenstein(g_d, w_d).times_mu_squared(alpha, g_d);
            vec![Lobe::henyey_greenstein(g_hg, 1.0 - w_d), draine]
        }
        Phase::Measured(table) => vec![Lobe::henyey_greenstein(table.mean(|mu| mu).clamp(-0.999, 0.999), 1.0)],
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

    fn all() -> Vec<Phase> {
        let mut all = vec![Phase::Isotropic, Phase::Rayleigh];
        all.extend([5.0, 8.0, 20.0, 50.0].map(|diameter| Phase::Droplets { diameter }));
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

    /// Against Mie's series for water droplets (refractive index 1.334, 0.55 µm, gamma distribution of effective variance
    /// 0.1): the mean cosine is met within 0.02 over the whole range, as the fit is of peaks without rings.
    #[test]
    fn droplets_have_the_mean_cosine_of_water() {
        for (diameter, mie) in
            [(5.0, 0.8241), (8.0, 0.8434), (10.0, 0.8481), (20.0, 0.8632), (35.0, 0.8709), (50.0, 0.8748)]
        {
            let mean = mean(&Phase::Droplets { diameter }, |mu| mu);
            assert!((mean - mie).abs() < 0.02, "{diameter}: {mean} {mie}");
            // the closed form of the two lobes
            let Droplets { g_hg, g_d, alpha, w_d } = droplets(diameter);
            let draine =
                g_d * (1.0 + alpha * (3.0 + 2.0 * g_d * g_d) / 5.0) / (1.0 + alpha * (1.0 + 2.0 * g_d * g_d) / 3.0);
            assert!((mean - (1.0 - w_d) * g_hg - w_d * draine).abs() < 1e-9);
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
