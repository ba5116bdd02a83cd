//! The plugin `aerial`: what air does to sunlight and to the view.

pub mod air;
pub mod atmosphere;
mod reference;

use tyndall_plugin::{Plugin, folder};

/// The plugin.
pub fn plugin() -> Plugin {
    let files = folder!("aerial":
        "plugin.ron", "air.wgsl", "atmosphere.wgsl", "compose.wgsl", "extinction.wgsl", "sun.wgsl",
    );
    Plugin::new("aerial", files)
        .reference("aerial.atmosphere", reference::atmosphere)
        .reference("aerial.compose", reference::compose)
        .reference("aerial.extinction", reference::extinction)
        .reference("aerial.sun", reference::sun)
}
