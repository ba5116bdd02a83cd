//! What the passes of this plugin compute, in double precision: what image tests hold them against.

use std::collections::BTreeMap;

use tyndall_plugin::{Outputs, ReferenceInput};
use tyndall_shaders::airlight::airlight;
use tyndall_shaders::lights::lit_bit;
use tyndall_shaders::ray::ray_of_pixel;
use tyndall_shaders::shadows::{is_lit, lit_intervals};

/// Airlight over the lit intervals, found by brute force among all triangles, and the lights that reach the surface.
pub(crate) fn exact(input: &ReferenceInput<'_>) -> Outputs {
    let scene = input.scene()?;
    let size = input.size("radiance")?;
    let depth = input.input("depth")?;
    let (mut radiance, mut lit) = (Vec::new(), Vec::new());
    for y in 0..size[1] {
        for x in 0..size[0] {
            let ray = ray_of_pixel(&scene.camera, [x, y], size);
            let way = depth.number((y * depth.width() + x) as usize);
            let mut sum = [0.0; 3];
            let mut bits = [0.0_f32; 4];
            for (index, light) in scene.lights.iter().enumerate() {
                for [near, far] in lit_intervals(light, &scene.casters, &ray, way) {
                    let part = airlight(light, &scene.medium, &ray, near, far).to_array();
                    (0..3).for_each(|channel| sum[channel] += part[channel]);
                }
                if let Some((channel, bit)) = lit_bit(index)
                    && is_lit(light, &scene.casters, &ray, way)
                {
                    bits[channel] += bit as f32;
                }
            }
            radiance.extend(sum.map(|channel| channel as f32));
            radiance.push(1.0);
            lit.extend(bits);
        }
    }
    Ok(BTreeMap::from([("radiance", radiance.into()), ("lit", lit.into())]))
}
