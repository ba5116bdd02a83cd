//! The plugin `aerial`: what air does to sunlight and to the view.

pub mod air;

use tyndall_plugin::{Plugin, folder};

/// The plugin.
pub fn plugin() -> Plugin {
    let files = folder!("aerial":
        "plugin.ron", "air.wgsl", "atmosphere.wgsl", "compose.wgsl", "extinction.wgsl", "sun.wgsl",
    );
    Plugin::new("aerial", files)
}
