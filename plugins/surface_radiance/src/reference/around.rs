//! The light around a point, and its zonal coefficients: see `zonal.wgsl`.

use std::collections::BTreeMap;
use std::f64::consts::PI;

use tyndall_plugin::{Outputs, ReferenceInput};
use tyndall_shaders::phase::{Lobe, lobes, phase};
use tyndall_shaders::reflection::glow_of;
use tyndall_shaders::scene::Phase;

/// Nodes of ln tan(gamma/2): the first, and from one to the next.
pub(super) const FIRST_NODE: f64 = -12.5;
pub(super) const NODE_STEP: f64 = 0.075;

/// Depths are spaced evenly below the first and in equal ratios above it.
const FIRST_DEPTH: f64 = 0.02;
const LAST_DEPTH: f64 = 40.0;

/// Lobes narrower than these count as so wide, and scatter as much.
const NARROWEST: f64 = 5e-5;
const NARROWEST_BACKWARD: f64 = 300.0;

/// T of the row `row` of cells.
fn depth_at(row: f64, cells: f64) -> f64 {
    FIRST_DEPTH * ((1.0 + LAST_DEPTH / FIRST_DEPTH).powf(row / cells) - 1.0)
}

/// The row of cells at which T stands.
pub(super) fn row_of(depth: f64, cells: f64) -> f64 {
    (depth.min(LAST_DEPTH) / FIRST_DEPTH).ln_1p() / (LAST_DEPTH / FIRST_DEPTH).ln_1p() * cells
}

/// The glow by the twin's sum, which is far finer than the pass's, and its coefficients by a sum over its nodes.
pub(crate) fn zonal(input: &ReferenceInput<'_>) -> Outputs {
    let kind = input.scene()?.medium.phase;
    let ([nodes, rows], [degrees, _]) = (input.size("glow")?, input.size("coefficients")?);
    let at = scattering(&kind);
    let (mut glow, mut coefficients) = (Vec::new(), Vec::new());
    for row in 0..rows {
        let depth = (row + 1 < rows).then(|| depth_at(f64::from(row), f64::from(rows - 2)));
        let mut sums = vec![0.0; degrees as usize];
        for node in 0..nodes {
            let a = (FIRST_NODE + NODE_STEP * f64::from(node)).exp();
            let gamma = 2.0 * a.atan();
            let value = match depth {
                Some(depth) => depth.exp() * glow_of(&at, depth, gamma),
                None => at((gamma / 2.0).sin().powi(2)) * gamma.sin(),
            };
            // The first node stands for all that is nearer to the light.
            let first = if node == 0 { 2.0 * a * (-0.5 * NODE_STEP).exp() } else { 0.0 };
            let weight = 2.0 * PI * value * (NODE_STEP * gamma.sin() + first);
            let mut polynomials = (0.0, 1.0);
            for (degree, sum) in sums.iter_mut().enumerate() {
                *sum += weight * polynomials.1;
                let l = degree as f64;
                let next = ((2.0 * l + 1.0) * gamma.cos() * polynomials.1 - l * polynomials.0) / (l + 1.0);
                polynomials = (polynomials.1, next);
            }
            glow.push(value as f32);
        }
        coefficients.extend(sums.into_iter().map(|sum| sum as f32));
    }
    Ok(BTreeMap::from([("glow", glow.into()), ("coefficients", coefficients.into())]))
}

/// The phase function at w, without lobes that the nodes do not see.
fn scattering(kind: &Phase) -> Box<dyn Fn(f64) -> f64> {
    let lobes = lobes(kind);
    if matches!(kind, Phase::Measured(_)) || lobes.iter().all(|lobe| widened(lobe) == *lobe) {
        let kind = *kind;
        return Box::new(move |w| phase(&kind, w));
    }
    let lobes: Vec<Lobe> = lobes.iter().map(widened).collect();
    Box::new(move |w| lobes.iter().map(|lobe| lobe.at(w)).sum())
}

/// Its integral is the scale over rho (1 + rho), or over rho² (Schlick).
fn widened(lobe: &Lobe) -> Lobe {
    let rho = lobe.rho.clamp(NARROWEST, NARROWEST_BACKWARD);
    let integral = |rho: f64| if lobe.squared { 1.0 / (rho * rho) } else { 1.0 / (rho * (1.0 + rho)) };
    Lobe { rho, scale: lobe.scale * integral(lobe.rho) / integral(rho), ..*lobe }
}
