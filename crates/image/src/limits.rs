//! Limits on what a file may claim about itself before its content is checked.

use std::fs::File;
use std::io::Read;
use std::path::Path;

use crate::{Error, Kind};

/// Largest file that is read, bytes: four times an uncompressed 8192 × 8192 picture of four floats.
const LARGEST_FILE: u64 = 4 << 30;

/// Largest side of a picture, pixels: twice the largest texture of today's graphics cards.
const LARGEST_SIDE: u64 = 32_768;

/// Most numbers of one image: 8192 × 8192 of four channels, 1 GiB.
const MOST_NUMBERS: u64 = 1 << 28;

/// Largest factor by which a file may unpack. Deflate reaches 1032:1, and no other scheme of these formats exceeds it.
const LARGEST_EXPANSION: u64 = 2_048;

/// A picture may have so many times the pixels that its file holds, the others being 0, or [`MOST_EMPTY_NUMBERS`].
const MOST_EMPTY: u64 = 64;

/// 1920 × 1080 of four channels and more, 32 MiB.
const MOST_EMPTY_NUMBERS: u64 = 1 << 23;

/// The whole of the file at `path`.
pub(crate) fn read_file(path: &Path) -> Result<Vec<u8>, Error> {
    let failed = |error: &std::io::Error| Error::io(path, "cannot read", error);
    let metadata = std::fs::metadata(path).map_err(|error| failed(&error))?;
    if !metadata.is_file() {
        let what = if metadata.is_dir() { "a folder" } else { "not a regular file" };
        return Err(Error::new(Kind::Usage, path, format!("cannot read: it is {what}")));
    }
    if metadata.len() > LARGEST_FILE {
        return Err(Error::new(
            Kind::Input,
            path,
            format!("the file is too large: {} bytes, at most {LARGEST_FILE} are read", metadata.len()),
        ));
    }
    let mut bytes = Vec::new();
    let file = File::open(path).map_err(|error| failed(&error))?;
    file.take(LARGEST_FILE).read_to_end(&mut bytes).map_err(|error| failed(&error))?;
    Ok(bytes)
}

/// How many numbers a picture of this size holds, if a file of `file_bytes` bytes can contain it.
///
/// `bytes_each` is the size of one number in the file, unpacked.
pub(crate) fn count(size: (u64, u64), channels: u64, bytes_each: u64, file_bytes: usize) -> Result<usize, String> {
    let (width, height) = size;
    if width == 0 || height == 0 || channels == 0 {
        return Err(format!("a picture of {width}x{height} pixels and {channels} channels is empty"));
    }
    if width > LARGEST_SIDE || height > LARGEST_SIDE {
        return Err(format!("{width}x{height} pixels are too many: at most {LARGEST_SIDE} on a side"));
    }
    let count = width * height * channels;
    if count > MOST_NUMBERS {
        return Err(format!(
            "{width}x{height} pixels of {channels} channels are too many: at most {MOST_NUMBERS} numbers"
        ));
    }
    if count * bytes_each > (file_bytes as u64).saturating_mul(LARGEST_EXPANSION) {
        return Err(format!("{width}x{height} pixels cannot come from a file of {file_bytes} bytes; it is damaged"));
    }
    Ok(count as usize)
}

/// Whether a picture of this size may be made of a file that holds only so many of its pixels.
pub(crate) fn window(size: (u64, u64), pixels: u64, channels: u64) -> Result<(), String> {
    let count = count(size, channels, 0, 0)? as u64;
    if count > MOST_EMPTY_NUMBERS && count > pixels.saturating_mul(channels).saturating_mul(MOST_EMPTY) {
        return Err(format!("of {}x{} pixels the file holds only {pixels}", size.0, size.1));
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_size_that_the_file_cannot_hold_is_refused() {
        assert_eq!(count((640, 480), 4, 4, 100_000).unwrap(), 640 * 480 * 4);
        assert!(count((640, 480), 4, 4, 1_000).unwrap_err().contains("damaged"));
        assert!(count((u64::from(u32::MAX), 1), 4, 4, usize::MAX).unwrap_err().contains("on a side"));
        assert!(count((32_000, 32_000), 4, 4, usize::MAX).unwrap_err().contains("too many"));
        assert!(count((0, 3), 4, 4, 9).unwrap_err().contains("is empty"));
    }

    #[test]
    fn a_folder_is_no_file() {
        assert!(read_file(&std::env::temp_dir()).unwrap_err().to_string().contains("a folder"));
    }
}
