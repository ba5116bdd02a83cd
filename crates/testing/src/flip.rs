//! What a person sees of a difference, by NVIDIA's FLIP (Andersson, Nilsson, Akenine-Möller et al. 2020).

use nv_flip::{DEFAULT_PIXELS_PER_DEGREE, FlipImageRgb8};
use tyndall_graph::descriptor::Class;
use tyndall_image::{Image, metrics};

use crate::picture::Picture;

/// FLIP's figures, 0 (no difference) to 1.
pub(crate) struct Flip {
    pub mean: f64,
    pub p99: f64,
}

/// Compares two display pictures, layer by layer.
pub(crate) fn compare(actual: &Picture, expected: &Picture) -> Result<Flip, String> {
    let mut errors = map(actual, expected)?;
    let mean = errors.iter().sum::<f64>() / errors.len() as f64;
    let spread = metrics::percentiles(&mut errors).ok_or("the picture has no pixels")?;
    Ok(Flip { mean, p99: spread.p99 })
}

/// FLIP of every pixel, 0 (no difference) to 1.
pub(crate) fn map(actual: &Picture, expected: &Picture) -> Result<Vec<f64>, String> {
    if actual.class != Class::Display {
        return Err(format!("FLIP says what a person sees, and a {} port is for no eye", actual.class));
    }
    let [actual, expected] = [actual, expected].map(Picture::compared);
    metrics::same_shape(&actual, &expected).map_err(|error| error.to_string())?;
    if actual.data.iter().chain(&expected.data).any(|value| value.is_nan()) {
        return Err("NaN has no colour".to_owned());
    }
    let Image { width, height, layers, channels, .. } = actual;
    if ![1, 3].contains(&channels) {
        return Err(format!("{channels} channels are not a colour: FLIP compares grey, or red, green and blue"));
    }
    let texels = (width * height * channels) as usize;
    let layer = |image: &Image<f64>, layer: u32| {
        let numbers = &image.data[layer as usize * texels..][..texels];
        FlipImageRgb8::with_data(width, height, &rgb8(numbers, channels))
    };
    let errors = |at| nv_flip::flip(layer(&expected, at), layer(&actual, at), DEFAULT_PIXELS_PER_DEGREE).to_vec();
    Ok((0..layers).flat_map(errors).map(f64::from).collect())
}

fn rgb8(numbers: &[f64], channels: u32) -> Vec<u8> {
    let code = |value: &f64| (value.clamp(0.0, 1.0) * 255.0).round() as u8;
    numbers.iter().flat_map(|value| std::iter::repeat_n(code(value), if channels == 1 { 3 } else { 1 })).collect()
}
