//! The plugin `surface_radiance`: light that surfaces reflect toward the eye through a medium.

mod reference;

use tyndall_plugin::{Plugin, folder};

/// The plugin.
pub fn plugin() -> Plugin {
    Plugin::new("surface_radiance", folder!("surface_radiance": "plugin.ron", "phong.wgsl"))
        .reference("surface_radiance.phong", reference::phong)
}
