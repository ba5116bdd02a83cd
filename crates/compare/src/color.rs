//! Pictures for the eye: light through one curve, errors through a perceptually uniform colour map.

use tyndall_image::srgb_from_linear;

use crate::truth::Truth;

/// 8-bit sRGB.
pub(crate) type Rgb = [u8; 3];

/// Errors at the ends of the ramp; it is logarithmic.
const LEAST: f64 = 1e-5;
const MOST: f64 = 1.0;

/// Viridis (van der Walt and Smith 2015), whose steps look equally large, at ten even places.
const VIRIDIS: [Rgb; 10] = [
    [0x44, 0x01, 0x54],
    [0x48, 0x28, 0x78],
    [0x3e, 0x49, 0x89],
    [0x31, 0x68, 0x8e],
    [0x26, 0x82, 0x8e],
    [0x1f, 0x9e, 0x89],
    [0x35, 0xb7, 0x79],
    [0x6d, 0xcd, 0x59],
    [0xb4, 0xde, 0x2c],
    [0xfd, 0xe7, 0x25],
];

/// The colour of an error, clamped to 0.001 % and 100 %.
pub(crate) fn of_error(error: f64) -> Rgb {
    let part = ((error.max(LEAST) / LEAST).ln() / (MOST / LEAST).ln()).clamp(0.0, 1.0);
    let at = part * (VIRIDIS.len() - 1) as f64;
    let index = (at as usize).min(VIRIDIS.len() - 2);
    let (low, high, f) = (VIRIDIS[index], VIRIDIS[index + 1], at - index as f64);
    [0, 1, 2].map(|channel| (f64::from(low[channel]) * (1.0 - f) + f64::from(high[channel]) * f).round() as u8)
}

/// Light on a screen, by Reinhard's curve L/(L + L₀) per channel, with L₀ twice the mean of the true picture: the same for
/// all methods of a scene.
pub(crate) fn of_light(light: [f64; 3], mean: f64) -> Rgb {
    light.map(|light| {
        let light = if light.is_nan() { 0.0 } else { light.clamp(0.0, f64::MAX / 2.0) };
        let shown = if light == 0.0 { 0.0 } else { light / (light + 2.0 * mean) };
        (srgb_from_linear(shown as f32) * 255.0).round() as u8
    })
}

/// The true picture for the eye.
pub(crate) fn of_truth(truth: &Truth) -> Vec<Rgb> {
    let mean = truth.mean();
    truth.pixels.iter().map(|pixel| of_light(pixel.to_array(), mean)).collect()
}

/// The ramp with its numbers, as an SVG.
pub(crate) fn legend() -> String {
    let stops: String = (0..=20)
        .map(|step| {
            let part = f64::from(step) / 20.0;
            let [r, g, b] = of_error(LEAST * (MOST / LEAST).powf(part));
            format!("<stop offset=\"{part}\" stop-color=\"#{r:02x}{g:02x}{b:02x}\"/>")
        })
        .collect();
    let labels = ["≤ 0.001 %", "0.01 %", "0.1 %", "1 %", "10 %", "≥ 100 %"];
    let ticks: String = labels
        .iter()
        .enumerate()
        .map(|(index, label)| {
            let x = 40 + 64 * index;
            format!("<path d=\"M{x} 14v5\" stroke=\"currentColor\"/><text x=\"{x}\" y=\"31\">{label}</text>")
        })
        .collect();
    format!(
        "<svg class=\"ramp\" viewBox=\"0 0 400 36\" width=\"400\" height=\"36\" role=\"img\" aria-label=\"Relative error \
         by colour, from 0.001 % (violet) to 100 % (yellow), logarithmic\"><defs><linearGradient id=\"ramp\">{stops}\
         </linearGradient></defs><rect x=\"40\" width=\"320\" height=\"14\" fill=\"url(#ramp)\"/>{ticks}</svg>"
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_larger_error_is_never_darker() {
        let luma = |[r, g, b]: Rgb| 0.2126 * f64::from(r) + 0.7152 * f64::from(g) + 0.0722 * f64::from(b);
        let ramp: Vec<f64> = (0..=100).map(|step| luma(of_error(10f64.powf(f64::from(step) / 20.0 - 5.0)))).collect();
        assert!(ramp.windows(2).all(|pair| pair[1] >= pair[0]), "{ramp:?}");
        assert_eq!(of_error(0.0), VIRIDIS[0]);
        assert_eq!(of_error(f64::INFINITY), VIRIDIS[9]);
    }

    #[test]
    fn every_light_has_a_colour() {
        assert_eq!(of_light([0.0, f64::INFINITY, f64::NAN], 1.0), [0, 255, 0]);
        assert_eq!(of_light([0.0, -1.0, 0.0], 0.0), [0, 0, 0]);
        let [dark, bright, ..] = of_light([0.1, 1.0, 0.0], 1.0);
        assert!(dark > 0 && bright > dark);
    }
}
