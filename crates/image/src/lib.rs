//! Images in memory and in files, and metrics that compare them.
//!
//! In memory an image is linear `f32` ([`Image`]), or of whole numbers (`Image<u32>`); what its channels mean
//! ([`Meaning`]) decides how a file names and encodes them. [`write()`] and [`read()`] choose the format by the suffix:
//! `.exr` (32-bit float or whole numbers, linear), `.png` (8-bit sRGB), `.hdr` (RGBE) and `.npy` (float32 or uint32, any
//! shape). A file appears whole or not at all ([`write_atomically`]).
//!
//! Invariants: row 0 is the top; a reader never panics and never allocates much more than the file can fill;
//! every error names its file.
//!
//! A `.exr` file is read as its display window: pixels outside its data window are 0, those outside its display window are
//! left out. The numbers of a `.hdr` file are divided by its EXPOSURE and COLORCORR, which makes radiance of them.
//!
//! Not supported: deep, subsampled or multi-view EXR, B44 and DWA compression, mip levels other than the first, ICC
//! profiles of PNG files.

mod atomic;
mod error;
mod exr_read;
mod exr_write;
mod folder;
mod frames;
mod hdr;
mod hdr_header;
mod image;
mod kind;
mod limits;
pub mod metrics;
mod npy;
mod png;
mod srgb;

pub use atomic::{Writer, resolved, write_atomically, write_bytes};
pub use error::{Error, Kind};
pub use exr_write::Precision;
pub use folder::NewFolder;
pub use frames::{frame_path, has_frame_number};
pub use image::{Image, Meaning, Number, Sample};
pub use kind::{FileKind, supported};
pub use npy::{Array, read_array, write_array};
pub use srgb::{linear_from_srgb, srgb_from_linear};

use std::path::Path;

use image::FromExact;

/// Writes `image` to `path`, in the format of the path's suffix, whole or not at all.
///
/// Missing parent folders are created. The meaning of the channels decides their names and encoding: see [`Meaning`].
///
/// # Errors
/// An unknown suffix, an image whose `data` does not fit its size, more than one layer in a format that has no layers
/// (all but `.npy`), and whatever the file system refuses.
pub fn write<T: Sample>(path: &Path, image: &Image<T>, meaning: Meaning) -> Result<(), Error> {
    let kind = supported(path)?;
    image.check(path)?;
    if kind != FileKind::Npy && image.layers != 1 {
        let message = format!("{} layers do not fit into one picture; write `.npy` instead", image.layers);
        return Err(Error::new(Kind::Usage, path, message));
    }
    match kind {
        FileKind::Exr => exr_write::write(path, image, meaning, T::PRECISION),
        FileKind::Png => png::write(path, &image.floats(), meaning),
        FileKind::Hdr => hdr::write(path, &image.floats(), meaning),
        FileKind::Npy => npy::write_image(path, image, meaning),
    }
}

/// `image` as the bytes of a `.png` file.
///
/// # Errors
/// An image whose `data` does not fit its size, or has more than one layer; `path` only names it in errors.
pub fn encode_png(path: &Path, image: &Image, meaning: Meaning) -> Result<Vec<u8>, Error> {
    image.check(path)?;
    if image.layers != 1 {
        return Err(Error::new(Kind::Usage, path, format!("{} layers do not fit into one picture", image.layers)));
    }
    let mut bytes = Vec::new();
    png::write_to(&mut bytes, image, meaning)
        .map_err(|error| Error::new(Kind::Input, path, format!("cannot be encoded: {error}")))?;
    Ok(bytes)
}

/// Writes `image` as an `.exr` file with numbers of this precision, whole or not at all.
///
/// # Errors
/// As [`write()`].
pub fn write_exr(path: &Path, image: &Image<f64>, meaning: Meaning, precision: Precision) -> Result<(), Error> {
    image.check(path)?;
    exr_write::write(path, image, meaning, precision)
}

/// Reads the image at `path`, in the format of the path's suffix, as linear numbers.
///
/// `.png` is read as sRGB (alpha as linear), the others as they are. An `.npy` file must have the
/// shape (height, width), (height, width, channels) or (layers, height, width, channels), with 1 to 4 channels;
/// [`read_array`] takes any.
///
/// # Errors
/// An unknown suffix, a file that cannot be read, and content that is broken, truncated or too large.
pub fn read(path: &Path) -> Result<Image, Error> {
    decode(path, supported(path)?, &limits::read_file(path)?)
}

/// As [`read()`], with every number exactly as the file holds it.
///
/// # Errors
/// As [`read()`].
pub fn read_exact(path: &Path) -> Result<Image<f64>, Error> {
    decode_exact(path, supported(path)?, &limits::read_file(path)?)
}

/// Decodes `bytes` as a file of `kind`; `path` only names it in errors.
///
/// # Errors
/// Content that is broken, truncated or too large.
pub fn decode(path: &Path, kind: FileKind, bytes: &[u8]) -> Result<Image, Error> {
    decode_as(path, kind, bytes)
}

/// As [`decode`], with every number exactly as the file holds it.
///
/// # Errors
/// As [`decode`].
pub fn decode_exact(path: &Path, kind: FileKind, bytes: &[u8]) -> Result<Image<f64>, Error> {
    decode_as(path, kind, bytes)
}

fn decode_as<T: FromExact>(path: &Path, kind: FileKind, bytes: &[u8]) -> Result<Image<T>, Error> {
    let floats = |image: Image| image.map(|number| T::from_exact(f64::from(number)));
    let image = match kind {
        FileKind::Exr => exr_read::decode(bytes),
        FileKind::Png => png::decode(bytes).map(floats),
        FileKind::Hdr => hdr::decode(bytes).map(floats),
        FileKind::Npy => npy::decode_image(bytes),
    };
    image.map_err(|message| Error::new(Kind::Input, path, message))
}
