//! The phase functions that a scene file can name, one row each: its parameters, its value in double precision, and the
//! lobes by which shaders know it. A row is all that a phase function takes; the scene file's reader, the encoder and the
//! tests go through [`PHASE_FUNCTIONS`].
//!
//! `w` is sin² of half the scattering angle, µ = 1 − 2w its cosine, 1 forward.

use std::f64::consts::PI;

use crate::phase::Lobe;
use crate::phase_table::PhaseTable;

/// What a scene file can say of a phase function that has no table.
#[derive(Debug)]
pub struct PhaseFunction {
    /// In the scene file.
    pub name: &'static str,
    /// Its parameters, in the order in which they may be given without their names.
    pub parameters: &'static [Parameter],
    /// Makes it, of a value for each of its parameters; every one is asked for, also behind one that has none.
    pub make: fn(&mut ValueOf<'_>) -> Option<Phase>,
}

/// Gives a parameter its value, if it has one.
pub type ValueOf<'a> = dyn FnMut(&Parameter) -> Option<f64> + 'a;

/// A number that belongs to a phase function.
#[derive(Debug)]
pub struct Parameter {
    /// In the scene file.
    pub name: &'static str,
    /// What it may be.
    pub range: Interval,
}

/// An interval of numbers.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Interval {
    /// Without its ends.
    Open(f64, f64),
    /// With its ends.
    Closed(f64, f64),
}

use Interval::{Closed, Open};

/// Makes `Phase`, `PHASE_FUNCTIONS`, `phase` and `lobes` of rows.
macro_rules! phase_functions {
    ($(
        $(#[$about:meta])*
        $name:ident $({ $($(#[$parameter_about:meta])* $parameter:ident: $range:expr,)* })?
        at |$w:pat_param| $at:expr;
        lobes $lobes:expr;
    )*) => {
        /// A phase function: how a scattering event spreads light over directions.
        #[derive(Debug, Clone, Copy, PartialEq, Default)]
        pub enum Phase {
            $($(#[$about])* $name $({ $($(#[$parameter_about])* $parameter: f64,)* })?,)*
            /// A table. Tables live as long as the process, one of each content, so that a phase function is a plain value.
            Measured(&'static PhaseTable),
        }

        /// Every phase function that has no table, in the order in which messages name them.
        pub const PHASE_FUNCTIONS: &[PhaseFunction] = &[$(PhaseFunction {
            name: stringify!($name),
            parameters: &[$($(Parameter { name: stringify!($parameter), range: $range },)*)?],
            make: |_value| {
                $($(let $parameter = _value(&Parameter { name: stringify!($parameter), range: $range });)*)?
                Some(Phase::$name $({ $($parameter: $parameter?,)* })?)
            },
        },)*];

        /// The share of scattered light that goes into a direction, 1/sr.
        pub fn phase(phase: &Phase, w: f64) -> f64 {
            match *phase {
                $(Phase::$name $({ $($parameter,)* })? => {
                    let $w = w;
                    $at
                })*
                Phase::Measured(table) => table.at(2.0 * w.max(0.0).sqrt().atan2((1.0 - w).max(0.0).sqrt())),
            }
        }

        /// The lobes of a phase function, one or two. A measured one has none of its own: what is given for it has its mean
        /// cosine, and says only about how wide it is.
        pub fn lobes(phase: &Phase) -> Vec<Lobe> {
            match *phase {
                $(Phase::$name $({ $($parameter,)* })? => Vec::from($lobes),)*
                Phase::Measured(table) => {
                    vec![Lobe::henyey_greenstein(table.mean(|mu| mu).clamp(-0.999, 0.999), 1.0)]
                }
            }
        }
    };
}

phase_functions! {
    /// The same everywhere: 1/(4π).
    #[default]
    Isotropic
    at |_| 1.0 / (4.0 * PI);
    lobes [Lobe::henyey_greenstein(0.0, 1.0)];

    /// Henyey and Greenstein 1941, eq. 2: (1 − g²)/(4π (1 + g² − 2gµ)^(3/2)).
    HenyeyGreenstein {
        /// Mean cosine, above 0 forward.
        g: Open(-1.0, 1.0),
    }
    at |w| henyey_greenstein(g, w);
    lobes [Lobe::henyey_greenstein(g, 1.0)];

    /// Two of Henyey and Greenstein's.
    DoubleHenyeyGreenstein {
        /// Mean cosine of the first.
        g1: Open(-1.0, 1.0),
        /// Mean cosine of the second.
        g2: Open(-1.0, 1.0),
        /// Weight of the second.
        f: Closed(0.0, 1.0),
    }
    at |w| (1.0 - f) * henyey_greenstein(g1, w) + f * henyey_greenstein(g2, w);
    lobes [Lobe::henyey_greenstein(g1, 1.0 - f), Lobe::henyey_greenstein(g2, f)];

    /// Blasi, Le Saëc and Schlick 1993, eq. 3, with k above 0 forward: (1 − k²)/(4π (1 − kµ)²).
    Schlick {
        /// Above 0 forward.
        k: Open(-1.0, 1.0),
    }
    // 1 - k mu = 1 - k + 2 k w
    at |w| (1.0 - k) * (1.0 + k) / (4.0 * PI * (1.0 - k + 2.0 * k * w).powi(2));
    lobes [Lobe::schlick(k)];

    /// Molecules: 3 (1 + µ²)/(16π).
    Rayleigh
    at |w| 3.0 / (16.0 * PI) * (1.0 + mu(w) * mu(w));
    lobes [Lobe::henyey_greenstein(0.0, 1.0).times_mu_squared(1.0, 0.0)];

    /// Cornette and Shanks 1992, eq. 8: Henyey and Greenstein's times 3 (1 + µ²)/(2 (2 + g²)).
    CornetteShanks {
        /// Their g, which is not the mean cosine.
        g: Open(-1.0, 1.0),
    }
    at |w| henyey_greenstein(g, w) * 1.5 * (1.0 + mu(w) * mu(w)) / (2.0 + g * g);
    lobes [Lobe::henyey_greenstein(g, 1.0).times_mu_squared(1.0, g)];

    /// Water droplets of fog and clouds: Henyey and Greenstein's function and Draine's (Jendersie and d'Eon 2023).
    Droplets {
        /// Diameter, µm, for which they give the fit.
        diameter: Closed(5.0, 50.0),
    }
    at |w| droplets(diameter).at(w);
    lobes droplets(diameter).lobes();
}

fn mu(w: f64) -> f64 {
    1.0 - 2.0 * w
}

/// 1 + g² − 2gµ = (1 − g)² + 4gw, which does not cancel near µ = 1.
fn henyey_greenstein(g: f64, w: f64) -> f64 {
    let q = (1.0 - g).powi(2) + 4.0 * g * w;
    (1.0 - g) * (1.0 + g) / (4.0 * PI * q * q.sqrt())
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

impl Droplets {
    fn at(&self, w: f64) -> f64 {
        let Self { g_hg, g_d, alpha, w_d } = self;
        let shape = (1.0 + alpha * mu(w) * mu(w)) / (1.0 + alpha * (1.0 + 2.0 * g_d * g_d) / 3.0);
        (1.0 - w_d) * henyey_greenstein(*g_hg, w) + w_d * henyey_greenstein(*g_d, w) * shape
    }

    fn lobes(&self) -> [Lobe; 2] {
        let draine = Lobe::henyey_greenstein(self.g_d, self.w_d).times_mu_squared(self.alpha, self.g_d);
        [Lobe::henyey_greenstein(self.g_hg, 1.0 - self.w_d), draine]
    }
}

impl Interval {
    /// The number at a share of the way from its low end, 0, to its high end, 1; a little inside of ends that are left out.
    pub fn at(self, share: f64) -> f64 {
        match self {
            Open(low, high) => low + (high - low) * share.clamp(1e-6, 1.0 - 1e-6),
            Closed(low, high) => low + (high - low) * share,
        }
    }

    /// Whether a number lies in it.
    pub fn holds(self, value: f64) -> bool {
        match self {
            Open(low, high) => value > low && value < high,
            Closed(low, high) => (low..=high).contains(&value),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::phase::mean;

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

    #[test]
    fn each_takes_its_parameters_in_order() {
        for function in PHASE_FUNCTIONS {
            let mut asked = Vec::new();
            let none = (function.make)(&mut |parameter| {
                asked.push((parameter.name, parameter.range));
                None
            });
            let parameters: Vec<_> = function.parameters.iter().map(|p| (p.name, p.range)).collect();
            assert_eq!((asked, none.is_none()), (parameters, !function.parameters.is_empty()), "{}", function.name);
        }
        let double = PHASE_FUNCTIONS.iter().find(|function| function.name == "DoubleHenyeyGreenstein");
        let mut values = [0.5, -0.25, 0.125].into_iter();
        let made = double.and_then(|double| (double.make)(&mut |_| values.next()));
        assert_eq!(made, Some(Phase::DoubleHenyeyGreenstein { g1: 0.5, g2: -0.25, f: 0.125 }));
    }

    #[test]
    fn intervals() {
        assert!(Open(-1.0, 1.0).holds(0.999) && !Open(-1.0, 1.0).holds(1.0) && !Open(-1.0, 1.0).holds(f64::NAN));
        assert!(Closed(0.0, 1.0).holds(1.0) && !Closed(0.0, 1.0).holds(1.1));
        assert!(Open(-1.0, 1.0).holds(Open(-1.0, 1.0).at(0.0)) && Closed(2.0, 4.0).at(0.5) == 3.0);
    }
}
