//! The plugin `shadow_planes`: airlight between the shadow planes that a view ray crosses.

mod reference;
mod reference_biri;

use tyndall_plugin::{Plugin, folder};

/// The plugin.
pub fn plugin() -> Plugin {
    Plugin::new(
        "shadow_planes",
        folder!("shadow_planes": "plugin.ron", "exact.wgsl", "few_nodes.wgsl", "bound.wgsl", "biri.wgsl"),
    )
    .reference("shadow_planes.exact", reference::exact)
    .reference("shadow_planes.biri", reference_biri::biri)
}
