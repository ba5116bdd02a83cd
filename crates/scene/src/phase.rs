//! The phase functions a medium can have, and what of them a shader gets.

/// How the medium scatters, by the angle between the way in and the way out; g > 0 is forward.
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub enum Phase {
    /// 1/4π.
    #[default]
    Isotropic,
    /// Henyey and Greenstein with mean cosine g, |g| < 1.
    HenyeyGreenstein {
        /// Mean cosine.
        g: f64,
    },
    /// (1 − f)·HG(g1) + f·HG(g2).
    DoubleHenyeyGreenstein {
        /// Mean cosine of the first lobe.
        g1: f64,
        /// Mean cosine of the second lobe.
        g2: f64,
        /// Weight of the second lobe, 0..1.
        f: f64,
    },
    /// Schlick's approximation, |k| < 1, k > 0 forward.
    Schlick {
        /// Shape.
        k: f64,
    },
    /// 3/(16π)·(1 + cos²θ).
    Rayleigh,
    /// Cornette and Shanks with parameter g, |g| < 1.
    CornetteShanks {
        /// Parameter (not the mean cosine).
        g: f64,
    },
}

/// A phase function as `Medium` of `scene.wgsl` holds it.
pub(crate) struct EncodedPhase {
    pub kind: u32,
    pub g1: f64,
    pub g2: f64,
    pub weight: f64,
    pub rho1: f64,
    pub rho2: f64,
}

impl Phase {
    /// The numbers of `Medium` in `scene.wgsl`; the widths `rho` are worked out here because 1 − g is lost in f32.
    pub(crate) fn encode(self) -> EncodedPhase {
        let width = |g: f64| (1.0 - g) / (1.0 + g);
        let one = |kind, g1, rho1| EncodedPhase { kind, g1, g2: 0.0, weight: 0.0, rho1, rho2: 1.0 };
        match self {
            Phase::Isotropic => one(0, 0.0, 1.0),
            Phase::HenyeyGreenstein { g } => one(1, g, width(g)),
            Phase::DoubleHenyeyGreenstein { g1, g2, f } => {
                EncodedPhase { kind: 2, g1, g2, weight: f, rho1: width(g1), rho2: width(g2) }
            }
            Phase::Schlick { k } => one(3, k, width(k).sqrt()),
            Phase::Rayleigh => one(4, 0.0, 1.0),
            Phase::CornetteShanks { g } => one(5, g, width(g)),
        }
    }
}
