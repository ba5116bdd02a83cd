//! What a person sees of a difference, by NVIDIA's FLIP (Andersson, Nilsson, Akenine-Möller et al. 2020).

use nv_flip::{DEFAULT_PIXELS_PER_DEGREE, FlipImageRgb8};
use tyndall_graph::descriptor::Class;
use tyndall_image::metrics;

use crate::picture::Picture;

/// FLIP's figures, 0 (no difference) to 1.
pub(crate) struct Flip {
    pub mean: f64,
    pub p99: f64,
}

/// Compares two display pictures.
pub(crate) fn compare(actual: &Picture, expected: &Picture) -> Result<Flip, String> {
    if actual.class != Class::Display {
        return Err(format!("FLIP says what a person sees, and a {} port is for no eye", actual.class));
    }
    let ((width, height), wanted) =
        ((actual.image.width, actual.image.height), (expected.image.width, expected.image.height));
    if (width, height) != wanted {
        return Err(format!("the picture is {width}x{height} and the expected one {}x{}", wanted.0, wanted.1));
    }
    if actual.image.data.iter().any(|value| value.is_nan()) {
        return Err("NaN has no colour".to_owned());
    }
    let image = |picture: &Picture| FlipImageRgb8::with_data(width, height, &rgb8(picture));
    let map = nv_flip::flip(image(expected), image(actual), DEFAULT_PIXELS_PER_DEGREE);
    let mut errors: Vec<f64> = map.to_vec().into_iter().map(f64::from).collect();
    let mean = errors.iter().sum::<f64>() / errors.len() as f64;
    let spread = metrics::percentiles(&mut errors).ok_or("the picture has no pixels")?;
    Ok(Flip { mean, p99: spread.p99 })
}

fn rgb8(picture: &Picture) -> Vec<u8> {
    picture.compared().data.iter().map(|value| (value.clamp(0.0, 1.0) * 255.0).round() as u8).collect()
}
