//! The plugin `froxel`: airlight in a grid over the view frustum, as game engines do it, to compare with.

use tyndall_plugin::{Plugin, folder};

/// The plugin.
pub fn plugin() -> Plugin {
    Plugin::new(
        "froxel",
        folder!("froxel": "plugin.ron", "grid.wgsl", "scatter.wgsl", "integrate.wgsl", "airlight.wgsl"),
    )
}
