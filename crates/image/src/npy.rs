//! NumPy arrays (format version 1.0 out; 1.0 to 3.0 in): little-endian, C order, float32 or whole numbers of 32 bits out.

use std::io::Write;
use std::path::Path;

use half::f16;

use crate::image::{FromExact, Number, Sample};
use crate::{Error, Image, Kind, Meaning, limits, write_atomically};

/// Numbers of any shape, in C order (the last index runs fastest).
#[derive(Clone, Debug, PartialEq)]
pub struct Array<T = f32> {
    /// Length along each axis.
    pub shape: Vec<usize>,
    /// As many numbers as the product of `shape`.
    pub data: Vec<T>,
}

const MAGIC: &[u8] = b"\x93NUMPY";

/// Most axes that are read; NumPy itself allows 64.
const MOST_AXES: usize = 8;

/// Writes numbers as an array of `shape`, of float32, uint32 or int32 as they are: a buffer of `n` elements of `k` numbers
/// is `[n, k]`.
///
/// # Errors
/// If `data` does not fill the shape, or the file cannot be written.
pub fn write_array<T: Number>(path: &Path, shape: &[usize], data: &[T]) -> Result<(), Error> {
    if shape.iter().product::<usize>() != data.len() {
        let message = format!("{} numbers do not fill an array of {shape:?}", data.len());
        return Err(Error::new(Kind::Usage, path, message));
    }
    write_atomically(path, |writer| {
        writer.write_all(&header(T::NUMPY, shape))?;
        data.iter().try_for_each(|number| writer.write_all(&number.to_bytes()))
    })
}

/// Reads an array of float16, float32, float64, or whole numbers of 8 or 32 bits, little-endian, as float32.
///
/// # Errors
/// If the file cannot be read, is damaged, or is of another kind.
pub fn read_array(path: &Path) -> Result<Array, Error> {
    let bytes = limits::read_file(path)?;
    decode(&bytes).map_err(|message| Error::new(Kind::Input, path, message))
}

/// Shape (height, width) for a scalar, (height, width, channels) for a picture, (layers, height, width, channels)
/// else.
pub(crate) fn write_image<T: Sample>(path: &Path, image: &Image<T>, meaning: Meaning) -> Result<(), Error> {
    let kept = match meaning {
        Meaning::Scalar => 1,
        Meaning::Vector => 3,
        Meaning::Color | Meaning::Data | Meaning::Display => 4,
    };
    let image = image.first_channels(kept);
    let [layers, height, width, channels] =
        [image.layers, image.height, image.width, image.channels].map(|length| length as usize);
    match (layers, channels) {
        (1, 1) => write_array(path, &[height, width], &image.data),
        (1, _) => write_array(path, &[height, width, channels], &image.data),
        _ => write_array(path, &[layers, height, width, channels], &image.data),
    }
}

pub(crate) fn decode_image<T: FromExact>(bytes: &[u8]) -> Result<Image<T>, String> {
    let Array { shape, data } = decode(bytes)?;
    let (layers, height, width, channels) = match shape[..] {
        [height, width] => (1, height, width, 1),
        [height, width, channels @ 1..=4] => (1, height, width, channels),
        [layers, height, width, channels @ 1..=4] => (layers, height, width, channels),
        _ => return Err(format!("an array of {shape:?} is not an image: expected height, width, and 1 to 4 channels")),
    };
    if data.is_empty() {
        return Err(format!("an array of {shape:?} has no pixels"));
    }
    let [layers, height, width, channels] = [layers, height, width, channels].map(|length| length as u32);
    Ok(Image { width, height, layers, channels, data })
}

fn header(number: &str, shape: &[usize]) -> Vec<u8> {
    let lengths: Vec<String> = shape.iter().map(|length| format!("{length},")).collect();
    let shape = lengths.join(" ");
    // One axis keeps its comma, as Python wants; more have none at the end, as NumPy writes them.
    let shape = if lengths.len() > 1 { shape.trim_end_matches(',') } else { &shape };
    let mut text = format!("{{'descr': '{number}', 'fortran_order': False, 'shape': ({shape}), }}");
    let prefix = MAGIC.len() + 4;
    // The numbers begin at a multiple of 64; the line ends before them.
    let padding = 63 - (prefix + text.len()) % 64;
    text.extend(std::iter::repeat_n(' ', padding));
    text.push('\n');
    let mut bytes = MAGIC.to_vec();
    bytes.extend([1, 0]);
    bytes.extend((text.len() as u16).to_le_bytes());
    bytes.extend(text.bytes());
    bytes
}

fn decode<T: FromExact>(bytes: &[u8]) -> Result<Array<T>, String> {
    let (text, body) = split(bytes).ok_or("not a valid NumPy file: its header is damaged")?;
    let bad = |what: &str| format!("not a valid NumPy file: {what}");
    if entry(text, "fortran_order").is_none_or(|order| !order.starts_with("False")) {
        return Err("arrays in Fortran order are not supported".to_owned());
    }
    let shape = entry(text, "shape").and_then(shape_of).ok_or_else(|| bad("it has no shape"))?;
    let descr = entry(text, "descr").and_then(|entry| entry.strip_prefix('\'')?.split('\'').next());
    let (size, convert) = number_type(descr.ok_or_else(|| bad("it has no number type"))?)?;
    let count = shape.iter().try_fold(1usize, |product, &length| product.checked_mul(length));
    let wanted = count.and_then(|count| count.checked_mul(size)).ok_or_else(|| bad("its shape is too large"))?;
    let numbers = body.get(..wanted).ok_or_else(|| {
        format!("not a valid NumPy file: an array of {shape:?} takes {wanted} bytes, but there are {}", body.len())
    })?;
    Ok(Array { shape, data: numbers.chunks_exact(size).map(convert).map(T::from_exact).collect() })
}

/// The header's text and what follows it.
fn split(bytes: &[u8]) -> Option<(&str, &[u8])> {
    let rest = bytes.strip_prefix(MAGIC)?;
    let (&[major, _minor], rest) = rest.split_first_chunk::<2>()?;
    let (length, rest) = match major {
        1 => rest.split_first_chunk().map(|(&length, rest)| (u32::from(u16::from_le_bytes(length)), rest))?,
        2 | 3 => rest.split_first_chunk().map(|(&length, rest)| (u32::from_le_bytes(length), rest))?,
        _ => return None,
    };
    let (text, body) = rest.split_at_checked(length as usize)?;
    Some((std::str::from_utf8(text).ok()?, body))
}

/// What stands after `'name':` in the header's dictionary.
fn entry<'a>(text: &'a str, name: &str) -> Option<&'a str> {
    let (_, rest) = text.split_once(&format!("'{name}'"))?;
    Some(rest.trim_start().strip_prefix(':')?.trim_start())
}

fn shape_of(text: &str) -> Option<Vec<usize>> {
    let (inside, _) = text.strip_prefix('(')?.split_once(')')?;
    let lengths = inside.split(',').map(str::trim).filter(|length| !length.is_empty());
    let shape: Vec<usize> = lengths.take(MOST_AXES + 1).map(|length| length.parse().ok()).collect::<Option<_>>()?;
    (shape.len() <= MOST_AXES).then_some(shape)
}

type Convert = fn(&[u8]) -> f64;

/// Size in bytes of one number of the type `descr`, and what turns it into a float64, which holds each exactly.
fn number_type(descr: &str) -> Result<(usize, Convert), String> {
    fn read<const N: usize>(bytes: &[u8]) -> [u8; N] {
        bytes.first_chunk().copied().unwrap_or([0; N])
    }
    Ok(match descr {
        "<f2" => (2, |bytes| f16::from_le_bytes(read(bytes)).to_f64()),
        "<f4" => (4, |bytes| f64::from(f32::from_le_bytes(read(bytes)))),
        "<f8" => (8, |bytes| f64::from_le_bytes(read(bytes))),
        "|u1" | "|b1" => (1, |bytes| f64::from(read::<1>(bytes)[0])),
        "<u4" => (4, |bytes| f64::from(u32::from_le_bytes(read(bytes)))),
        "<i4" => (4, |bytes| f64::from(i32::from_le_bytes(read(bytes)))),
        _ => return Err(format!("numbers of type `{descr}` are not supported; `<f4` is")),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_header_is_numpys_own() {
        // numpy.save of zeros((2, 3), "<f4"), NumPy 2: 128 bytes before the numbers.
        let bytes = header("<f4", &[2, 3]);
        assert_eq!(bytes.len(), 128);
        assert_eq!(&bytes[..10], b"\x93NUMPY\x01\x00v\x00");
        assert!(bytes[10..].starts_with(b"{'descr': '<f4', 'fortran_order': False, 'shape': (2, 3), }  "));
        assert_eq!(bytes.last(), Some(&b'\n'));
        assert!(String::from_utf8_lossy(&header("<f4", &[7])).contains("'shape': (7,), }"));
    }

    #[test]
    fn shapes_that_overflow_or_lie_are_refused() {
        let with = |shape: &str| {
            let text = format!("{{'descr': '<f4', 'fortran_order': False, 'shape': {shape}, }}\n");
            let mut bytes = MAGIC.to_vec();
            bytes.extend([1, 0, text.len() as u8, 0]);
            bytes.extend(text.bytes());
            bytes.extend([0; 16]);
            decode::<f32>(&bytes)
        };
        assert_eq!(with("(4,)").unwrap().data, [0.0; 4]);
        assert_eq!(with("(2, 2)").unwrap().shape, [2, 2]);
        assert_eq!(with("()").unwrap().data.len(), 1);
        assert!(with("(5,)").unwrap_err().contains("takes 20 bytes, but there are 16"));
        assert!(with("(18446744073709551615, 2)").unwrap_err().contains("too large"));
        assert!(with("(0, 18446744073709551615)").unwrap().data.is_empty());
        assert!(with("(-1,)").is_err());
        assert!(with("(1,1,1,1,1,1,1,1,1)").is_err());
    }
}
