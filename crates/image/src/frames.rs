//! Frame numbers in file names.

use std::path::{Path, PathBuf};

/// Fewest `#` in a row that are replaced by a number: fewer may be part of somebody's file name.
const SHORTEST: usize = 4;

/// The file of one frame: each `####` (or longer run of `#`) of the path is replaced by the frame's number, padded
/// with zeros to the length of the run. A larger number is written in full. Other paths, and those that are not UTF-8,
/// are not changed.
pub fn frame_path(pattern: &Path, frame: u32) -> PathBuf {
    let Some(mut rest) = pattern.to_str() else { return pattern.to_owned() };
    let mut path = String::new();
    while let Some((start, end)) = run(rest) {
        path.push_str(&rest[..start]);
        path.push_str(&format!("{frame:0width$}", width = end - start));
        rest = &rest[end..];
    }
    path.push_str(rest);
    PathBuf::from(path)
}

/// Whether [`frame_path`] would put a number into `pattern`.
pub fn has_frame_number(pattern: &Path) -> bool {
    pattern.to_str().is_some_and(|text| run(text).is_some())
}

/// Start and end of the first run of `#` that is long enough.
fn run(text: &str) -> Option<(usize, usize)> {
    let start = text.find(&"#".repeat(SHORTEST))?;
    let length = text[start..].bytes().take_while(|&byte| byte == b'#').count();
    Some((start, start + length))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn path(pattern: &str, frame: u32) -> String {
        frame_path(Path::new(pattern), frame).to_string_lossy().into_owned()
    }

    #[test]
    fn numbers_are_padded_and_grow() {
        assert_eq!(path("out/fog.####.exr", 7), "out/fog.0007.exr");
        assert_eq!(path("out/fog.####.exr", 123_456), "out/fog.123456.exr");
        assert_eq!(path("a.######.png", 7), "a.000007.png");
        assert_eq!(path("####/####.png", 0), "0000/0000.png");
    }

    #[test]
    fn other_names_stay() {
        assert_eq!(path("take#2.###.exr", 7), "take#2.###.exr");
        assert!(!has_frame_number(Path::new("take###.exr")));
        assert!(has_frame_number(Path::new("a.####.exr")));
    }
}
