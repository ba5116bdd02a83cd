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
    texels(input, |u, theta| vec![airlight_table::h(&kind, u, theta)])
}

/// H_0 to H_3, one to a channel.
pub(crate) fn h_k(input: &ReferenceInput<'_>) -> Outputs {
    texels(input, |u, theta| airlight_table::h_k(u, theta).to_vec())
}

fn texels(input: &ReferenceInput<'_>, value: impl Fn(f64, f64) -> Vec<f64>) -> Outputs {
    let size = input.size("table")?;
    let share = |at: u32, count: u32| f64::from(at) / f64::from(count - 1);
    let mut table = Vec::new();
    for y in 0..size[1] {
        for x in 0..size[0] {
            let (u, theta) = (TABLE_DEPTH * share(x, size[0]), PI * (share(y, size[1]) - 0.5));
            table.extend(value(u, theta).into_iter().map(|value| value as f32));
        }
    }
    Ok(BTreeMap::from([("table", table.into())]))
}
