//! The plugin `shadow_planes`: airlight between the shadow planes that a view ray crosses.

mod reference;
mod reference_biri;
mod shadows;

use tyndall_plugin::{Plugin, folder};
use tyndall_shaders::lights::LIT_LIGHTS;

/// The plugin.
pub fn plugin() -> Plugin {
    Plugin::new(
        "shadow_planes",
        folder!("shadow_planes": "plugin.ron", "exact.wgsl", "few_nodes.wgsl", "bound.wgsl", "biri.wgsl", "shadow_data.wgsl", "shadows.wgsl"),
    )
    .scene_data(shadows::data())
    .scene_feature("ManyLights", |scene| scene.lights.len() > LIT_LIGHTS)
    .reference("shadow_planes.exact", reference::exact)
    .reference("shadow_planes.biri", reference_biri::biri)
}
