//! What the passes of this plugin compute, in double precision: what image tests hold them against.

pub(crate) mod lookup;
pub(crate) mod tables;

use glam::DVec3;
use tyndall_plugin::{Outputs, ReferenceInput};
use tyndall_shaders::ray::Ray;
use tyndall_shaders::scene::{Light, Scene};
use tyndall_shaders::{airlight, height_fog};

/// Airlight of every light up to the surface, by the twin of `airlight.wgsl`, which is independent of its nodes.
pub(crate) fn homogeneous(input: &ReferenceInput<'_>) -> Outputs {
    of_lights(input, |scene, light, ray, far| airlight::airlight(light, &scene.medium, ray, 0.0, far))
}

/// The same where the density falls with the height.
pub(crate) fn height_fog(input: &ReferenceInput<'_>) -> Outputs {
    let attenuated_sun = input.is_on("attenuated_sun");
    of_lights(input, |scene, light, ray, far| {
        height_fog::airlight(light, &scene.medium, &scene.height_fog, ray, far, attenuated_sun)
    })
}

/// The sum over the lights of what `airlight` says of each, along the ray of each pixel.
fn of_lights(input: &ReferenceInput<'_>, airlight: impl Fn(&Scene, &Light, &Ray, f64) -> DVec3 + Sync) -> Outputs {
    let scene = input.scene()?;
    input.view("radiance", |pixel| {
        scene.lights.iter().map(|light| airlight(scene, light, &pixel.ray, pixel.distance)).sum()
    })
}
