//! Writing OpenEXR: 32-bit or 16-bit float or whole numbers of 32 bits, linear, lossless (ZIP).

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
    /// 32, as a float.
    Float,
    /// 32, as a whole number from 0.
    Whole,
}

/// Writes the first layer of `image` with the channel names of `meaning`.
pub(crate) fn write<T: Copy + Into<f64>>(
    path: &Path,
    image: &Image<T>,
    meaning: Meaning,
    precision: Precision,
) -> Result<(), Error> {
    write_atomically(path, |writer| {
        let plane =
            |(index, name): (usize, &&'static str)| AnyChannel::new(*name, samples(image, meaning, index, precision));
        let channels = names(image.channels, meaning).iter().enumerate().map(plane).collect();
        let size = (image.width as usize, image.height as usize);
        let layer = Layer::new(size, LayerAttributes::default(), Encoding::SMALL_LOSSLESS, AnyChannels::sort(channels));
        exr::prelude::Image::from_layer(layer).write().to_buffered(writer).map_err(io_error)
    })
}

/// One channel of every pixel; 1 where the image has none, which is the alpha of an opaque image.
fn samples<T: Copy + Into<f64>>(
    image: &Image<T>,
    meaning: Meaning,
    channel: usize,
    precision: Precision,
) -> FlatSamples {
    let channels = image.channels as usize;
    let is_encoded = meaning == Meaning::Display && channel < 3;
    let numbers = (0..image.pixel_count()).map(|pixel| match image.data.get(pixel * channels + channel) {
        _ if channel >= channels => 1.0,
        Some(&number) if is_encoded => f64::from(linear_from_srgb(number.into() as f32)),
        Some(&number) => number.into(),
        None => 0.0,
    });
    match precision {
        Precision::Half => FlatSamples::F16(numbers.map(f16::from_f64).collect()),
        Precision::Float => FlatSamples::F32(numbers.map(|number| number as f32).collect()),
        Precision::Whole => FlatSamples::U32(numbers.map(|number| number as u32).collect()),
    }
}

/// Channel names for an image of `channels` channels, by meaning.
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
