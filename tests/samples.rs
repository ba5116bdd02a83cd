//! Reference pictures that this project did not compute: see `reference/README.md`.

use std::path::{Path, PathBuf};

use tyndall_image::metrics::{Percentiles, percentiles};
use tyndall_image::{Image, read_array};

use crate::desk::root;

/// A file of `tests/reference`.
pub fn reference(name: &str) -> PathBuf {
    root().join("tests/reference").join(name)
}

/// Pixels of a reference picture.
pub struct Samples(Vec<[f32; 5]>);

impl Samples {
    /// Those of a file.
    pub fn read(path: &Path) -> Self {
        let array = read_array(path).unwrap();
        assert!(array.shape[0] >= 1_000 && array.shape[1] == 5, "{}: {:?}", path.display(), array.shape);
        Self(array.data.as_chunks().0.to_vec())
    }

    /// How many pixels are black in a picture and not here.
    pub fn blackened(&self, picture: &Image) -> usize {
        let black = |sample: &&[f32; 5]| picture.pixel(sample[0] as u32, sample[1] as u32).unwrap()[..3] == [0.0; 3];
        self.0.iter().filter(|sample| sample[2..] != [0.0; 3]).filter(black).count()
    }

    /// Relative errors of a picture; where the reference is black the picture must be, too.
    pub fn errors(&self, picture: &Image) -> Percentiles {
        assert_eq!((picture.width, picture.height), (160, 120));
        let error = |sample: &[f32; 5], channel: usize| {
            let wanted = f64::from(sample[2 + channel]);
            let found = f64::from(picture.pixel(sample[0] as u32, sample[1] as u32).unwrap()[channel]);
            match (found - wanted).abs() {
                0.0 => 0.0,
                difference if difference.is_finite() => difference / wanted.abs(),
                _ => f64::INFINITY,
            }
        };
        let mut errors: Vec<f64> =
            self.0.iter().flat_map(|sample| [0, 1, 2].map(|channel| error(sample, channel))).collect();
        percentiles(&mut errors).unwrap()
    }
}

/// The largest relative error of a picture's sums over all pixels, of the three channels; the right ones stand in `sums`
/// under `name`.
pub fn sum_error(sums: &Path, name: &str, picture: &Image) -> f64 {
    let known: serde_json::Value = serde_json::from_slice(&std::fs::read(sums).unwrap()).unwrap();
    let error = |channel: usize| {
        let found: f64 = picture.data.chunks_exact(3).map(|pixel| f64::from(pixel[channel])).sum();
        (found / known[name][channel].as_f64().unwrap() - 1.0).abs()
    };
    [0, 1, 2].map(error).into_iter().fold(0.0, f64::max)
}
