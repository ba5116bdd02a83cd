//! The thesis' tables J and J_k, texel by texel.

use std::collections::BTreeMap;
use std::f64::consts::FRAC_PI_2;

use tyndall_plugin::{Outputs, ReferenceInput};
use tyndall_shaders::surface_table;

/// T at the last column.
pub(super) const TABLE_DEPTH: f64 = 10.0;

/// J of the scene's phase function.
pub(crate) fn j(input: &ReferenceInput<'_>) -> Outputs {
    let kind = input.scene()?.medium.phase;
    texels(input, |n, depth, angle| [surface_table::j(&kind, n, depth, angle)])
}

/// J_0 to J_3, one to a channel.
pub(crate) fn j_k(input: &ReferenceInput<'_>) -> Outputs {
    texels(input, surface_table::j_k)
}

fn texels<const N: usize>(input: &ReferenceInput<'_>, value: impl Fn(f64, f64, f64) -> [f64; N] + Sync) -> Outputs {
    let [width, height] = input.size("table")?;
    let n = match input.choice("lobe")? {
        "phong" => input.scene()?.shininesses.first().copied().unwrap_or(1.0),
        _ => 1.0,
    };
    let share = |at: u32, count: u32| f64::from(at) / f64::from(count - 1);
    let table = input.texels("table", |[x, y, _]| {
        value(n, TABLE_DEPTH * share(x, width), FRAC_PI_2 * share(y, height)).map(|number| number as f32)
    })?;
    Ok(BTreeMap::from([("table", table.concat().into())]))
}
