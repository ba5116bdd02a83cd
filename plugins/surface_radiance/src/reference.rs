//! What the passes of this plugin compute, in double precision: what image tests hold them against.

use std::collections::BTreeMap;
use std::f64::consts::PI;

use tyndall_plugin::descriptor::ParamValue;
use tyndall_plugin::{PortData, ReferenceInput};
use tyndall_shaders::lights::incident;
use tyndall_shaders::medium::transmittance;
use tyndall_shaders::ray::ray_of_pixel;
use tyndall_shaders::scene::Scene;

/// Direct light of every light: the formula of the contract, from the surface that was fed.
pub(crate) fn phong(input: &ReferenceInput<'_>) -> Result<BTreeMap<&'static str, Vec<f32>>, String> {
    let scene = input.scene()?;
    let is_on = |param: &str| input.params.get(param) == Some(&ParamValue::Bool(true));
    if is_on("scattered") {
        return Err("it knows direct light only: set `scattered` to false".to_owned());
    }
    let (depth, normal, material) = (input.input("depth")?, input.input("normal")?, input.input("material")?);
    let size = input.size("radiance")?;
    let mut radiance = Vec::with_capacity((4 * size[0] * size[1]) as usize);
    for y in 0..size[1] {
        for x in 0..size[0] {
            let way = texel(depth, 0, x, y)[0];
            let mut sum = [0.0; 3];
            if is_on("direct") && way.is_finite() {
                let surface = Surface {
                    way,
                    lit: input.input("lit").ok().map(|lit| texel(lit, 0, x, y)),
                    normal: texel(normal, 0, x, y),
                    diffuse: texel(material, 0, x, y),
                    phong: texel(material, 1, x, y),
                };
                sum = reflected(scene, [x, y], size, &surface);
            }
            radiance.extend(sum.map(|channel| channel as f32));
            radiance.push(1.0);
        }
    }
    Ok(BTreeMap::from([("radiance", radiance)]))
}

/// What a ray meets.
struct Surface {
    /// Metres along the ray.
    way: f64,
    /// The lights that reach it, as in `lights.wgsl`; `None`: all.
    lit: Option<[f64; 4]>,
    normal: [f64; 4],
    /// ρ in the first three channels.
    diffuse: [f64; 4],
    /// k_s, and n in the fourth channel.
    phong: [f64; 4],
}

/// A texel of a layer; channels that are not there are 0.
fn texel(data: &PortData, layer: u32, x: u32, y: u32) -> [f64; 4] {
    let at = (((layer * data.height + y) * data.width + x) * data.channels) as usize;
    std::array::from_fn(
        |channel| {
            if channel < data.channels as usize { f64::from(data.data[at + channel]) } else { 0.0 }
        },
    )
}

fn reflected(scene: &Scene, pixel: [u32; 2], size: [u32; 2], surface: &Surface) -> [f64; 3] {
    let ray = ray_of_pixel(&scene.camera, pixel, size);
    let mut normal = ray.direction;
    (normal.x, normal.y, normal.z) = (surface.normal[0], surface.normal[1], surface.normal[2]);
    if normal.dot(ray.direction) > 0.0 {
        normal = -normal;
    }
    let mirrored = ray.direction - 2.0 * ray.direction.dot(normal) * normal;
    let to_eye = transmittance(&scene.medium, surface.way).to_array();
    let mut sum = [0.0; 3];
    for (index, light) in scene.lights.iter().enumerate() {
        let bits = surface.lit.and_then(|lit| lit.get(index / 24).copied());
        if bits.is_some_and(|bits| bits as u32 >> (index % 24) & 1 == 0) {
            continue;
        }
        let arriving = incident(light, ray.at(surface.way));
        let (cosine, cos_alpha) = (normal.dot(arriving.to_light), mirrored.dot(arriving.to_light));
        if cosine <= 0.0 {
            continue;
        }
        let lobe = if cos_alpha > 0.0 { cos_alpha.powf(surface.phong[3]) } else { 0.0 };
        let irradiance = (arriving.irradiance * transmittance(&scene.medium, arriving.way)).to_array();
        for channel in 0..3 {
            let brdf = surface.diffuse[channel] / PI * cosine + surface.phong[channel] * lobe;
            sum[channel] += brdf * irradiance[channel] * to_eye[channel];
        }
    }
    sum
}
