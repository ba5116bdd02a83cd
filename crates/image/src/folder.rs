//! Folders that appear whole or not at all.

use std::io;
use std::path::{Path, PathBuf};

use tempfile::TempDir;

use crate::{Error, Kind};

/// A folder that is being filled beside its target. It does not appear before [`NewFolder::persist`]; if it is dropped
/// before that, nothing is left of it.
#[derive(Debug)]
pub struct NewFolder {
    target: PathBuf,
    staging: TempDir,
}

impl NewFolder {
    /// Begins a folder that will appear at `target`. There may be an empty folder there already, or one that `may_replace`
    /// allows to be replaced.
    ///
    /// # Errors
    /// If something else is there, or nothing may be written beside it.
    pub fn begin(target: &Path, may_replace: impl Fn(&Path) -> bool) -> Result<Self, Error> {
        let failed = |error: io::Error| Error::io(target, "cannot write", &error);
        let refused = |why: &str| Err(Error::new(Kind::Usage, target, format!("cannot write: {why}")));
        if target.file_name().is_none() {
            return refused("it is not the name of a folder; name one to be created, such as out/report");
        }
        match std::fs::read_dir(target).map(|entries| entries.count() > 0) {
            Ok(true) if !may_replace(target) => {
                return refused("the folder holds other files; name one that is empty or does not exist yet");
            }
            Err(error) if error.kind() == io::ErrorKind::NotADirectory => {
                return refused("it is a file, not a folder");
            }
            Err(error) if error.kind() != io::ErrorKind::NotFound => return Err(failed(error)),
            _ => {}
        }
        let parent = target.parent().filter(|parent| !parent.as_os_str().is_empty()).unwrap_or(Path::new("."));
        std::fs::create_dir_all(parent).map_err(failed)?;
        let mut builder = tempfile::Builder::new();
        builder.prefix(".tyndall-").suffix(".part");
        // Without this the folder would be the owner's alone; the process's mask still applies.
        #[cfg(unix)]
        builder.permissions(std::os::unix::fs::PermissionsExt::from_mode(0o777));
        let staging = builder.tempdir_in(parent).map_err(failed)?;
        Ok(Self { target: target.to_owned(), staging })
    }

    /// Where to write.
    pub fn path(&self) -> &Path {
        self.staging.path()
    }

    /// Writes a file of the folder: `name` may go through folders in it.
    ///
    /// # Errors
    /// What the file system refuses.
    pub fn write(&self, name: &str, bytes: &[u8]) -> Result<(), Error> {
        let path = self.staging.path().join(name);
        let folder = path.parent().map_or(Ok(()), std::fs::create_dir_all);
        let written = folder.and_then(|()| std::fs::write(&path, bytes));
        written.map_err(|error| Error::io(&self.target.join(name), "cannot write", &error))
    }

    /// Puts the folder where it will stand, and what stood there away.
    ///
    /// # Errors
    /// What the file system refuses; then what stood there stands there still.
    pub fn persist(self) -> Result<(), Error> {
        let failed = |error: io::Error| Error::io(&self.target, "cannot write", &error);
        let before = self.staging.path().with_extension("before");
        let replaces = self.target.exists();
        if replaces {
            std::fs::rename(&self.target, &before).map_err(failed)?;
        }
        if let Err(error) = std::fs::rename(self.staging.path(), &self.target) {
            if replaces {
                std::fs::rename(&before, &self.target).map_err(failed)?;
            }
            return Err(failed(error));
        }
        if replaces {
            std::fs::remove_dir_all(&before).map_err(|error| Error::io(&before, "cannot delete", &error))?;
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn names(folder: &Path) -> Vec<String> {
        let entries = std::fs::read_dir(folder).unwrap();
        let mut names: Vec<String> = entries.map(|entry| entry.unwrap().file_name().into_string().unwrap()).collect();
        names.sort();
        names
    }

    #[test]
    fn nothing_is_seen_before_it_is_whole_and_nothing_is_left_of_what_is_dropped() {
        let desk = tempfile::tempdir().unwrap();
        let target = desk.path().join("deep/report");
        let folder = NewFolder::begin(&target, |_| false).unwrap();
        folder.write("a/b.txt", b"1").unwrap();
        assert!(!target.exists());
        drop(folder);
        assert!(names(&desk.path().join("deep")).is_empty());
        let folder = NewFolder::begin(&target, |_| false).unwrap();
        folder.write("a/b.txt", b"2").unwrap();
        folder.persist().unwrap();
        assert_eq!(std::fs::read(target.join("a/b.txt")).unwrap(), b"2");
        assert_eq!(names(&desk.path().join("deep")), ["report"]);
    }

    #[test]
    fn only_what_may_be_replaced_is() {
        let desk = tempfile::tempdir().unwrap();
        let target = desk.path().join("report");
        std::fs::create_dir(&target).unwrap();
        NewFolder::begin(&target, |_| false).unwrap().persist().unwrap();
        std::fs::write(target.join("mine.txt"), "mine").unwrap();
        let refused = NewFolder::begin(&target, |_| false).unwrap_err();
        assert!(refused.message().contains("holds other files"), "{refused}");
        let folder = NewFolder::begin(&target, |there| there.join("mine.txt").exists()).unwrap();
        folder.write("new.txt", b"new").unwrap();
        folder.persist().unwrap();
        assert_eq!(names(&target), ["new.txt"]);
        let file = NewFolder::begin(&target.join("new.txt"), |_| true).unwrap_err();
        assert!(file.message().contains("it is a file"), "{file}");
        assert_eq!(NewFolder::begin(Path::new("."), |_| true).unwrap_err().exit_code(), 2);
    }
}
