//! The thesis' tables J and J_k, and Biri's Γ_L, texel by texel.

use std::collections::BTreeMap;
use std::f64::consts::FRAC_PI_2;

use tyndall_plugin::{Outputs, ReferenceInput};
use tyndall_shaders::surface_table;

/// T at the last column.
pub(super) const TABLE_DEPTH: f64 = 10.0;

/// J of the scene's phase function.
pub(crate) fn j(input: &ReferenceInput<'_>) -> Outputs {
    let kind = input.scene()?.medium.phase;
    let cosines = input.choice("rows")? == "cosines";
    texels(input, cosines, |n, depth, angle| [surface_table::j(&kind, n, depth, angle)])
}

/// J_0 to J_3, one to a channel.
pub(crate) fn j_k(input: &ReferenceInput<'_>) -> Outputs {
    texels(input, false, surface_table::j_k)
}

/// Rows are even in the angle, to 90°, or in its cosine, from −1.
fn texels<const N: usize>(
    input: &ReferenceInput<'_>,
    cosines: bool,
    value: impl Fn(f64, f64, f64) -> [f64; N] + Sync,
) -> Outputs {
    let [width, height] = input.size("table")?;
    let n = match input.choice("lobe")? {
        "phong" => input.scene()?.shininesses.first().copied().unwrap_or(1.0),
        _ => 1.0,
    };
    let angle = |share: f64| if cosines { (2.0 * share - 1.0).acos() } else { FRAC_PI_2 * share };
    let table = input.texels("table", |[x, y, _]| {
        value(n, TABLE_DEPTH * share(x, width), angle(share(y, height))).map(|number| number as f32)
    })?;
    Ok(BTreeMap::from([("table", table.concat().into())]))
}

/// Where a texel of a row lies, from 0 at the first to 1 at the last.
fn share(at: u32, count: u32) -> f64 {
    f64::from(at) / f64::from(count - 1)
}

/// Biri's Γ_L, with the degrees of its clamped form.
pub(crate) fn gamma_l(input: &ReferenceInput<'_>) -> Outputs {
    let (kind, [width, _]) = (input.scene()?.medium.phase, input.size("table")?);
    let table = input.texels("table", |[x, _, _]| {
        surface_table::gamma_l(&kind, TABLE_DEPTH * share(x, width)).map(|number| number as f32)
    })?;
    Ok(BTreeMap::from([("table", table.concat().into())]))
}
