//! The outermost layer of a glTF file: a `.glb` container or plain JSON.

use super::fault::{Checked, Fault};
use crate::codes::{GLTF_CONTAINER, GLTF_VERSION};

/// Splits a file into its JSON and the binary chunk that a `.glb` may have.
pub(crate) fn split(bytes: &[u8]) -> Checked<(&[u8], Option<&[u8]>)> {
    if !bytes.starts_with(b"glTF") {
        return Ok((bytes, None));
    }
    let broken = |what: String| Fault::new(GLTF_CONTAINER, what);
    let word = |at: usize| bytes.get(at..at + 4).map(|b| u32::from_le_bytes([b[0], b[1], b[2], b[3]]));
    match word(4) {
        Some(2) => {}
        Some(version) => return Err(Fault::new(GLTF_VERSION, format!("container version {version}; only 2 is read"))),
        None => return Err(broken("the file ends inside its header".into())),
    }
    let announced = word(8).ok_or_else(|| broken("the file ends inside its header".into()))? as usize;
    if announced > bytes.len() {
        return Err(broken(format!("the header announces {announced} bytes, the file has {}", bytes.len())));
    }
    let (json, next) = chunk(&bytes[..announced], 12, *b"JSON")?;
    let mut json = json.ok_or_else(|| broken("the first chunk is not JSON".into()))?;
    // Chunks are padded with spaces, but some exporters pad with zeros.
    while let Some(rest) = json.strip_suffix(b"\0") {
        json = rest;
    }
    let binary = if next < announced { chunk(&bytes[..announced], next, *b"BIN\0")?.0 } else { None };
    Ok((json, binary))
}

/// The chunk at an offset if it is of that kind, and where the next one starts.
fn chunk(bytes: &[u8], at: usize, kind: [u8; 4]) -> Checked<(Option<&[u8]>, usize)> {
    let header = bytes.get(at..at + 8);
    let header =
        header.ok_or_else(|| Fault::new(GLTF_CONTAINER, format!("the file ends inside a chunk at byte {at}")))?;
    let length = u32::from_le_bytes([header[0], header[1], header[2], header[3]]) as usize;
    let start = at + 8;
    let body = bytes.get(start..start.saturating_add(length)).ok_or_else(|| {
        let message = format!("the chunk at byte {at} announces {length} bytes, {} are left", bytes.len() - start);
        Fault::new(GLTF_CONTAINER, message)
    })?;
    Ok(((header[4..] == kind).then_some(body), start + length))
}
