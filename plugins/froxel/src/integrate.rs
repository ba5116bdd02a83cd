//! What reaches the eye from all slices up to each one, in double precision: twin of `integrate.wgsl`.

use std::collections::BTreeMap;

use glam::DVec3;
use tyndall_plugin::{Outputs, ReferenceInput, rgba};
use tyndall_shaders::scene::Medium;

use crate::grid::{Grid, froxel};

/// Both ports of `froxel.integrate`.
pub(crate) fn reference(input: &ReferenceInput<'_>) -> Outputs {
    let (scattered, medium) = (input.input("scattered")?, &input.scene()?.medium);
    let grid = Grid::read(input.input("grid")?, scattered)?;
    let columns = || (0..scattered.height()).flat_map(|y| (0..scattered.width()).map(move |x| [x, y].map(i64::from)));
    let mut sums = vec![DVec3::ZERO; columns().count()];
    let mut accumulated = Vec::new();
    for slice in 0..grid.slices {
        let seen = seen(medium, grid.border(slice), grid.border(slice + 1));
        for (sum, column) in sums.iter_mut().zip(columns()) {
            *sum += froxel(scattered, column, slice) * seen;
            accumulated.push(*sum);
        }
    }
    Ok(BTreeMap::from([("accumulated", rgba(accumulated)), ("whole", rgba(sums))]))
}

/// Of light that is scattered evenly between two distances, how many metres of it reach the eye: the integral of
/// e^(−σ_t·x).
fn seen(medium: &Medium, near: f64, far: f64) -> DVec3 {
    let channel = |extinction: f64| match extinction {
        0.0 => far - near,
        _ => (-extinction * near).exp() * -(-extinction * (far - near)).exp_m1() / extinction,
    };
    DVec3::from_array(medium.extinction.to_array().map(channel))
}
