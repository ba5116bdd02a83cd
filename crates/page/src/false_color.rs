//! Colours for numbers: relative errors through a perceptually uniform colour map, and differences in multiples of a
//! tolerance.

/// 8-bit sRGB.
pub type Rgb = [u8; 3];

/// Where there is no number.
pub const NOT_A_NUMBER: Rgb = [255, 0, 255];

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

/// The colour of a relative error, clamped to 0.001 % and 100 %.
pub fn of_error(error: f64) -> Rgb {
    let part = ((error.max(LEAST) / LEAST).ln() / (MOST / LEAST).ln()).clamp(0.0, 1.0);
    let at = part * (VIRIDIS.len() - 1) as f64;
    let index = (at as usize).min(VIRIDIS.len() - 2);
    let (low, high, f) = (VIRIDIS[index], VIRIDIS[index + 1], at - index as f64);
    [0, 1, 2].map(|channel| (f64::from(low[channel]) * (1.0 - f) + f64::from(high[channel]) * f).round() as u8)
}

/// The ramp of [`of_error`] with its numbers, as an SVG.
pub fn legend_of_errors() -> String {
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

/// The colour of a difference, in parts of a tolerance: black where there is none, blue below the tolerance, red beyond it,
/// yellow, and white at the largest one.
pub fn of_difference(excess: f64, largest: f64) -> Rgb {
    if !excess.is_finite() {
        return NOT_A_NUMBER;
    }
    if excess <= 1.0 {
        // From a hundredth of the tolerance.
        let part = (excess.max(1e-2).log10() + 2.0) / 2.0;
        return [0.1 * part, 0.3 * part, 0.9 * part].map(byte);
    }
    let part = (excess.ln() / largest.ln()).clamp(0.0, 1.0);
    let channel = |from: f64, to: f64| ((part - from) / (to - from)).clamp(0.0, 1.0);
    [0.6 + 0.4 * channel(0.0, 0.4), channel(0.1, 0.7), channel(0.7, 1.0)].map(byte)
}

fn byte(part: f64) -> u8 {
    (255.0 * part).round() as u8
}

/// The colours of what exceeds none, one, two, three and all of four limits.
pub const STEPS: [Rgb; 5] = [[20, 20, 26], [64, 90, 153], [217, 166, 38], [230, 80, 30], [255, 190, 200]];

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
    fn no_two_differences_look_alike() {
        let rises = |excesses: &[f64]| {
            let brightness = |excess: &f64| of_difference(*excess, 1e4).map(u32::from).iter().sum();
            let brightness: Vec<u32> = excesses.iter().map(brightness).collect();
            assert!(brightness.windows(2).all(|pair| pair[0] < pair[1]), "{brightness:?}");
        };
        rises(&[0.0, 0.1, 0.5, 1.0]);
        rises(&[1.1, 3.0, 30.0, 300.0, 1e4]);
        // The tolerance is where blue ends and red begins.
        let [red, _, blue] = of_difference(1.0, 1e4).map(u32::from);
        let [red_beyond, _, blue_beyond] = of_difference(1.001, 1e4).map(u32::from);
        assert!(blue > 3 * red && red_beyond > 3 * blue_beyond);
        assert_eq!((of_difference(0.0, 1e4), of_difference(1e4, 1e4)), ([0; 3], [255; 3]));
        assert_eq!(of_difference(f64::INFINITY, 1e4), NOT_A_NUMBER);
    }
}
