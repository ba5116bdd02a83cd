//! The airlight of each pixel, looked up in the grid, in double precision: twin of `airlight.wgsl`.

use glam::DVec3;
use tyndall_plugin::{Outputs, PortData, ReferenceInput};
use tyndall_shaders::medium::opacity;
use tyndall_shaders::scene::Medium;

use crate::grid::{Grid, froxel};

/// The port of `froxel.airlight`.
pub(crate) fn reference(input: &ReferenceInput<'_>) -> Outputs {
    let (accumulated, medium) = (input.input("accumulated")?, &input.scene()?.medium);
    let (grid, size) = (Grid::read(input.input("grid")?, accumulated)?, input.size("radiance")?);
    input.view("radiance", |at| pixel(accumulated, medium, &grid, (at.at, size), at.distance.min(grid.far)))
}

/// Linear between the centres of the four nearest columns.
fn pixel(accumulated: &PortData, medium: &Medium, grid: &Grid, at: ([u32; 2], [u32; 2]), way: f64) -> DVec3 {
    let columns = [accumulated.width(), accumulated.height()];
    let place: [f64; 2] = std::array::from_fn(|axis| {
        (f64::from(at.0[axis]) + 0.5) / f64::from(at.1[axis]) * f64::from(columns[axis]) - 0.5
    });
    let [left, top] = place.map(f64::floor);
    let (right, down) = (place[0] - left, place[1] - top);
    let corners = [(0, 0, (1.0 - right) * (1.0 - down)), (1, 0, right * (1.0 - down)), (0, 1, (1.0 - right) * down)];
    let weighted = corners
        .into_iter()
        .chain([(1, 1, right * down)])
        .map(|(x, y, weight)| weight * in_column(accumulated, medium, grid, [left as i64 + x, top as i64 + y], way));
    weighted.sum()
}

/// What reaches the eye of a column up to a distance: light that is scattered evenly within the slice there.
fn in_column(accumulated: &PortData, medium: &Medium, grid: &Grid, column: [i64; 2], way: f64) -> DVec3 {
    let slice = grid.slice(way);
    let (start, end) = (grid.border(slice), grid.border(slice + 1));
    let before = if slice == 0 { DVec3::ZERO } else { froxel(accumulated, column, slice - 1) };
    let with_slice = froxel(accumulated, column, slice);
    let (part, all) = (opacity(medium, way - start), opacity(medium, end - start));
    // Without extinction nothing is scattered, so any share will do.
    let share = |channel: usize| if all[channel] == 0.0 { 0.0 } else { part[channel] / all[channel] };
    before + (with_slice - before) * DVec3::from_array(std::array::from_fn(share))
}
