//! What the passes of this plugin compute, in double precision: what image tests hold them against.

pub(crate) mod lookup;
pub(crate) mod tables;

use std::collections::BTreeMap;

use tyndall_plugin::descriptor::ParamValue;
use tyndall_plugin::{Outputs, ReferenceInput};
use tyndall_shaders::ray::{Ray, ray_of_pixel};
use tyndall_shaders::scene::{Light, Scene};
use tyndall_shaders::{airlight, height_fog};

/// Airlight of every light up to the surface, by the twin of `airlight.wgsl`, which is independent of its nodes.
pub(crate) fn homogeneous(input: &ReferenceInput<'_>) -> Outputs {
    of_lights(input, |scene, light, ray, far| airlight::airlight(light, &scene.medium, ray, 0.0, far).to_array())
}

/// The same where the density falls with the height.
pub(crate) fn height_fog(input: &ReferenceInput<'_>) -> Outputs {
    let attenuated_sun = input.params.get("attenuated_sun") == Some(&ParamValue::Bool(true));
    of_lights(input, |scene, light, ray, far| {
        height_fog::airlight(light, &scene.medium, &scene.height_fog, ray, far, attenuated_sun).to_array()
    })
}

/// The sum over the lights of what `airlight` says of each, along the ray of each pixel.
fn of_lights(input: &ReferenceInput<'_>, airlight: impl Fn(&Scene, &Light, &Ray, f64) -> [f64; 3]) -> Outputs {
    let scene = input.scene()?;
    let size = input.size("radiance")?;
    let depth = input.inputs.get("depth");
    let mut radiance = Vec::with_capacity((4 * size[0] * size[1]) as usize);
    for y in 0..size[1] {
        for x in 0..size[0] {
            let ray = ray_of_pixel(&scene.camera, [x, y], size);
            let far = depth.map_or(f64::INFINITY, |depth| depth.number((y * depth.width() + x) as usize));
            let mut sum = [0.0; 3];
            for light in &scene.lights {
                let more = airlight(scene, light, &ray, far);
                (0..3).for_each(|channel| sum[channel] += more[channel]);
            }
            radiance.extend(sum.map(|channel| channel as f32));
            radiance.push(1.0);
        }
    }
    Ok(BTreeMap::from([("radiance", radiance.into())]))
}
