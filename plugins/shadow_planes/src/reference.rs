//! What the passes of this plugin compute, in double precision: what image tests hold them against.

use glam::DVec3;
use std::collections::BTreeMap;
use tyndall_plugin::{Outputs, Pixel, ReferenceInput, rgba};
use tyndall_shaders::airlight::airlight;
use tyndall_shaders::lights::lit_bit;
use tyndall_shaders::shadows::{is_lit, lit_intervals};

/// Airlight over the lit intervals, found by brute force among all triangles, and the lights that reach the surface.
pub(crate) fn exact(input: &ReferenceInput<'_>) -> Outputs {
    let scene = input.scene()?;
    let pixels = input.pixels("radiance", |Pixel { ray, distance, .. }| {
        let (mut sum, mut bits) = (DVec3::ZERO, [0_u32; 4]);
        for (index, light) in scene.lights.iter().enumerate() {
            let lit = lit_intervals(light, &scene.casters, ray, *distance);
            sum += lit.into_iter().map(|[near, far]| airlight(light, &scene.medium, ray, near, far)).sum::<DVec3>();
            if let Some((channel, bit)) = lit_bit(index)
                && is_lit(light, &scene.casters, ray, *distance)
            {
                bits[channel] |= bit;
            }
        }
        (sum, bits)
    })?;
    let (radiance, lit): (Vec<_>, Vec<_>) = pixels.into_iter().unzip();
    Ok(BTreeMap::from([("radiance", rgba(radiance)), ("lit", lit.concat().into())]))
}
