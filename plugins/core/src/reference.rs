//! What the passes of this plugin compute, in double precision: what image tests hold them against.

use std::collections::BTreeMap;
use std::path::Path;

use tyndall_plugin::descriptor::ParamValue;
use tyndall_plugin::{Outputs, PortData, ReferenceInput};
use tyndall_shaders::colour::srgb_from_linear;
use tyndall_shaders::medium::{effective_way, opacity, transmittance};
use tyndall_shaders::ray::ray_of_pixel;

/// Red, green and blue.
type Rgb = [f64; 3];

/// One colour port, alpha 1, texel by texel.
fn picture(port: &'static str, [width, height]: [u32; 2], texel: impl Fn(u32, u32) -> Rgb) -> Outputs {
    let texels = (0..height).flat_map(|y| (0..width).map(move |x| (x, y)));
    let data = texels.flat_map(|(x, y)| {
        let [r, g, b] = texel(x, y);
        [r as f32, g as f32, b as f32, 1.0]
    });
    Ok(BTreeMap::from([(port, data.collect())]))
}

/// A texel of an input; 0 where nothing is fed.
fn rgb(data: Option<&PortData>, x: u32, y: u32) -> Rgb {
    let Some(data) = data else { return [0.0; 3] };
    let at = ((y * data.width() + x) * data.channels()) as usize;
    std::array::from_fn(|channel| data.number(at + channel))
}

fn vector(input: &ReferenceInput<'_>, param: &str) -> Result<Rgb, String> {
    match input.params.get(param) {
        Some(ParamValue::Vector(values)) => values.as_slice().try_into().map_err(|_| format!("`{param}` is no colour")),
        _ => Err(format!("`{param}` is no colour")),
    }
}

/// a + factor·b.
pub(crate) fn add(input: &ReferenceInput<'_>) -> Outputs {
    let (a, b, factor) = (input.input("a")?, input.input("b")?, input.number("factor")?);
    picture("sum", input.size("sum")?, |x, y| {
        let (a, b) = (rgb(Some(a), x, y), rgb(Some(b), x, y));
        std::array::from_fn(|channel| a[channel] + factor * b[channel])
    })
}

/// input·factor.
pub(crate) fn scale(input: &ReferenceInput<'_>) -> Outputs {
    let (from, factor) = (input.input("input")?, vector(input, "factor")?);
    picture("scaled", input.size("scaled")?, |x, y| {
        let from = rgb(Some(from), x, y);
        std::array::from_fn(|channel| from[channel] * factor[channel])
    })
}

/// The colour, everywhere.
pub(crate) fn constant(input: &ReferenceInput<'_>) -> Outputs {
    let value = vector(input, "value")?;
    picture("color", input.size("color")?, |_, _| value)
}

/// The picture of the file, row by row from the top: grey in all three colours, alpha 1 where it has none.
pub(crate) fn image(input: &ReferenceInput<'_>) -> Outputs {
    let Some(ParamValue::File(path)) = input.params.get("file") else {
        return Err("`file` is no path".to_owned());
    };
    let image = tyndall_image::read(Path::new(path)).map_err(|error| error.to_string())?;
    if input.size("color")? != [image.width, image.height] {
        return Err(format!("{path} is of another size"));
    }
    let channels = image.channels as usize;
    let number = |texel: usize, channel: usize| image.data[texel * channels + channel];
    let mut color = Vec::with_capacity(4 * image.pixel_count());
    for texel in 0..image.pixel_count() {
        let grey = channels == 1;
        let rgb = (0..3).map(|channel| match channel {
            _ if grey => number(texel, 0),
            channel if channel < channels => number(texel, channel),
            _ => 0.0,
        });
        color.extend(rgb);
        color.push(if channels == 4 { number(texel, 3) } else { 1.0 });
    }
    Ok(BTreeMap::from([("color", color.into())]))
}

/// Airlight and surface; behind both, where a ray meets nothing, the background as far as the medium lets it through; and
/// what the medium sends that comes from no light.
pub(crate) fn compose(input: &ReferenceInput<'_>) -> Outputs {
    let (surface, airlight) = (input.inputs.get("surface").copied(), input.inputs.get("airlight").copied());
    let (depth, scene, size) = (input.input("depth")?, input.scene()?, input.size("radiance")?);
    picture("radiance", size, |x, y| {
        let way = depth.number(((y * depth.width() + x) * depth.channels()) as usize);
        let ray = ray_of_pixel(&scene.camera, [x, y], size);
        let effective = effective_way(&scene.height_fog, ray.origin.y, ray.direction.y, way);
        let mut sum = opacity(&scene.medium, effective) * scene.ambient;
        if way.is_infinite() {
            sum += transmittance(&scene.medium, effective) * scene.background;
        }
        let (sum, surface, airlight) = (sum.to_array(), rgb(surface, x, y), rgb(airlight, x, y));
        std::array::from_fn(|channel| surface[channel] + airlight[channel] + sum[channel])
    })
}

/// Exposure, tone curve, sRGB; in steps of 1/255.
pub(crate) fn tonemap(input: &ReferenceInput<'_>) -> Outputs {
    let (radiance, exposure) = (input.input("radiance")?, input.number("exposure")?);
    let Some(ParamValue::Choice(curve)) = input.params.get("curve") else {
        return Err("`curve` is no word".to_owned());
    };
    let hable = |x: f64| (x * (0.15 * x + 0.05) + 0.004) / (x * (0.15 * x + 0.50) + 0.06) - 0.02 / 0.30;
    let tone = |x: f64| match curve.as_str() {
        "reinhard" => x / (1.0 + x),
        "filmic" => hable(2.0 * x) / hable(11.2),
        _ => x,
    };
    picture("color", input.size("color")?, |x, y| {
        rgb(Some(radiance), x, y).map(|value| {
            let shown = tone((value * exposure).clamp(0.0, 1e6)).clamp(0.0, 1.0);
            (srgb_from_linear(shown) * 255.0).round() / 255.0
        })
    })
}

/// Means over footprints where it shrinks along an axis, linear between centres where it grows.
pub(crate) fn resize(input: &ReferenceInput<'_>) -> Outputs {
    let from = input.input("input")?;
    let size = input.size("resized")?;
    let (across, down) = (weights(size[0], from.width()), weights(size[1], from.height()));
    picture("resized", size, |x, y| {
        let mut sum = [0.0; 3];
        for (row, part_down) in &down[y as usize] {
            for (column, part_across) in &across[x as usize] {
                let texel = rgb(Some(from), *column, *row);
                (0..3).for_each(|channel| sum[channel] += part_down * part_across * texel[channel]);
            }
        }
        sum
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
