//! Buffers and images outside the JSON: `data:` URIs and files in the glTF file's own folder, nothing else.

use std::fs;
use std::path::{Path, PathBuf};

use base64::Engine;

use super::fault::{Checked, Fault};
use crate::codes::{GLTF_MISSING_FILE, GLTF_OUTSIDE_FOLDER, GLTF_TOO_LARGE, GLTF_URI};

/// Largest file that is read, bytes.
const LARGEST_FILE: u64 = 1 << 30;

/// The folder of a glTF file.
pub(crate) struct Folder {
    path: PathBuf,
    /// Every file read from it, for those who watch files.
    pub read: Vec<PathBuf>,
}

impl Folder {
    pub fn of(file: &Path) -> Folder {
        let path = file.parent().filter(|p| !p.as_os_str().is_empty()).unwrap_or(Path::new("."));
        Folder { path: path.to_owned(), read: Vec::new() }
    }

    /// The bytes behind a URI.
    pub fn fetch(&mut self, uri: &str) -> Checked<Vec<u8>> {
        match scheme(uri) {
            Some(scheme) if scheme.eq_ignore_ascii_case("data") => data(&uri[5..]),
            Some(scheme) => {
                let message =
                    format!("URI scheme {scheme:?}; only files of the glTF file's folder and data: URIs are read");
                Err(Fault::new(GLTF_URI, message))
            }
            None => self.file(uri),
        }
    }

    fn file(&mut self, uri: &str) -> Checked<Vec<u8>> {
        let decoded = percent_decoded(uri)?;
        let name = String::from_utf8(decoded).map_err(|_| Fault::new(GLTF_URI, format!("URI {uri:?} is not UTF-8")))?;
        let outside = || Fault::new(GLTF_OUTSIDE_FOLDER, format!("URI {uri:?} leaves the glTF file's folder"));
        if !stays_inside(&name) {
            return Err(outside());
        }
        let path = self.path.join(&name);
        let missing = |error: std::io::Error| Fault::new(GLTF_MISSING_FILE, format!("{name:?}: {error}"));
        let real = path.canonicalize().map_err(missing)?;
        let folder = self.path.canonicalize().map_err(missing)?;
        // Compared after following links: a link in the folder must not lead out of it either.
        if !real.starts_with(&folder) {
            return Err(outside());
        }
        let bytes = read(&real).map_err(|fault| Fault { message: format!("{name:?}: {}", fault.message), ..fault })?;
        self.read.push(path);
        Ok(bytes)
    }
}

/// Reads a regular file of bounded size.
pub(crate) fn read(path: &Path) -> Checked<Vec<u8>> {
    let missing = |error: std::io::Error| Fault::new(GLTF_MISSING_FILE, error.to_string());
    let metadata = fs::metadata(path).map_err(missing)?;
    if !metadata.is_file() {
        return Err(Fault::new(GLTF_MISSING_FILE, "not a file"));
    }
    if metadata.len() > LARGEST_FILE {
        let message = format!("the file has {} bytes, more than the {LARGEST_FILE} that are read", metadata.len());
        return Err(Fault::new(GLTF_TOO_LARGE, message));
    }
    fs::read(path).map_err(missing)
}

/// The scheme of a URI that has one (RFC 3986, 3.1); a drive letter counts as one.
fn scheme(uri: &str) -> Option<&str> {
    let (scheme, _) = uri.split_once(':')?;
    let mut characters = scheme.chars();
    let starts = characters.next().is_some_and(|c| c.is_ascii_alphabetic());
    (starts && characters.all(|c| c.is_ascii_alphanumeric() || "+-.".contains(c))).then_some(scheme)
}

/// Whether a relative path stays below where it starts, whichever of the two separators is used.
fn stays_inside(path: &str) -> bool {
    let mut depth = 0;
    let starts_at_root = path.starts_with(['/', '\\']);
    let is_drive = path.as_bytes().get(1) == Some(&b':');
    !starts_at_root
        && !is_drive
        && !path.contains('\0')
        && path.split(['/', '\\']).all(|part| {
            depth += match part {
                "" | "." => 0,
                ".." => -1,
                _ => 1,
            };
            depth >= 0
        })
}

fn percent_decoded(text: &str) -> Checked<Vec<u8>> {
    let mut bytes = text.bytes();
    let mut decoded = Vec::with_capacity(text.len());
    while let Some(byte) = bytes.next() {
        let digit = |b: Option<u8>| b.and_then(|b| (b as char).to_digit(16));
        decoded.push(match byte {
            b'%' => match (digit(bytes.next()), digit(bytes.next())) {
                (Some(high), Some(low)) => (high * 16 + low) as u8,
                _ => return Err(Fault::new(GLTF_URI, "a % is not followed by two hexadecimal digits")),
            },
            byte => byte,
        });
    }
    Ok(decoded)
}

/// The part of a `data:` URI after the scheme (RFC 2397).
fn data(rest: &str) -> Checked<Vec<u8>> {
    let (kind, content) = rest.split_once(',').ok_or_else(|| Fault::new(GLTF_URI, "data: URI without a comma"))?;
    if kind.ends_with(";base64") {
        let decoded = base64::engine::general_purpose::STANDARD.decode(content);
        decoded.map_err(|error| Fault::new(GLTF_URI, format!("data: URI: {error}")))
    } else {
        percent_decoded(content)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn paths_that_leave() {
        for inside in ["a.bin", "textures/a.png", "a/../b.png", "./a", "a..b", "..."] {
            assert!(stays_inside(inside), "{inside}");
        }
        for outside in ["../a", "a/../../b", "/etc/passwd", "\\a", "a\\..\\..\\b", "..", "C:a", "a\0b"] {
            assert!(!stays_inside(outside), "{outside}");
        }
    }

    #[test]
    fn schemes_and_data() {
        assert_eq!(scheme("http://x/y"), Some("http"));
        assert_eq!(scheme("a/b:c"), None);
        let mut folder = Folder::of(Path::new("x.gltf"));
        assert_eq!(folder.fetch("data:application/octet-stream;base64,AQID").ok(), Some(vec![1, 2, 3]));
        assert_eq!(folder.fetch("data:,a%20b").ok(), Some(b"a b".to_vec()));
        for (uri, code) in [
            ("http://x/y", GLTF_URI),
            ("file:///etc/passwd", GLTF_URI),
            ("%2e%2e/x", GLTF_OUTSIDE_FOLDER),
            ("%2fetc/passwd", GLTF_OUTSIDE_FOLDER),
            ("a%2", GLTF_URI),
            ("data:;base64,*", GLTF_URI),
            ("data:x", GLTF_URI),
            ("nowhere.bin", GLTF_MISSING_FILE),
        ] {
            assert_eq!(folder.fetch(uri).err().map(|f| f.code.0), Some(code.0), "{uri}");
        }
    }
}
