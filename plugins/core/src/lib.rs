//! The plugin `core`: geometry buffers, arithmetic on pictures, tone mapping, constants, files and sizes.

mod gbuffer;
mod image;

use tyndall_plugin::{Plugin, folder};

/// The plugin.
pub fn plugin() -> Plugin {
    let files = folder!("core":
        "plugin.ron", "add.wgsl", "compose.wgsl", "constant.wgsl", "gbuffer.wgsl", "resize.wgsl", "scale.wgsl",
        "tonemap.wgsl", "visibility.wgsl",
    );
    Plugin::new("core", files).pass(gbuffer::pass()).pass(image::pass())
}
