//! The plugin `airlight`: light that a medium scatters once toward the eye.

use tyndall_plugin::{Plugin, folder};

/// The plugin.
pub fn plugin() -> Plugin {
    Plugin::new(
        "airlight",
        folder!("airlight": "plugin.ron", "h.wgsl", "h_k.wgsl", "homogeneous.wgsl", "legendre.wgsl", "lookup.wgsl", "table.wgsl"),
    )
}
