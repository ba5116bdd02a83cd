//! What the passes of this plugin compute, in double precision: what image tests hold them against.

use std::collections::BTreeMap;

use tyndall_plugin::ReferenceInput;
use tyndall_shaders::airlight::airlight;
use tyndall_shaders::ray::ray_of_pixel;

/// Airlight of every light up to the surface, by the twin of `airlight.wgsl`, which is independent of its nodes.
pub(crate) fn homogeneous(input: &ReferenceInput<'_>) -> Result<BTreeMap<&'static str, Vec<f32>>, String> {
    let scene = input.scene()?;
    let size = input.size("radiance")?;
    let depth = input.inputs.get("depth");
    let mut radiance = Vec::with_capacity((4 * size[0] * size[1]) as usize);
    for y in 0..size[1] {
        for x in 0..size[0] {
            let ray = ray_of_pixel(&scene.camera, [x, y], size);
            let far = depth.map_or(f64::INFINITY, |depth| f64::from(depth.data[(y * depth.width + x) as usize]));
            let of_lights = scene.lights.iter().map(|light| airlight(light, &scene.medium, &ray, 0.0, far));
            let sum = of_lights.reduce(|sum, more| sum + more).unwrap_or_default();
            radiance.extend([sum.x as f32, sum.y as f32, sum.z as f32, 1.0]);
        }
    }
    Ok(BTreeMap::from([("radiance", radiance)]))
}
