//! The tables H and H_k, texel by texel.

use std::collections::BTreeMap;
use std::f64::consts::PI;

use tyndall_plugin::{Outputs, ReferenceInput};
use tyndall_shaders::airlight_table;

/// u at the last column.
pub(super) const TABLE_DEPTH: f64 = 10.0;

/// H of the scene's phase function.
pub(crate) fn h(input: &ReferenceInput<'_>) -> Outputs {
    let kind = input.scene()?.medium.phase;
    texels(input, |u, theta| [airlight_table::h(&kind, u, theta)])
}

/// H_0 to H_3, one to a channel.
pub(crate) fn h_k(input: &ReferenceInput<'_>) -> Outputs {
    texels(input, airlight_table::h_k)
}

fn texels<const N: usize>(input: &ReferenceInput<'_>, value: impl Fn(f64, f64) -> [f64; N] + Sync) -> Outputs {
    let [width, height] = input.size("table")?;
    let share = |at: u32, count: u32| f64::from(at) / f64::from(count - 1);
    let table = input.texels("table", |[x, y, _]| {
        value(TABLE_DEPTH * share(x, width), PI * (share(y, height) - 0.5)).map(|number| number as f32)
    })?;
    Ok(BTreeMap::from([("table", table.concat().into())]))
}
