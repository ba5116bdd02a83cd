//! Radiance RGBE: three mantissas of 8 bits with a common exponent; linear, no alpha, no NaN, no negative numbers.

use std::io::{Read, Write};
use std::path::Path;

use image::DynamicImage;
use image::codecs::hdr::HdrDecoder;

use crate::hdr_header::Header;
use crate::{Error, Image, Meaning, limits, linear_from_srgb, write_atomically};

/// The largest number of the format: mantissa 255, exponent 255.
const LARGEST: f32 = 255.0 / 256.0 * 1.701_411_8e38;

/// Writes the colours of the first layer; a scalar becomes grey. NaN and negative numbers are written as 0, infinity
/// as the format's largest number. Lines are not run-length encoded.
pub(crate) fn write(path: &Path, image: &Image, meaning: Meaning) -> Result<(), Error> {
    write_atomically(path, |writer| {
        write!(writer, "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y {} +X {}\n", image.height, image.width)?;
        for pixel in image.data.chunks_exact(image.channels as usize) {
            writer.write_all(&rgbe(color(pixel, meaning)))?;
        }
        Ok(())
    })
}

fn color(pixel: &[f32], meaning: Meaning) -> [f32; 3] {
    let color = match (meaning, pixel) {
        (Meaning::Scalar, &[y, ..]) | (_, &[y]) => [y, y, y],
        (_, &[x, y]) => [x, y, 0.0],
        (_, pixel) => [pixel[0], pixel[1], pixel[2]],
    };
    if meaning == Meaning::Display { color.map(linear_from_srgb) } else { color }
}

/// The four bytes of a colour (Ward 1991, "Real pixels": the common exponent is that of the largest component).
fn rgbe(color: [f32; 3]) -> [u8; 4] {
    // NaN stays NaN here, is dropped by `max`, and is cast to 0.
    let color = color.map(|value| value.clamp(0.0, LARGEST));
    let largest = color[0].max(color[1]).max(color[2]);
    if largest < 1e-38 {
        return [0; 4];
    }
    // largest = mantissa * 2^exponent, mantissa in 0.5..1; the number is normal, so its bits hold the exponent.
    let exponent = (largest.to_bits() >> 23) as i32 - 126;
    let scale = 256.0 * 2f64.powi(-exponent);
    let [r, g, b] = color.map(|value| (f64::from(value) * scale) as u8);
    [r, g, b, (exponent + 128) as u8]
}

/// The colours of a `.hdr` file, three channels.
pub(crate) fn decode(bytes: &[u8]) -> Result<Image, String> {
    let header = Header::read(bytes)?;
    let [width, height] = header.order.size(header.lines, header.length);
    let said = |error: image::ImageError| format!("not a valid HDR file: {error}");
    limits::count((u64::from(width), u64::from(height)), 3, 4, bytes.len())?;
    // The decoder knows one order; what any other means is worked out below.
    let plain = format!("#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y {} +X {}\n", header.lines, header.length);
    let decoder = HdrDecoder::new(plain.as_bytes().chain(header.pixels)).map_err(said)?;
    let stored = DynamicImage::from_decoder(decoder).map_err(said)?.into_rgb32f().into_raw();
    let mut data = Vec::with_capacity(stored.len());
    for [x, y] in (0..height).flat_map(|y| (0..width).map(move |x| [x, y])) {
        let at = 3 * header.order.index([x, y], header.lines, header.length);
        data.extend((0..3).map(|channel| (f64::from(stored[at + channel]) / header.scale[channel]) as f32));
    }
    Ok(Image::new(width, height, 3, data))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn number(bytes: [u8; 4]) -> f32 {
        f32::from(bytes[0]) * 2f32.powi(i32::from(bytes[3]) - 136)
    }

    #[test]
    fn the_largest_component_keeps_eight_bits() {
        for value in [1e-30f32, 0.001, 0.5, 0.999_999, 1.0, 3.7, 1e6, 1e38] {
            let read = number(rgbe([value, 0.0, 0.0]));
            assert!(read <= value && read >= value * (1.0 - 1.0 / 128.0), "{value} became {read}");
        }
    }

    #[test]
    fn values_that_the_format_lacks_are_replaced() {
        assert_eq!(rgbe([f32::NAN, -1.0, f32::NEG_INFINITY]), [0, 0, 0, 0]);
        assert_eq!(rgbe([f32::INFINITY, 0.0, 0.0]), [255, 0, 0, 255]);
        assert_eq!(rgbe([1e-40, 0.0, 0.0]), [0; 4]);
    }
}
