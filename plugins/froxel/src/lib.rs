//! The plugin `froxel`: airlight in a grid over the view frustum, as game engines do it, to compare with.

mod airlight;
pub mod grid;
mod integrate;
mod scatter;

use tyndall_plugin::{Plugin, folder};

/// The plugin.
pub fn plugin() -> Plugin {
    let files = folder!("froxel": "plugin.ron", "grid.wgsl", "scatter.wgsl", "integrate.wgsl", "airlight.wgsl");
    Plugin::new("froxel", files)
        .reference("froxel.airlight", airlight::reference)
        .reference("froxel.integrate", integrate::reference)
        .reference("froxel.scatter", scatter::reference)
}
