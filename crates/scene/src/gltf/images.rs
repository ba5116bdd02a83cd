//! Pictures of a glTF file, decoded only where a drawn material needs them, within limits.

use std::collections::BTreeMap;
use std::io::Cursor;
use std::sync::Arc;

use image::{ImageFormat, ImageReader, RgbaImage};

use super::accessors::{Data, absent};
use super::fault::{At, Checked, Fault, element};
use super::files::Folder;
use crate::codes::{GLTF_IMAGE, GLTF_REFERENCE, GLTF_TOO_LARGE};

/// Longest side of a picture.
const LONGEST_SIDE: u32 = 16_384;
/// Texels of all pictures of a file together: 256 MiB.
const MOST_TEXELS: u64 = 1 << 26;
/// Deflate packs at most 1032 bytes into one; a PNG that announces more texels than that has fewer than it says.
const MOST_TEXELS_PER_BYTE: u64 = 8 * 1100;

/// Decodes pictures and remembers them.
pub(crate) struct Images<'a> {
    data: Data<'a>,
    folder: &'a mut Folder,
    known: BTreeMap<usize, Arc<RgbaImage>>,
    texels: u64,
}

impl<'a> Images<'a> {
    pub fn new(data: Data<'a>, folder: &'a mut Folder) -> Images<'a> {
        Images { data, folder, known: BTreeMap::new(), texels: 0 }
    }

    /// The picture with an index, as 8-bit RGBA.
    pub fn get(&mut self, index: usize) -> Checked<Arc<RgbaImage>> {
        if let Some(known) = self.known.get(&index) {
            return Ok(Arc::clone(known));
        }
        let json = self.data.root.images.get(index).ok_or_else(|| absent("image", index))?;
        let picture = self.decode(index).at(|| element("image", index, json.name.as_deref()))?;
        let picture = Arc::new(picture);
        self.known.insert(index, Arc::clone(&picture));
        Ok(picture)
    }

    fn decode(&mut self, index: usize) -> Checked<RgbaImage> {
        let json = &self.data.root.images[index];
        let fetched;
        let bytes = match (&json.uri, json.buffer_view) {
            (_, Some(view)) => self.data.view(view.value())?.0,
            (Some(uri), None) => {
                fetched = self.folder.fetch(uri)?;
                &fetched
            }
            (None, None) => return Err(Fault::new(GLTF_REFERENCE, "neither uri nor bufferView")),
        };
        let broken = |error: image::ImageError| Fault::new(GLTF_IMAGE, format!("cannot be decoded: {error}"));
        let format = match image::guess_format(bytes) {
            Ok(format @ (ImageFormat::Png | ImageFormat::Jpeg)) => format,
            _ => return Err(Fault::new(GLTF_IMAGE, "neither PNG nor JPEG")),
        };
        let reader = || ImageReader::with_format(Cursor::new(bytes), format);
        let (width, height) = reader().into_dimensions().map_err(broken)?;
        let texels = u64::from(width) * u64::from(height);
        if width.max(height) > LONGEST_SIDE || texels + self.texels > MOST_TEXELS {
            let message = format!(
                "{width}×{height}: a side may have {LONGEST_SIDE} texels, all pictures of a file together {MOST_TEXELS}"
            );
            return Err(Fault::new(GLTF_TOO_LARGE, message));
        }
        if texels > MOST_TEXELS_PER_BYTE * bytes.len() as u64 {
            return Err(Fault::new(GLTF_IMAGE, format!("{} bytes cannot hold {width}×{height} texels", bytes.len())));
        }
        self.texels += texels;
        Ok(reader().decode().map_err(broken)?.into_rgba8())
    }
}
