//! What can go wrong with a file, and who can correct it.

use std::io;
use std::path::{Path, PathBuf};

/// Why an image file could not be read or written. Its text begins with the file's path.
#[derive(Debug, thiserror::Error)]
#[error("{}: {message}", path.display())]
pub struct Error {
    kind: Kind,
    path: PathBuf,
    message: String,
}

/// Where the cause of an [`Error`] lies.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// The path or the request is wrong: an unknown suffix, a folder, a missing file, one that may not be read.
    Usage,
    /// The content of a file that was read is wrong.
    Input,
    /// The disk, or the user's share of it, is full.
    DiskFull,
    /// The machine failed otherwise.
    Io,
}

impl Error {
    /// An error about the file `path`; `message` has no trailing dot.
    pub fn new(kind: Kind, path: &Path, message: impl Into<String>) -> Self {
        Self { kind, path: path.to_owned(), message: message.into() }
    }

    /// An error of the file system. `doing` says what was attempted: "cannot write".
    pub(crate) fn io(path: &Path, doing: &str, error: &io::Error) -> Self {
        Self::new(kind_of(error), path, format!("{doing}: {}", plain(error)))
    }

    /// Where the cause lies.
    pub fn kind(&self) -> Kind {
        self.kind
    }

    /// The file concerned.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// What is wrong, without the path.
    pub fn message(&self) -> &str {
        &self.message
    }

    /// The exit code that the error calls for: 2 for the user's input, 3 for the machine.
    pub fn exit_code(&self) -> u8 {
        match self.kind {
            Kind::Usage | Kind::Input => 2,
            Kind::DiskFull | Kind::Io => 3,
        }
    }
}

fn kind_of(error: &io::Error) -> Kind {
    use io::ErrorKind as K;
    match error.kind() {
        K::StorageFull | K::QuotaExceeded | K::FileTooLarge => Kind::DiskFull,
        K::NotFound
        | K::PermissionDenied
        | K::AlreadyExists
        | K::IsADirectory
        | K::NotADirectory
        | K::ReadOnlyFilesystem
        | K::InvalidFilename
        | K::InvalidInput => Kind::Usage,
        _ => Kind::Io,
    }
}

/// The system's message without the number that Rust appends to it.
fn plain(error: &io::Error) -> String {
    let text = error.to_string();
    let short = text.split(" (os error").next().unwrap_or_default();
    let mut letters = short.chars();
    letters.next().map_or(text.clone(), |first| first.to_lowercase().chain(letters).collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_full_disk_is_the_machine_and_a_missing_file_the_user() {
        let full = Error::io(Path::new("a.exr"), "cannot write", &io::Error::from(io::ErrorKind::StorageFull));
        assert_eq!((full.kind(), full.exit_code()), (Kind::DiskFull, 3));
        let missing = Error::io(Path::new("a.exr"), "cannot read", &io::Error::from_raw_os_error(2));
        assert_eq!((missing.kind(), missing.exit_code()), (Kind::Usage, 2));
        assert_eq!(missing.to_string(), "a.exr: cannot read: no such file or directory");
    }
}
