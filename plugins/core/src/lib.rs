//! The plugin `core`: geometry buffers, arithmetic on pictures, tone mapping, constants, files and sizes.

mod gbuffer;
mod image;
mod reference;
mod surfaces;

use tyndall_plugin::{Plugin, folder};

/// The plugin.
pub fn plugin() -> Plugin {
    let files = folder!("core":
        "plugin.ron", "add.wgsl", "compose.wgsl", "constant.wgsl", "gbuffer.wgsl", "resize.wgsl", "scale.wgsl",
        "tonemap.wgsl", "visibility.wgsl",
    );
    Plugin::new("core", files)
        .pass(gbuffer::pass())
        .pass(image::pass())
        .reference("core.add", reference::add)
        .reference("core.compose", reference::compose)
        .reference("core.constant", reference::constant)
        .reference("core.gbuffer", surfaces::gbuffer)
        .reference("core.image", reference::image)
        .reference("core.resize", reference::resize)
        .reference("core.scale", reference::scale)
        .reference("core.tonemap", reference::tonemap)
}
