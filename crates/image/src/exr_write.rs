//! OpenEXR out: 32-bit or 16-bit float, linear, lossless (ZIP).

use std::io;
use std::path::Path;

use exr::prelude::{AnyChannel, AnyChannels, Encoding, FlatSamples, Layer, LayerAttributes, WritableImage};
use half::f16;

use crate::{Error, Image, Meaning, linear_from_srgb, write_atomically};

/// How many bits a number of an `.exr` file has.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Precision {
    /// 16: rounded to 11 significant bits, up to 65504, infinity above.
    Half,
    /// 32: as it is.
    Float,
}

/// Writes the first layer of `image` with the channel names of `meaning`.
pub(crate) fn write(path: &Path, image: &Image, meaning: Meaning, precision: Precision) -> Result<(), Error> {
    let samples = |samples: Vec<f32>| match precision {
        Precision::Float => FlatSamples::F32(samples),
        Precision::Half => FlatSamples::F16(samples.into_iter().map(f16::from_f32).collect()),
    };
    write_atomically(path, |writer| {
        let channels = planes(image, meaning).into_iter();
        let channels = channels.map(|(name, numbers)| AnyChannel::new(name, samples(numbers))).collect();
        let size = (image.width as usize, image.height as usize);
        let layer = Layer::new(size, LayerAttributes::default(), Encoding::SMALL_LOSSLESS, AnyChannels::sort(channels));
        exr::prelude::Image::from_layer(layer).write().to_buffered(writer).map_err(io_error)
    })
}

/// The names and samples of the channels, one plane each.
fn planes(image: &Image, meaning: Meaning) -> Vec<(&'static str, Vec<f32>)> {
    let names = names(image.channels, meaning);
    let decode = meaning == Meaning::Display;
    let plane = |index: usize| {
        if index >= image.channels as usize {
            return vec![1.0; image.pixel_count()]; // alpha of an opaque image
        }
        let samples = image.data.iter().skip(index).step_by(image.channels as usize).copied();
        if decode && index < 3 { samples.map(linear_from_srgb).collect() } else { samples.collect() }
    };
    names.iter().enumerate().map(|(index, &name)| (name, plane(index))).collect()
}

/// Channel names for an image of `channels` channels; the contract's, by meaning.
fn names(channels: u32, meaning: Meaning) -> &'static [&'static str] {
    match (meaning, channels) {
        (Meaning::Scalar, _) | (_, 1) => &["Y"],
        (_, 2) => &["X", "Y"],
        (Meaning::Vector, _) | (Meaning::Data, 3) => &["X", "Y", "Z"],
        (Meaning::Color | Meaning::Display | Meaning::Data, _) => &["R", "G", "B", "A"],
    }
}

fn io_error(error: exr::error::Error) -> io::Error {
    match error {
        exr::error::Error::Io(error) => error,
        other => io::Error::other(other.to_string()),
    }
}
