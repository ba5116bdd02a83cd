//! The plugin `surface_radiance`: light that surfaces reflect toward the eye through a medium.

use tyndall_plugin::{Plugin, folder};

/// The plugin.
pub fn plugin() -> Plugin {
    let files = folder!("surface_radiance": "plugin.ron", "lobes.wgsl", "phong.wgsl", "zonal.wgsl");
    Plugin::new("surface_radiance", files)
}
