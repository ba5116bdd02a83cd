//! PNG: writes 8-bit sRGB, reads 8- or 16-bit sRGB.

use std::io::{self, Cursor};
use std::path::Path;

use image::codecs::png::{CompressionType, FilterType, PngDecoder, PngEncoder};
use image::{ColorType, DynamicImage, ExtendedColorType, ImageDecoder, ImageEncoder};

use crate::srgb::byte;
use crate::{Error, Image, Meaning, limits, linear_from_srgb, srgb_from_linear, write_atomically};

/// Writes the first layer: grey for a scalar, else RGB or RGBA. Numbers are clamped to 0..1, NaN becomes 0; everything
/// but [`Meaning::Display`] is encoded as sRGB, except alpha.
pub(crate) fn write(path: &Path, image: &Image, meaning: Meaning) -> Result<(), Error> {
    write_atomically(path, |writer| write_to(writer, image, meaning))
}

pub(crate) fn write_to(writer: impl io::Write, image: &Image, meaning: Meaning) -> io::Result<()> {
    let (kind, bytes) = encode(image, meaning);
    let encoder = PngEncoder::new_with_quality(writer, CompressionType::Fast, FilterType::Adaptive);
    encoder.write_image(&bytes, image.width, image.height, kind).map_err(|error| match error {
        image::ImageError::IoError(error) => error,
        other => io::Error::other(other.to_string()),
    })
}

fn encode(image: &Image, meaning: Meaning) -> (ExtendedColorType, Vec<u8>) {
    let code = |value: &f32| byte(if meaning == Meaning::Display { *value } else { srgb_from_linear(*value) });
    let pixels = image.data.chunks_exact(image.channels as usize);
    match (meaning, image.channels) {
        (Meaning::Scalar, _) | (_, 1) => (ExtendedColorType::L8, pixels.map(|pixel| code(&pixel[0])).collect()),
        (_, 2) => (ExtendedColorType::Rgb8, pixels.flat_map(|pixel| [code(&pixel[0]), code(&pixel[1]), 0]).collect()),
        (Meaning::Color | Meaning::Display, 4) => {
            let alpha = |pixel: &[f32]| [code(&pixel[0]), code(&pixel[1]), code(&pixel[2]), byte(pixel[3])];
            (ExtendedColorType::Rgba8, pixels.flat_map(alpha).collect())
        }
        _ => (ExtendedColorType::Rgb8, pixels.flat_map(|pixel| [0, 1, 2].map(|index| code(&pixel[index]))).collect()),
    }
}

/// The linear numbers of a `.png` file: 1 channel for grey, else 3 or 4.
pub(crate) fn decode(bytes: &[u8]) -> Result<Image, String> {
    let said = |error: image::ImageError| format!("not a valid PNG file: {error}");
    let decoder = PngDecoder::new(Cursor::new(bytes)).map_err(said)?;
    let (width, height) = decoder.dimensions();
    let color = decoder.color_type();
    limits::count((u64::from(width), u64::from(height)), u64::from(color.channel_count()), 1, bytes.len())?;
    let image = DynamicImage::from_decoder(decoder).map_err(said)?;
    let (channels, data) = match color {
        ColorType::L8 | ColorType::L16 => (1, linear(image.into_luma16().into_raw(), 1)),
        ColorType::Rgb8 | ColorType::Rgb16 => (3, linear(image.into_rgb16().into_raw(), 3)),
        _ => (4, linear(image.into_rgba16().into_raw(), 4)),
    };
    Ok(Image::new(width, height, channels, data))
}

/// Codes of 16 bits (those of 8 bits were multiplied by 257) as linear numbers.
fn linear(codes: Vec<u16>, channels: usize) -> Vec<f32> {
    let value = |(index, code): (usize, u16)| {
        let encoded = f32::from(code) / 65_535.0;
        if channels == 4 && index % 4 == 3 { encoded } else { linear_from_srgb(encoded) }
    };
    codes.into_iter().enumerate().map(value).collect()
}
