//! The light around a point, and its zonal coefficients: see `zonal.wgsl`.

use std::collections::BTreeMap;
use std::f64::consts::PI;

use tyndall_plugin::{Outputs, ReferenceInput, each_texel};
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
    let ([nodes, rows], [degrees, _]) = (input.size("glow")?, input.size("coefficients")?);
    let at = scattering(&input.scene()?.medium.phase);
    let glow = each_texel([nodes, rows, 1], |[node, row, _]| {
        let gamma = angle_of(node);
        if row + 1 < rows {
            let depth = depth_at(f64::from(row), f64::from(rows - 2));
            depth.exp() * glow_of(&at, depth, gamma)
        } else {
            at((gamma / 2.0).sin().powi(2)) * gamma.sin()
        }
    });
    let coefficients = each_texel([1, rows, 1], |[_, row, _]| {
        coefficients(&glow[(row * nodes) as usize..][..nodes as usize], degrees as usize)
    });
    let numbers = |values: Vec<f64>| values.into_iter().map(|value| value as f32).collect();
    Ok(BTreeMap::from([("glow", numbers(glow)), ("coefficients", numbers(coefficients.concat()))]))
}

/// gamma of a node.
fn angle_of(node: u32) -> f64 {
    2.0 * (FIRST_NODE + NODE_STEP * f64::from(node)).exp().atan()
}

/// The zonal coefficients of a row of the glow.
fn coefficients(glow: &[f64], degrees: usize) -> Vec<f64> {
    let mut sums = vec![0.0; degrees];
    for (node, value) in (0..).zip(glow) {
        let gamma = angle_of(node);
        // The first node stands for all that is nearer to the light.
        let first = if node == 0 { 2.0 * (gamma / 2.0).tan() * (-0.5 * NODE_STEP).exp() } else { 0.0 };
        let weight = 2.0 * PI * value * (NODE_STEP * gamma.sin() + first);
        let mut polynomials = (0.0, 1.0);
        for (degree, sum) in sums.iter_mut().enumerate() {
            *sum += weight * polynomials.1;
            let l = degree as f64;
            let next = ((2.0 * l + 1.0) * gamma.cos() * polynomials.1 - l * polynomials.0) / (l + 1.0);
            polynomials = (polynomials.1, next);
        }
    }
    sums
}

/// The phase function at w, without lobes that the nodes do not see.
fn scattering(kind: &Phase) -> Box<dyn Fn(f64) -> f64 + Sync> {
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
