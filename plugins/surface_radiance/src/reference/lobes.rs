//! The light around a point, summed over lobes: the sums of `lobes.wgsl` in double precision, over the glow and the
//! coefficients that the pass was given.

use std::collections::BTreeMap;
use std::f64::consts::PI;

use tyndall_plugin::scene::Scene;
use tyndall_plugin::{Outputs, PortData, ReferenceInput, each_texel};

use crate::cosine_lobes::{self, CosineLobes};

use super::around::{FIRST_NODE, NODE_STEP};

/// The largest shininess that zonal coefficients are used for.
const ZONAL_MOST: f64 = 30.0;
const AZIMUTHS: u32 = 16;
const ACROSS_HALF: i32 = 40;
const ACROSS_STEP: f64 = 0.16;
const REACH_EXPONENT: f64 = 18.0;

/// A lobe in double precision.
#[derive(Clone, Copy)]
pub(super) struct Lobe {
    pub exponent: f64,
    pub cos_cutoff: f64,
    pub is_spot: bool,
}

/// Lambert's.
const LAMBERT: Lobe = Lobe { exponent: 1.0, cos_cutoff: 0.0, is_spot: false };

/// Those of the table's layers, Lambert's first.
pub(super) fn lobes_of(scene: &Scene) -> Vec<Lobe> {
    let lobe = |lobe: &cosine_lobes::CosineLobe| Lobe {
        exponent: f64::from(lobe.exponent),
        cos_cutoff: f64::from(lobe.cos_cutoff),
        is_spot: lobe.is_spot != 0,
    };
    std::iter::once(LAMBERT).chain(CosineLobes::of(scene).items.iter().map(lobe)).collect()
}

/// How angles stand in a layer: `toward·log2(1 + u·factor) + away·u⁴`, u = sin(θ/2).
pub(super) struct AngleAxis {
    factor: f64,
    cells: f64,
}

impl AngleAxis {
    /// Of a lobe n that ends where the cosine is `cos_cutoff`, in so many cells.
    pub fn new(n: f64, cos_cutoff: f64, cells: u32) -> Self {
        let width = n.max(1.0).powf(-0.5).min((0.5 - 0.5 * cos_cutoff).sqrt()).max(1e-3);
        Self { factor: 1.0 / width, cells: f64::from(cells) }
    }

    /// The coordinate of an angle, 0 to the number of cells.
    pub fn coordinate(&self, sine_of_half: f64) -> f64 {
        let near = (1.0 + sine_of_half * self.factor).ln() / (1.0 + self.factor).ln();
        0.5 * self.cells * (near + sine_of_half.powi(4))
    }

    fn angle_at(&self, coordinate: f64) -> f64 {
        let (mut low, mut width) = (0.0, 1.0);
        for _ in 0..50 {
            width *= 0.5;
            if self.coordinate(low + width) <= coordinate {
                low += width;
            }
        }
        2.0 * low.asin()
    }
}

/// Every layer of the table.
pub(crate) fn lobes(input: &ReferenceInput<'_>) -> Outputs {
    let (glow, coefficients) = (input.input("glow")?, input.input("coefficients")?);
    let ([width, height, layers], lobes) = (input.extent("table")?, lobes_of(input.moment()?.scene));
    // Of the edges between columns, of which there is one more.
    let columns = each_texel([width + 1, 1, lobes.len() as u32], |[x, _, layer]| {
        let lobe = &lobes[layer as usize];
        let axis = AngleAxis::new(lobe.exponent, if lobe.is_spot { lobe.cos_cutoff } else { -1.0 }, width);
        over_lobe(lobe, axis.angle_at(f64::from(x)), glow, coefficients)
    });
    let table = each_texel([width, height, layers], |[x, y, layer]| {
        // The last row is a directional light's.
        let rows = if y + 1 == height { [height; 2] } else { [y, y + 1] };
        let edge = |column: u32, row: u32| {
            columns.get((layer * (width + 1) + column) as usize).map_or(0.0, |column| column[row as usize] as f32)
        };
        [edge(x, rows[0]), edge(x + 1, rows[0]), edge(x, rows[1]), edge(x + 1, rows[1])]
    });
    Ok(BTreeMap::from([("table", table.concat().into())]))
}

/// Of each row of the glow.
fn over_lobe(lobe: &Lobe, theta: f64, glow: &PortData, coefficients: &PortData) -> Vec<f64> {
    let nodes = across(lobe, theta, glow.width());
    let value = |row: u32| {
        let sum = if lobe.exponent <= ZONAL_MOST && !lobe.is_spot {
            zonal_sum(lobe.exponent, theta, |l| coefficients.texel([l, row, 0])[0], coefficients.width())
        } else {
            nodes.iter().map(|(at, weight)| weight * cubic(*at, |node| glow.texel([node, row, 0])[0])).sum()
        };
        let unit = if lobe.is_spot { coefficients.texel([0, row, 0])[0] } else { 2.0 * PI / (lobe.exponent + 1.0) };
        (sum / unit).max(0.0)
    };
    (0..glow.height()).map(value).collect()
}

/// Σ (2l + 1)/(4π)·F_l·K_l·P_l(cos θ), with K_(l+2) = K_l (n − l)/(n + l + 3).
fn zonal_sum(n: f64, theta: f64, coefficient: impl Fn(u32) -> f64, terms: u32) -> f64 {
    let (mut p, mut k) = ([0.0, 1.0], [2.0 * PI / (n + 1.0), 2.0 * PI / (n + 2.0)]);
    let mut sum = 0.0;
    for l in 0..terms {
        let degree = f64::from(l);
        sum += (2.0 * degree + 1.0) / (4.0 * PI) * k[0] * p[1] * coefficient(l);
        p = [p[1], ((2.0 * degree + 1.0) * theta.cos() * p[1] - degree * p[0]) / (degree + 1.0)];
        k = [k[1], k[0] * (n - degree) / (n + degree + 3.0)];
    }
    sum
}

/// Places among the nodes of the glow across a lobe, each with its weight.
fn across(lobe: &Lobe, theta: f64, nodes: u32) -> Vec<(f64, f64)> {
    let least = (-REACH_EXPONENT / lobe.exponent.max(1e-3)).exp().max(lobe.cos_cutoff);
    let reach = if lobe.exponent == 0.0 { lobe.cos_cutoff } else { least }.acos();
    let low = (theta - reach).max(0.0);
    let width = (theta + reach).min(PI) - low;
    let node = |step: i32| {
        let s = ACROSS_STEP * f64::from(step);
        let share = 0.5 * (1.0 + s.tanh());
        let gamma = (low + width * share).clamp(1e-7, PI - 1e-6);
        let sought = ((0.5 * gamma).tan().ln() - FIRST_NODE) / NODE_STEP;
        let at = sought.clamp(1.0, f64::from(nodes) - 3.0);
        let beyond = (-NODE_STEP * (sought - at).max(0.0)).exp();
        let change = 0.5 / (s.cosh() * s.cosh());
        (at, azimuthal_sum(lobe, theta, gamma) * change * width * ACROSS_STEP * beyond)
    };
    (-ACROSS_HALF..=ACROSS_HALF).map(node).collect()
}

/// The lobe around the way to the light.
fn azimuthal_sum(lobe: &Lobe, theta: f64, gamma: f64) -> f64 {
    let n = lobe.exponent;
    let nearest = 2.0 * (0.5 * (gamma - theta)).sin().powi(2);
    let swing = 2.0 * (gamma.sin() * theta.sin()).max(0.0);
    let width = (1.0 + 0.5 * n * swing / (1.0 - nearest).max(0.05)).powf(-0.5);
    let edge = ((1.0 - lobe.cos_cutoff - nearest) / swing.max(1e-20)).clamp(0.0, 1.0);
    let end = edge.sqrt().atan2(width * (1.0 - edge).sqrt());
    let value = |i: u32| {
        let t = (end / f64::from(AZIMUTHS) * (f64::from(i) + 0.5)).tan();
        let q = 1.0 / (1.0 + (width * t).powi(2));
        let cosine = 1.0 - nearest - swing * (width * t).powi(2) * q;
        let power = if n == 0.0 { 1.0 } else { cosine.max(0.0).powf(n) };
        power * q * (1.0 + t * t)
    };
    4.0 * end * width / f64::from(AZIMUTHS) * (0..AZIMUTHS).map(value).sum::<f64>()
}

/// Lagrange's cubic through the four nodes around a place.
fn cubic(at: f64, value: impl Fn(u32) -> f64) -> f64 {
    let x = at - at.floor();
    let first = at.floor() as u32 - 1;
    let places = [-1.0, 0.0, 1.0, 2.0];
    let term = |i: usize| {
        let others = places.iter().enumerate().filter(|(j, _)| *j != i);
        let weight: f64 = others.map(|(_, place)| (x - place) / (places[i] - place)).product();
        weight * value(first + i as u32)
    };
    (0..4).map(term).sum()
}
