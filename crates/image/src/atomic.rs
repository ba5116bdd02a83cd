//! Files that appear whole or not at all.
//!
//! Data go to a temporary file in the folder of the target, which is flushed to the disk and then renamed to the target.
//! So a reader sees the old file or the new one, and a failure leaves the old one as it was.

use std::fs::{File, Permissions};
use std::io::{self, BufWriter, Seek, SeekFrom};
use std::path::{Component, Path, PathBuf};

use tempfile::NamedTempFile;

use crate::{Error, Kind};

/// What the function given to [`write_atomically`] writes to; it can seek.
pub type Writer<'a> = BufWriter<&'a File>;

/// Writes the file `path` by `write`, whole or not at all.
///
/// Missing parent folders are created. A new file gets the usual permissions, an existing one keeps its own. A symbolic
/// link is kept, and its target is replaced. A device, a pipe, or an open file of this process (`/dev/stdout`) is written to
/// once all data are there.
///
/// # Errors
/// If the path is a folder or may not be written (the user's fault), if the disk is full, or if `write` fails.
pub fn write_atomically(path: &Path, write: impl FnOnce(&mut Writer<'_>) -> io::Result<()>) -> Result<(), Error> {
    let failed = |error: &io::Error| Error::io(path, "cannot write", error);
    match target(path)? {
        Target::File { path: target, permissions } => {
            let folder = target.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."));
            std::fs::create_dir_all(folder).map_err(|error| failed(&error))?;
            replace(&target, folder, permissions, write)
        }
        Target::Device => stream(path, write),
    }
    .map_err(|error| failed(&error))
}

/// Writes `bytes` as the file `path`, whole or not at all: see [`write_atomically`].
///
/// # Errors
/// As [`write_atomically`].
pub fn write_bytes(path: &Path, bytes: &[u8]) -> Result<(), Error> {
    write_atomically(path, |writer| io::Write::write_all(writer, bytes))
}

/// Where a path leads: absolute, with links and `..` resolved as far as there are folders. Two paths to one file lead to one
/// place, also where the file is not there yet.
pub fn resolved(path: &Path) -> PathBuf {
    let absolute = std::path::absolute(path).unwrap_or_else(|_| path.to_owned());
    let mut resolved = PathBuf::new();
    for component in absolute.components() {
        match component {
            Component::ParentDir => drop(resolved.pop()),
            component => resolved.push(component),
        }
        if let Ok(real) = resolved.canonicalize() {
            resolved = real;
        }
    }
    resolved
}

enum Target {
    File { path: PathBuf, permissions: Option<Permissions> },
    Device,
}

/// What is at `path` now, links followed.
fn target(path: &Path) -> Result<Target, Error> {
    let refused = |what: &str| Err(Error::new(Kind::Usage, path, format!("cannot write: {what}")));
    if is_open_file(path) {
        return Ok(Target::Device);
    }
    match std::fs::metadata(path) {
        Err(error) if error.kind() == io::ErrorKind::NotFound => match path.file_name() {
            Some(_) => Ok(Target::File { path: path.to_owned(), permissions: None }),
            None => refused("it is not a file name"),
        },
        Err(error) => Err(Error::io(path, "cannot write", &error)),
        Ok(found) if found.is_dir() => refused("it is a folder"),
        Ok(found) if !found.is_file() => Ok(Target::Device),
        Ok(found) if found.permissions().readonly() => refused("the file is read-only"),
        Ok(found) => {
            let path = std::fs::canonicalize(path).map_err(|error| Error::io(path, "cannot write", &error))?;
            Ok(Target::File { path, permissions: Some(found.permissions()) })
        }
    }
}

/// Whether a path names a file that this process holds open, as `/dev/stdout` does. That may be a file wherever the shell
/// has sent it, and must not be replaced there.
fn is_open_file(path: &Path) -> bool {
    let mut path = path.to_owned();
    // Links in a row: as many as Linux follows.
    for _ in 0..40 {
        let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."));
        if folder.canonicalize().is_ok_and(|folder| folder.starts_with("/proc")) {
            return true;
        }
        match std::fs::read_link(&path) {
            Ok(target) => path = folder.join(target),
            Err(_) => return false,
        }
    }
    false
}

fn replace(
    target: &Path,
    folder: &Path,
    permissions: Option<Permissions>,
    write: impl FnOnce(&mut Writer<'_>) -> io::Result<()>,
) -> io::Result<()> {
    let temporary = temporary_file(folder)?;
    fill(temporary.as_file(), write)?;
    if let Some(permissions) = permissions {
        temporary.as_file().set_permissions(permissions)?;
    }
    temporary.as_file().sync_data()?;
    temporary.persist(target).map(drop).map_err(|error| error.error)
}

fn temporary_file(folder: &Path) -> io::Result<NamedTempFile> {
    let mut builder = tempfile::Builder::new();
    builder.prefix(".tyndall-").suffix(".part");
    // Without this the file would be the owner's alone; the process's mask still applies.
    #[cfg(unix)]
    builder.permissions(std::os::unix::fs::PermissionsExt::from_mode(0o666));
    builder.tempfile_in(folder)
}

fn stream(path: &Path, write: impl FnOnce(&mut Writer<'_>) -> io::Result<()>) -> io::Result<()> {
    let mut whole = tempfile::tempfile()?;
    fill(&whole, write)?;
    whole.seek(SeekFrom::Start(0))?;
    let mut device = File::options().write(true).open(path)?;
    io::copy(&mut whole, &mut device).map(drop)
}

fn fill(file: &File, write: impl FnOnce(&mut Writer<'_>) -> io::Result<()>) -> io::Result<()> {
    let mut writer = BufWriter::with_capacity(1 << 16, file);
    write(&mut writer)?;
    io::Write::flush(&mut writer)
}
