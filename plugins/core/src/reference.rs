//! What the passes of this plugin compute, in double precision: what image tests hold them against.

use std::collections::BTreeMap;
use std::path::Path;

use glam::DVec3;
use tyndall_plugin::descriptor::ParamValue;
use tyndall_plugin::{Outputs, Pixel, ReferenceInput, rgb};
use tyndall_shaders::colour::srgb_from_linear;
use tyndall_shaders::medium::{effective_way, opacity, transmittance};

/// a + factor·b.
pub(crate) fn add(input: &ReferenceInput<'_>) -> Outputs {
    let (a, b, factor) = (input.input("a")?, input.input("b")?, input.number("factor")?);
    input.picture("sum", |at| rgb(a, at) + factor * rgb(b, at))
}

/// input·factor.
pub(crate) fn scale(input: &ReferenceInput<'_>) -> Outputs {
    let (from, factor) = (input.input("input")?, input.color("factor")?);
    input.picture("scaled", |at| rgb(from, at) * factor)
}

/// The colour, everywhere.
pub(crate) fn constant(input: &ReferenceInput<'_>) -> Outputs {
    let value = input.color("value")?;
    input.picture("color", |_| value)
}

/// The picture of the file, row by row from the top: grey in all three colours, alpha 1 where it has none.
pub(crate) fn image(input: &ReferenceInput<'_>) -> Outputs {
    let Some(ParamValue::File(path)) = input.params.get("file") else {
        return Err("`file` is not a path".to_owned());
    };
    let image = tyndall_image::read(Path::new(path)).map_err(|error| error.to_string())?;
    if input.size("color")? != [image.width, image.height] {
        return Err(format!("{path} is of another size"));
    }
    let texel = |texel: &[f32]| match *texel {
        [grey] => [grey, grey, grey, 1.0],
        [r, g] => [r, g, 0.0, 1.0],
        [r, g, b] => [r, g, b, 1.0],
        [r, g, b, a, ..] => [r, g, b, a],
        [] => [0.0; 4],
    };
    Ok(BTreeMap::from([("color", image.data.chunks(image.channels as usize).flat_map(texel).collect())]))
}

/// Airlight and surface; behind both, where a ray meets nothing, the background as far as the medium lets it through; and
/// what the medium sends that comes from no light.
pub(crate) fn compose(input: &ReferenceInput<'_>) -> Outputs {
    let (scene, fed) = (input.scene()?, ["surface", "airlight"].map(|port| input.inputs.get(port)));
    input.view("radiance", |Pixel { at, ray, distance }| {
        let effective = effective_way(&scene.height_fog, ray.origin.y, ray.direction.y, *distance);
        let mut behind = opacity(&scene.medium, effective) * scene.ambient;
        if distance.is_infinite() {
            behind += transmittance(&scene.medium, effective) * scene.background;
        }
        fed.iter().flatten().map(|data| rgb(data, *at)).sum::<DVec3>() + behind
    })
}

/// Exposure, tone curve, sRGB; in steps of 1/255.
pub(crate) fn tonemap(input: &ReferenceInput<'_>) -> Outputs {
    let (radiance, exposure, curve) = (input.input("radiance")?, input.number("exposure")?, input.choice("curve")?);
    let hable = |x: f64| (x * (0.15 * x + 0.05) + 0.004) / (x * (0.15 * x + 0.50) + 0.06) - 0.02 / 0.30;
    let tone = |x: f64| match curve {
        "reinhard" => x / (1.0 + x),
        "filmic" => hable(2.0 * x) / hable(11.2),
        _ => x,
    };
    let shown = |value: f64| {
        let shown = tone((value * exposure).clamp(0.0, 1e6)).clamp(0.0, 1.0);
        (srgb_from_linear(shown) * 255.0).round() / 255.0
    };
    input.picture("color", |at| rgb(radiance, at).map(shown))
}

/// Means over footprints where it shrinks along an axis, linear between centres where it grows.
pub(crate) fn resize(input: &ReferenceInput<'_>) -> Outputs {
    let (from, [width, height]) = (input.input("input")?, input.size("resized")?);
    let (across, down) = (weights(width, from.width()), weights(height, from.height()));
    input.picture("resized", |[x, y]| {
        let row = |(row, part): &(u32, f64)| {
            let texels = across[x as usize].iter().map(|(column, share)| share * rgb(from, [*column, *row]));
            *part * texels.sum::<DVec3>()
        };
        down[y as usize].iter().map(row).sum()
    })
}

/// Of each target texel along an axis: the source texels and their parts, which add up to 1.
fn weights(target: u32, source: u32) -> Vec<Vec<(u32, f64)>> {
    let ratio = f64::from(source) / f64::from(target);
    let of = |at: u32| -> Vec<(u32, f64)> {
        if ratio > 1.0 {
            let (start, end) = (f64::from(at) * ratio, (f64::from(at) + 1.0) * ratio);
            let part = |texel: u32| (end.min(f64::from(texel) + 1.0) - start.max(f64::from(texel))).max(0.0) / ratio;
            return (0..source).map(|texel| (texel, part(texel))).filter(|(_, part)| *part > 0.0).collect();
        }
        let centre = (f64::from(at) + 0.5) * ratio - 0.5;
        let clamped = |texel: f64| texel.clamp(0.0, f64::from(source) - 1.0) as u32;
        let right = centre - centre.floor();
        vec![(clamped(centre.floor()), 1.0 - right), (clamped(centre.floor() + 1.0), right)]
    };
    (0..target).map(of).collect()
}
