//! What the passes of this plugin compute, in double precision: what image tests hold them against.

use std::collections::BTreeMap;
use std::f64::consts::PI;

use glam::DVec3;
use tyndall_plugin::descriptor::ParamValue;
use tyndall_plugin::{Outputs, PortData, ReferenceInput};
use tyndall_shaders::ray::ray_of_pixel;
use tyndall_shaders::scene::{Light, Scene};

use crate::air::Air;
use crate::atmosphere::Atmosphere;

/// The words of `Air` of `air.wgsl`, in order; whole numbers as their bits.
pub(crate) fn atmosphere(input: &ReferenceInput<'_>) -> Outputs {
    let is = |name: &str, word: &str| input.params.get(name) == Some(&ParamValue::Choice(word.to_owned()));
    let atmosphere = Atmosphere {
        rayleigh: vector(input, "rayleigh")?,
        mie: vector(input, "mie")?,
        absorption: vector(input, "absorption")?,
        g: vector(input, "g")?,
        rayleigh_height: input.number("rayleigh_height")?,
        mie_height: input.number("mie_height")?,
        dome: is("sky", "dome"),
        from_space: is("sunlight", "space"),
    };
    let air = atmosphere.air();
    let from_space = f64::from(f32::from_bits(u32::from(air.above.is_some())));
    let haze = air.g.to_array().map(|g| {
        let rho = (1.0 - g) / (1.0 + g);
        [rho, rho * (1.0 + rho) / (8.0 * PI), 0.0, 0.0]
    });
    let words = [
        air.extinction.extend(0.0).to_array(),
        (air.rayleigh + air.mie).extend(0.0).to_array(),
        air.rayleigh.extend(air.dome.unwrap_or(0.0)).to_array(),
        air.mie.extend(from_space).to_array(),
        atmosphere.zenith_depth().extend(0.0).to_array(),
        haze[0],
        haze[1],
        haze[2],
    ];
    Ok(BTreeMap::from([("air", words.into_iter().flatten().map(|word| word as f32).collect())]))
}

/// L_in of every directional light.
pub(crate) fn sun(input: &ReferenceInput<'_>) -> Outputs {
    picture(input, "inscattering", |air, scene, _, ray, way| {
        let s = air.way(ray, way);
        suns(scene).map(|(sun, irradiance)| air.in_scattering(sun, irradiance, ray, s)).sum()
    })
}

/// F_ex L_0, less what the air takes of sunlight on its way to the surface: of several suns the mean by their irradiance.
pub(crate) fn extinction(input: &ReferenceInput<'_>) -> Outputs {
    let surface = input.inputs.get("surface").copied();
    picture(input, "attenuated", |air, scene, texel, ray, way| {
        let above: DVec3 = suns(scene).map(|(_, irradiance)| irradiance).sum();
        let below: DVec3 = suns(scene).map(|(sun, irradiance)| irradiance * air.sunlight(sun)).sum();
        let left = DVec3::from_array(std::array::from_fn(|i| if above[i] > 0.0 { below[i] / above[i] } else { 1.0 }));
        color(surface, texel, 1.0) * left * air.extinction_factor(air.way(ray, way))
    })
}

/// What the air sends, what surfaces send, and where a ray meets nothing what comes through of the background.
pub(crate) fn compose(input: &ReferenceInput<'_>) -> Outputs {
    let inscattering = input.inputs.get("inscattering").copied();
    let surface = input.inputs.get("surface").copied();
    picture(input, "radiance", |air, scene, texel, ray, way| {
        let sum = color(inscattering, texel, 0.0) + color(surface, texel, 0.0);
        if way.is_finite() { sum } else { sum + scene.background * air.extinction_factor(air.way(ray, way)) }
    })
}

/// One colour port, alpha 1. Its texels from the air, the scene, the texel's number, the ray's direction, and the way to
/// the nearest surface.
fn picture(
    input: &ReferenceInput<'_>,
    port: &'static str,
    texel: impl Fn(&Air, &Scene, usize, DVec3, f64) -> DVec3,
) -> Outputs {
    let (scene, air, size) = (input.scene()?, air(input.input("air")?)?, input.size(port)?);
    let depth = input.inputs.get("depth");
    let mut data = Vec::with_capacity((4 * size[0] * size[1]) as usize);
    for y in 0..size[1] {
        for x in 0..size[0] {
            let index = (y * size[0] + x) as usize;
            let way = depth.map_or(f64::INFINITY, |depth| depth.number(index * depth.channels() as usize));
            let ray = ray_of_pixel(&scene.camera, [x, y], size).direction;
            data.extend(texel(&air, scene, index, ray, way).extend(1.0).as_vec4().to_array());
        }
    }
    Ok(BTreeMap::from([(port, data.into())]))
}

/// The air as a pass was given it: see `Air` of `air.wgsl`.
fn air(data: &PortData) -> Result<Air, String> {
    let number = |at: usize| data.get(at).ok_or("the air is cut short".to_owned());
    let vector = |at: usize| Ok::<_, String>(DVec3::new(number(at)?, number(at + 1)?, number(at + 2)?));
    let g = |at: usize| number(at).map(|rho| (1.0 - rho) / (1.0 + rho));
    let (dome, from_space) = (number(11)?, (number(15)? as f32).to_bits() != 0);
    let depth = vector(16)?;
    Ok(Air {
        extinction: vector(0)?,
        rayleigh: vector(8)?,
        mie: vector(12)?,
        g: DVec3::new(g(20)?, g(24)?, g(28)?),
        dome: (dome > 0.0).then_some(dome),
        above: from_space.then_some(depth),
    })
}

/// Direction and irradiance of every directional light.
fn suns(scene: &Scene) -> impl Iterator<Item = (DVec3, DVec3)> + '_ {
    scene.lights.iter().filter_map(|light| match light {
        Light::Directional { direction, irradiance } => Some((*direction, *irradiance)),
        _ => None,
    })
}

/// A texel of an input, or what stands for one that is not fed.
fn color(data: Option<&PortData>, texel: usize, without: f64) -> DVec3 {
    let Some(data) = data else { return DVec3::splat(without) };
    let at = texel * data.channels() as usize;
    DVec3::from_array(std::array::from_fn(|channel| data.number(at + channel)))
}

fn vector(input: &ReferenceInput<'_>, param: &str) -> Result<DVec3, String> {
    match input.params.get(param) {
        Some(ParamValue::Vector(values)) if values.len() == 3 => Ok(DVec3::from_slice(values)),
        _ => Err(format!("`{param}` is no colour")),
    }
}
