//! The plugin `march`: the same light by brute force, to compare with.

mod occluders;
mod reference;

use tyndall_plugin::{Plugin, folder};
use tyndall_shaders::lights::LIT_LIGHTS;

/// The plugin.
pub fn plugin() -> Plugin {
    let files = folder!("march":
        "plugin.ron", "airlight.wgsl", "occluder_data.wgsl", "occluders.wgsl", "shadow_map.wgsl", "surface_shadows.wgsl",
    );
    Plugin::new("march", files)
        .scene_data(occluders::data())
        .scene_feature("ManyLights", |scene| scene.lights.len() > LIT_LIGHTS)
        .reference("march.airlight", reference::airlight)
        .reference("march.shadow_map", reference::shadow_map)
}
