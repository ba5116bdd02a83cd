//! The test files under some paths.

use std::path::{Path, PathBuf};

use crate::file::{GOLDENS, SUFFIX};
use crate::golden;

/// What was found under some paths.
#[derive(Debug, Default, PartialEq, Eq)]
pub struct Found {
    /// Test files, sorted.
    pub tests: Vec<PathBuf>,
    /// Folders of goldens without a test, sorted.
    pub orphans: Vec<PathBuf>,
}

/// Finds the test files that the paths name or hold. Hidden folders, `target`, and links to folders are passed over.
///
/// # Errors
/// Paths that are not there, or are files of another kind.
pub fn discover(paths: &[PathBuf]) -> Result<Found, String> {
    let mut found = Found::default();
    for path in paths {
        if path.is_dir() {
            search(path, &mut found);
        } else if path.is_file() && path.to_string_lossy().ends_with(SUFFIX) {
            found.tests.push(path.clone());
        } else if path.is_file() {
            return Err(format!("{} is no test: its name does not end in {SUFFIX}", path.display()));
        } else {
            return Err(format!("there is no file or folder {}", path.display()));
        }
    }
    found.tests.sort();
    found.tests.dedup();
    found.orphans.sort();
    found.orphans.dedup();
    Ok(found)
}

fn search(folder: &Path, found: &mut Found) {
    for entry in std::fs::read_dir(folder).into_iter().flatten().flatten() {
        let (path, name) = (entry.path(), entry.file_name().to_string_lossy().into_owned());
        let is_folder = entry.file_type().is_ok_and(|kind| kind.is_dir());
        if is_folder && name.ends_with(GOLDENS) {
            if golden::owner(&path).is_none() {
                found.orphans.push(tidy(&path));
            }
        } else if is_folder && !name.starts_with('.') && name != "target" {
            search(&path, found);
        } else if name.ends_with(SUFFIX) && path.is_file() {
            found.tests.push(tidy(&path));
        }
    }
}

/// Without a leading `./`.
fn tidy(path: &Path) -> PathBuf {
    path.strip_prefix(".").unwrap_or(path).to_owned()
}
