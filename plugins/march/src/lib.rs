//! The plugin `march`: the same light by brute force, to compare with.

mod reference;

use tyndall_plugin::{Plugin, folder};

/// The plugin.
pub fn plugin() -> Plugin {
    Plugin::new("march", folder!("march": "plugin.ron", "airlight.wgsl", "shadow_map.wgsl", "surface_shadows.wgsl"))
        .reference("march.airlight", reference::airlight)
        .reference("march.shadow_map", reference::shadow_map)
}
