//! The plugin `airlight`: light that a medium scatters once toward the eye.

mod reference;

use tyndall_plugin::{Plugin, folder};

/// The plugin.
pub fn plugin() -> Plugin {
    let files = folder!(
        "airlight": "plugin.ron", "h.wgsl", "h_k.wgsl", "height_fog.wgsl",
        "homogeneous.wgsl", "legendre.wgsl", "lookup.wgsl", "table.wgsl"
    );
    Plugin::new("airlight", files)
        .reference("airlight.homogeneous", reference::homogeneous)
        .reference("airlight.height_fog", reference::height_fog)
        .reference("airlight.h", reference::tables::h)
        .reference("airlight.h_k", reference::tables::h_k)
        .reference("airlight.table", reference::lookup::table)
        .reference("airlight.legendre", reference::lookup::legendre)
}
