//! The test files under some paths.

use std::collections::BTreeSet;
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
/// A file that is named twice, in two ways, is found once.
///
/// # Errors
/// Paths that are not there, or are files of another kind; folders that are called like a test.
pub fn discover(paths: &[PathBuf]) -> Result<Found, String> {
    let mut found = Found::default();
    for path in paths {
        if path.is_dir() && path.to_string_lossy().ends_with(SUFFIX) {
            return Err(format!("{} is called like a test, and is a folder", path.display()));
        } else if path.is_dir() {
            search(path, &mut found)?;
        } else if path.is_file() && path.to_string_lossy().ends_with(SUFFIX) {
            found.tests.push(tidy(path));
        } else if path.is_file() {
            return Err(format!("{} is not a test: its name does not end in {SUFFIX}", path.display()));
        } else {
            return Err(format!("there is no file or folder {}", path.display()));
        }
    }
    found.tests.sort();
    let mut known = BTreeSet::new();
    found.tests.retain(|path| known.insert(place(path)));
    found.orphans.sort();
    found.orphans.dedup();
    Ok(found)
}

fn search(folder: &Path, found: &mut Found) -> Result<(), String> {
    let entries =
        std::fs::read_dir(folder).map_err(|error| format!("cannot look into {}: {error}", folder.display()))?;
    for entry in entries.flatten() {
        let (path, name) = (entry.path(), entry.file_name().to_string_lossy().into_owned());
        let is_folder = entry.file_type().is_ok_and(|kind| kind.is_dir());
        if is_folder && name.ends_with(GOLDENS) {
            if golden::owner(&path).is_none() {
                found.orphans.push(tidy(&path));
            }
        } else if is_folder && name.ends_with(SUFFIX) {
            return Err(format!("{} is called like a test, and is a folder", path.display()));
        } else if is_folder && !name.starts_with('.') && name != "target" {
            search(&path, found)?;
        } else if name.ends_with(SUFFIX) && path.is_file() {
            found.tests.push(tidy(&path));
        }
    }
    Ok(())
}

/// The folder that a test lies in, however it was named, and its name there: a link is a test of its own.
fn place(path: &Path) -> (PathBuf, PathBuf) {
    let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."));
    let name = path.file_name().map_or_else(|| path.to_owned(), PathBuf::from);
    (folder.canonicalize().unwrap_or_else(|_| folder.to_owned()), name)
}

/// Without a leading `./`.
fn tidy(path: &Path) -> PathBuf {
    path.strip_prefix(".").unwrap_or(path).to_owned()
}
