//! What the passes of this plugin compute, in double precision: what image tests hold them against.
//!
//! Light that depends on tables is computed from the tables that the pass was given, so that the errors of a table are not
//! those of the pass that reads it.

pub(crate) mod around;
pub(crate) mod lobes;
pub(crate) mod lookup;
pub(crate) mod phong;
pub(crate) mod tables;

use std::f64::consts::PI;

use glam::DVec3;
use tyndall_plugin::{Outputs, Pixel, ReferenceInput};
use tyndall_shaders::lights::{incident, lit_bit};
use tyndall_shaders::medium::{effective_way, opacity, transmittance};
use tyndall_shaders::ray::Ray;
use tyndall_shaders::scene::{HeightFog, Light, Scene};

/// Direct light of every light, in height fog too: (ρ/π·(n·l) + k_s·cosⁿα)·I·e^(−τ)/d², from the surface at the inputs.
pub(crate) fn direct(input: &ReferenceInput<'_>) -> Outputs {
    let fog = input.scene()?.height_fog;
    of_surfaces(input, &fog, false, |scene, light, surface| straight(scene, &fog, light, surface))
}

/// What a ray meets.
#[derive(Clone, Copy)]
pub(crate) struct Surface {
    /// The light that is asked for reaches it.
    pub is_lit: bool,
    pub position: DVec3,
    /// Turned to the eye.
    pub normal: DVec3,
    pub mirrored: DVec3,
    /// ρ in the first three channels.
    pub diffuse: [f64; 4],
    /// k_s, and n in the fourth channel.
    pub phong: [f64; 4],
}

/// What surfaces send to the eye: `light` gives that of one light before the way to the eye; what the medium sends to a
/// surface without any light of the scene is added where it is asked for.
pub(crate) fn of_surfaces(
    input: &ReferenceInput<'_>,
    fog: &HeightFog,
    with_ambient: bool,
    light: impl Fn(&Scene, &Light, &Surface) -> DVec3 + Sync,
) -> Outputs {
    let (scene, normal, material) = (input.scene()?, input.input("normal")?, input.input("material")?);
    let lit = input.inputs.get("lit");
    input.view("radiance", |Pixel { at: [x, y], ray, distance }| {
        if distance.is_infinite() {
            return DVec3::ZERO;
        }
        let [diffuse, phong] = [0, 1].map(|layer| material.texel([*x, *y, layer]));
        let surface = surface(ray, *distance, rgb(&normal.texel([*x, *y, 0])), diffuse, phong);
        let to_eye = transmittance(&scene.medium, effective_way(fog, ray.origin.y, ray.direction.y, *distance));
        let lit = lit.map(|lit| lit.texel([*x, *y, 0]));
        let lights = scene.lights.iter().enumerate().map(|(index, each)| {
            light(scene, each, &Surface { is_lit: lit.is_none_or(|bits| has_light(bits, index)), ..surface })
        });
        let around = if with_ambient { ambient(scene, &surface) } else { DVec3::ZERO };
        (lights.sum::<DVec3>() + around) * to_eye
    })
}

/// J·(ρ + k_s·2π/(n + 1)): light scattered many times, and emission, of a medium without end.
fn ambient(scene: &Scene, surface: &Surface) -> DVec3 {
    let whole_lobe = 2.0 * PI / (surface.phong[3] + 1.0);
    let reflected = rgb(&surface.diffuse) + rgb(&surface.phong) * whole_lobe;
    opacity(&scene.medium, f64::INFINITY) * scene.ambient * reflected
}

/// Whether a light is among those of a texel; beyond those that there is room for all are.
fn has_light(bits: [f64; 4], light: usize) -> bool {
    lit_bit(light).is_none_or(|(channel, bit)| bits[channel] as u32 & bit != 0)
}

fn surface(ray: &Ray, way: f64, normal: DVec3, diffuse: [f64; 4], phong: [f64; 4]) -> Surface {
    let mirrored = ray.direction - 2.0 * ray.direction.dot(normal) * normal;
    Surface { is_lit: true, position: ray.at(way), normal, mirrored, diffuse, phong }
}

/// The first three channels.
pub(crate) fn rgb(texel: &[f64; 4]) -> DVec3 {
    DVec3::new(texel[0], texel[1], texel[2])
}

/// What comes straight from a light.
pub(crate) fn straight(scene: &Scene, fog: &HeightFog, light: &Light, surface: &Surface) -> DVec3 {
    let arriving = incident(light, surface.position);
    let (cosine, cos_alpha) = (surface.normal.dot(arriving.to_light), surface.mirrored.dot(arriving.to_light));
    if cosine <= 0.0 || !surface.is_lit {
        return DVec3::ZERO;
    }
    let lobe = if cos_alpha > 0.0 { cos_alpha.powf(surface.phong[3]) } else { 0.0 };
    let way = effective_way(fog, surface.position.y, arriving.to_light.y, arriving.way);
    let brdf = rgb(&surface.diffuse) / PI * cosine + rgb(&surface.phong) * lobe;
    brdf * arriving.irradiance * transmittance(&scene.medium, way)
}
