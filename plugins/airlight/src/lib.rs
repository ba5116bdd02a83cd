//! The plugin `airlight`: light that a medium scatters once toward the eye.

mod reference;

use tyndall_plugin::{Plugin, folder};

/// The plugin.
pub fn plugin() -> Plugin {
    Plugin::new("airlight", folder!("airlight": "plugin.ron", "homogeneous.wgsl"))
        .reference("airlight.homogeneous", reference::homogeneous)
}
