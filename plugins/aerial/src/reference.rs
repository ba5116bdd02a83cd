//! What the passes of this plugin compute, in double precision: what image tests hold them against.

use std::collections::BTreeMap;
use std::f64::consts::PI;

use glam::DVec3;
use tyndall_plugin::{Outputs, Pixel, PortData, ReferenceInput, rgb};
use tyndall_shaders::scene::{Light, Scene};

use crate::air::Air;
use crate::atmosphere::Atmosphere;

/// The words of `Air` of `air.wgsl`, in order; whole numbers as their bits.
pub(crate) fn atmosphere(input: &ReferenceInput<'_>) -> Outputs {
    let atmosphere = Atmosphere {
        rayleigh: input.color("rayleigh")?,
        mie: input.color("mie")?,
        absorption: input.color("absorption")?,
        g: input.color("g")?,
        rayleigh_height: input.number("rayleigh_height")?,
        mie_height: input.number("mie_height")?,
        dome: input.choice("sky")? == "dome",
        from_space: input.choice("sunlight")? == "space",
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
    let (scene, air) = (input.scene()?, air(input.input("air")?)?);
    input.view("inscattering", |Pixel { ray, distance, .. }| {
        let s = air.way(ray.direction, *distance);
        suns(scene).map(|(sun, irradiance)| air.in_scattering(sun, irradiance, ray.direction, s)).sum()
    })
}

/// F_ex L_0, less what the air takes of sunlight on its way to the surface: of several suns the mean by their irradiance.
pub(crate) fn extinction(input: &ReferenceInput<'_>) -> Outputs {
    let (scene, air) = (input.scene()?, air(input.input("air")?)?);
    let above: DVec3 = suns(scene).map(|(_, irradiance)| irradiance).sum();
    let below: DVec3 = suns(scene).map(|(sun, irradiance)| irradiance * air.sunlight(sun)).sum();
    let left = DVec3::from_array(std::array::from_fn(|i| if above[i] > 0.0 { below[i] / above[i] } else { 1.0 }));
    let surface = input.inputs.get("surface");
    input.view("attenuated", |Pixel { at, ray, distance }| {
        let surface = surface.map_or(DVec3::ONE, |surface| rgb(surface, *at));
        surface * left * air.extinction_factor(air.way(ray.direction, *distance))
    })
}

/// What the air sends, what surfaces send, and where a ray meets nothing what comes through of the background.
pub(crate) fn compose(input: &ReferenceInput<'_>) -> Outputs {
    let (scene, air) = (input.scene()?, air(input.input("air")?)?);
    let fed = ["inscattering", "surface"].map(|port| input.inputs.get(port));
    input.view("radiance", |Pixel { at, ray, distance }| {
        let sum = fed.iter().flatten().map(|data| rgb(data, *at)).sum();
        if distance.is_finite() {
            return sum;
        }
        sum + scene.background * air.extinction_factor(air.way(ray.direction, *distance))
    })
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
