//! Light for the eye, through one curve.

use tyndall_image::srgb_from_linear;
use tyndall_page::false_color::Rgb;

use crate::truth::Truth;

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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_light_has_a_colour() {
        assert_eq!(of_light([0.0, f64::INFINITY, f64::NAN], 1.0), [0, 255, 0]);
        assert_eq!(of_light([0.0, -1.0, 0.0], 0.0), [0, 0, 0]);
        let [dark, bright, ..] = of_light([0.1, 1.0, 0.0], 1.0);
        assert!(dark > 0 && bright > dark);
    }
}
