//! The plugin `surface_radiance`: light that surfaces reflect toward the eye through a medium.

mod cosine_lobes;
mod reference;

use tyndall_plugin::{Plugin, folder};

pub use self::cosine_lobes::{COSINE_LOBES_MAX, SHININESSES_MAX, SPOTS_MAX};

/// The plugin.
pub fn plugin() -> Plugin {
    let files = folder!(
        "surface_radiance": "plugin.ron", "ambient.wgsl", "biri.wgsl", "direct.wgsl", "gamma_l.wgsl", "j.wgsl", "j_k.wgsl", "legendre.wgsl",
        "lobe_data.wgsl", "lobes.wgsl", "lookup.wgsl", "phong.wgsl", "table.wgsl", "table_lobe.wgsl", "zonal.wgsl"
    );
    Plugin::new("surface_radiance", files)
        .scene_data(cosine_lobes::data())
        .scene_feature("SeveralShininesses", |scene| scene.shininesses().len() > 1)
        .scene_feature("TooManyShininesses", |scene| scene.shininesses().len() > SHININESSES_MAX)
        .scene_feature("TooManySpots", |scene| cosine_lobes::spot_shapes(scene) > SPOTS_MAX)
        .reference("surface_radiance.direct", reference::direct)
        .reference("surface_radiance.zonal", reference::around::zonal)
        .reference("surface_radiance.lobes", reference::lobes::lobes)
        .reference("surface_radiance.phong", reference::phong::phong)
        .reference("surface_radiance.j", reference::tables::j)
        .reference("surface_radiance.table", reference::lookup::table)
        .reference("surface_radiance.gamma_l", reference::tables::gamma_l)
        .reference("surface_radiance.biri", reference::lookup::biri)
        .reference("surface_radiance.j_k", reference::tables::j_k)
        .reference("surface_radiance.legendre", reference::lookup::legendre)
}
