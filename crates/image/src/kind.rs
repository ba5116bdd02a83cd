//! The format that a path asks for.

use std::path::Path;

use crate::{Error, Kind};

/// A format that images are read from and written to, chosen by the suffix.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FileKind {
    /// OpenEXR, 32-bit float or whole numbers, linear.
    Exr,
    /// PNG, 8-bit sRGB.
    Png,
    /// Radiance RGBE, linear.
    Hdr,
    /// NumPy array, float32 or uint32.
    Npy,
}

impl FileKind {
    /// Every format, in the order in which messages list them.
    pub const ALL: [Self; 4] = [Self::Exr, Self::Png, Self::Hdr, Self::Npy];

    /// The suffix, without the dot.
    pub fn suffix(self) -> &'static str {
        match self {
            Self::Exr => "exr",
            Self::Png => "png",
            Self::Hdr => "hdr",
            Self::Npy => "npy",
        }
    }
}

/// The format that the suffix of `path` names, in any case.
///
/// # Errors
/// An unknown or missing suffix ([`Kind::Usage`]); the message lists the known ones.
pub fn supported(path: &Path) -> Result<FileKind, Error> {
    let suffix = path.extension().map(|suffix| suffix.to_string_lossy().to_ascii_lowercase());
    let found = suffix.as_deref().and_then(|suffix| FileKind::ALL.into_iter().find(|kind| kind.suffix() == suffix));
    found.ok_or_else(|| {
        let what = suffix.map_or("no suffix".to_owned(), |suffix| format!("unknown suffix `.{suffix}`"));
        Error::new(Kind::Usage, path, format!("{what}; available: `.exr`, `.png`, `.hdr`, `.npy`"))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn suffixes_are_known_in_any_case_and_others_are_listed() {
        assert_eq!(supported(Path::new("a/b.EXR")).unwrap(), FileKind::Exr);
        let text = supported(Path::new("a.tiff")).unwrap_err().to_string();
        assert_eq!(text, "a.tiff: unknown suffix `.tiff`; available: `.exr`, `.png`, `.hdr`, `.npy`");
        for kind in FileKind::ALL {
            assert!(text.contains(kind.suffix()));
        }
        assert!(supported(Path::new("exr")).unwrap_err().to_string().contains("no suffix"));
    }
}
