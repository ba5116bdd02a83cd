//! Goldens: pictures that a person has looked at and found right, and what each was made from.
//!
//! The goldens of `NAME.test.ron` lie in `NAME.goldens` beside it: an image for each port, and `goldens.ron`, which
//! says what each was made from. An image and its record are written one after the other, each whole or not at all;
//! the record holds a hash of the image, so that a half-done blessing is noticed.

mod record;

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

use half::f16;
use tyndall_graph::descriptor::Class;
use tyndall_image::{Error, Image, Meaning, Precision, srgb_from_linear, write_exr};

pub use record::{Record, Records};

use crate::file::{GOLDENS, SUFFIX};
use crate::picture::{MOST_SIDE, Picture};

/// The name of the file with the records.
pub const RECORDS: &str = "goldens.ron";

/// Why there is no golden to compare with.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum Missing {
    /// Nobody has blessed one.
    #[error("there is no golden `{}`: look at the picture, and bless it", .0.display())]
    File(PathBuf),
    /// Somebody has blessed one, and it is gone.
    #[error("there is no golden `{}`, and its record is still there: restore it, or bless it again", .0.display())]
    Gone(PathBuf),
    /// The file is there, and nothing says what it was made from.
    #[error("nothing says what the golden `{}` was made from: bless it", .0.display())]
    Record(PathBuf),
    /// The image is not the one that the record speaks of.
    #[error("the golden `{}` and its record do not belong together: bless it again", .0.display())]
    Torn(PathBuf),
    /// The image cannot be read.
    #[error("{0}")]
    Unreadable(String),
}

/// Why something was not written.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct NotWritten {
    /// The reason, with the path.
    pub what: String,
    /// The machine failed, a full disk say; else whoever asks for it has to change something.
    pub is_of_machine: bool,
}

impl From<Error> for NotWritten {
    fn from(error: Error) -> Self {
        Self { what: error.to_string(), is_of_machine: error.exit_code() == 3 }
    }
}

/// The name of the golden of a port: with the number of the frame where the test looks at several.
pub fn key(port: &str, frame: u32, several: bool) -> String {
    if several { format!("{port}.{frame:04}") } else { port.to_owned() }
}

/// The file name of a golden.
pub fn file_name(key: &str, class: Class) -> String {
    format!("{key}.{}", if class == Class::Display { "png" } else { "exr" })
}

/// Reads the golden of a picture that has the size and class of `like`.
///
/// # Errors
/// Why there is none.
pub fn read(folder: &Path, key: &str, records: &Records, like: &Picture) -> Result<Picture, Missing> {
    let path = folder.join(file_name(key, like.class));
    let bytes = std::fs::read(&path).map_err(|error| match error.kind() {
        std::io::ErrorKind::NotFound if records.get(key).is_some() => Missing::Gone(path.clone()),
        std::io::ErrorKind::NotFound => Missing::File(path.clone()),
        _ => Missing::Unreadable(format!("the golden `{}` cannot be read: {error}", path.display())),
    })?;
    let record = records.get(key).ok_or_else(|| Missing::Record(path.clone()))?;
    if record.content != record::content_hash(&bytes) {
        return Err(Missing::Torn(path));
    }
    let kind = tyndall_image::supported(&path).map_err(|error| Missing::Unreadable(error.to_string()))?;
    let image =
        tyndall_image::decode_exact(&path, kind, &bytes).map_err(|error| Missing::Unreadable(error.to_string()))?;
    Ok(Picture::new(unfolded(image, like), like.class))
}

/// Linear light of a file as a port of this class has it: encoded sRGB where it is for the eye.
pub(crate) fn as_port(mut image: Image<f64>, class: Class) -> Image<f64> {
    if class == Class::Display {
        let channels = image.channels as usize;
        let light = image.data.iter_mut().enumerate().filter(|(index, _)| index % channels != 3);
        light.for_each(|(_, value)| *value = f64::from(srgb_from_linear(*value as f32)));
    }
    image
}

/// As a file has it, back to layers and to encoded sRGB.
fn unfolded(mut image: Image<f64>, like: &Picture) -> Image<f64> {
    if like.class == Class::Display {
        image = as_port(image, like.class);
        // Codes of 8 bits come back as the codes that they were.
        image.data.iter_mut().for_each(|value| *value = f64::from((*value * 255.0).round() as f32 / 255.0));
    }
    let layers = like.image.layers;
    if layers > 1 && image.height.is_multiple_of(layers) {
        image.height /= layers;
        image.layers = layers;
    }
    image
}

/// Writes the golden of a picture without loss: in half precision where every number survives that, else as floats, and
/// whole numbers beyond these as such. So a pass that is run alone gets from goldens what it gets from the passes before it.
///
/// # Errors
/// Where it is larger than a golden may be, no file holds its numbers, or it cannot be written.
pub fn write(folder: &Path, key: &str, picture: &Picture) -> Result<PathBuf, NotWritten> {
    let Image { width, height, layers, .. } = picture.image;
    if !picture.fits_golden() {
        let what = format!(
            "{width}x{height}x{layers} texels are too many for a golden: {MOST_SIDE}x{MOST_SIDE} in all layers at most"
        );
        return Err(NotWritten { what, is_of_machine: false });
    }
    let path = folder.join(file_name(key, picture.class));
    let folded = Image { height: height * layers, layers: 1, ..picture.image.clone() };
    match picture.class {
        Class::Display => tyndall_image::write(&path, &folded.floats(), Meaning::Display),
        Class::Color => write_exr(&path, &folded, Meaning::Color, precision(&folded)?),
        _ => write_exr(&path, &folded, Meaning::Data, precision(&folded)?),
    }?;
    Ok(path)
}

/// The least precision that every number survives.
fn precision(image: &Image<f64>) -> Result<Precision, NotWritten> {
    let survives =
        |rounded: &dyn Fn(f64) -> f64| image.data.iter().all(|value| rounded(*value).to_bits() == value.to_bits());
    let as_half = |value| f16::from_f64(value).to_f64();
    let as_float = |value| f64::from(value as f32);
    let as_whole = |value| f64::from(value as u32);
    let ways: [(Precision, &dyn Fn(f64) -> f64); 3] =
        [(Precision::Half, &as_half), (Precision::Float, &as_float), (Precision::Whole, &as_whole)];
    let found = ways.into_iter().find(|(_, rounded)| survives(*rounded));
    found.map(|(precision, _)| precision).ok_or_else(|| NotWritten {
        what: "no image file holds negative whole numbers beyond 2^24: test this port by its properties".to_owned(),
        is_of_machine: false,
    })
}

/// Records of goldens that no tap claims and of which there is no file: what was made is gone, and so is who asked for it.
pub fn orphan_records(folder: &Path, claimed: &BTreeSet<String>, records: &Records) -> Vec<String> {
    let is_claimed = |key: &str| claimed.iter().any(|name| stem(name) == key);
    let is_there = |key: &str| ["exr", "png"].iter().any(|suffix| folder.join(format!("{key}.{suffix}")).exists());
    records.keys().filter(|key| !is_claimed(key) && !is_there(key)).map(str::to_owned).collect()
}

/// The name of a golden, by that of its file.
pub fn stem(file_name: &str) -> &str {
    file_name.rsplit_once('.').map_or(file_name, |(stem, _)| stem)
}

/// Files in a folder of goldens that no tap claims.
pub fn orphans(folder: &Path, claimed: &BTreeSet<String>) -> Vec<PathBuf> {
    let entries = std::fs::read_dir(folder).into_iter().flatten().flatten();
    let mut found: Vec<PathBuf> = entries
        .filter(|entry| {
            let name = entry.file_name().to_string_lossy().into_owned();
            name != RECORDS && !claimed.contains(&name)
        })
        .map(|entry| entry.path())
        .collect();
    found.sort();
    found
}

/// A file that only blessing leaves behind: an image, or what was left of one when it was interrupted. Others are
/// somebody's own.
pub fn may_be_dropped(path: &Path) -> bool {
    path.is_file() && path.extension().is_some_and(|suffix| ["exr", "png", "part"].iter().any(|known| suffix == *known))
}

/// The test file that a folder of goldens belongs to, if that is there.
pub fn owner(folder: &Path) -> Option<PathBuf> {
    let stem = folder.file_name()?.to_str()?.strip_suffix(GOLDENS)?;
    Some(folder.with_file_name(format!("{stem}{SUFFIX}"))).filter(|path| path.is_file())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::adapter::AdapterClass;
    use crate::metric::Metric;

    /// Writes a golden, and reads it again.
    fn again(picture: &Picture) -> Result<Picture, NotWritten> {
        let folder = tempfile::tempdir().unwrap();
        let path = write(folder.path(), "a.port", picture)?;
        let mut records = Records::default();
        records.set("a.port", Record::new(&path, AdapterClass::Other, None).unwrap());
        Ok(read(folder.path(), "a.port", &records, picture).unwrap())
    }

    /// One less or more is seen, also where a float could not tell.
    #[test]
    fn goldens_hold_whole_numbers() {
        let of = |numbers: [u32; 4]| Picture::new(Image::new(2, 1, 2, numbers.to_vec()), Class::Data);
        for numbers in [[0, 1, (1 << 24) + 1, u32::MAX], [0, 1, 2, 3]] {
            let picture = of(numbers);
            let golden = again(&picture).unwrap();
            assert!(Metric::Exact.judge(&picture, &golden).passed);
            let [a, b, c, d] = numbers;
            assert!(!Metric::Exact.judge(&of([a, b, c - 1, d]), &golden).passed);
            assert!(!Metric::Exact.judge(&of([a, b, c, d - 1]), &golden).passed);
        }
    }

    #[test]
    fn what_no_file_holds_is_refused() {
        let picture = Picture::new(Image::new(2, 1, 1, vec![-1, -16_777_217]), Class::Data);
        assert!(again(&picture).unwrap_err().what.contains("no image file holds"));
    }
}
