//! A file appears whole or not at all.

#![allow(clippy::unwrap_used, reason = "a test may panic")]

use std::io::{self, Write};
use std::path::Path;

use tyndall_image::{Kind, resolved, write_atomically, write_bytes};

fn names(folder: &Path) -> Vec<String> {
    let mut names: Vec<String> =
        std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().file_name().into_string().unwrap()).collect();
    names.sort();
    names
}

#[test]
fn a_failure_leaves_the_old_file_and_nothing_else() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.txt");
    write_bytes(&path, b"old").unwrap();
    let error = write_atomically(&path, |writer| {
        writer.write_all(&[b'x'; 1 << 20])?;
        Err(io::Error::from(io::ErrorKind::StorageFull))
    })
    .unwrap_err();
    assert_eq!((error.kind(), error.exit_code()), (Kind::DiskFull, 3));
    assert!(error.to_string().starts_with(&path.display().to_string()));
    assert_eq!(std::fs::read(&path).unwrap(), b"old");
    assert_eq!(names(folder.path()), ["a.txt"]);
}

#[test]
fn folders_are_made_and_files_replaced() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("b/c/a.txt");
    write_bytes(&path, b"first, longer").unwrap();
    write_bytes(&path, b"second").unwrap();
    assert_eq!(std::fs::read(&path).unwrap(), b"second");
    assert_eq!(names(path.parent().unwrap()), ["a.txt"]);
}

#[test]
fn a_folder_or_a_file_in_the_way_is_the_users_mistake() {
    let folder = tempfile::tempdir().unwrap();
    let error = write_bytes(folder.path(), b"x").unwrap_err();
    assert_eq!(error.exit_code(), 2);
    assert!(error.to_string().ends_with("cannot write: it is a folder"), "{error}");
    let file = folder.path().join("file");
    write_bytes(&file, b"x").unwrap();
    let error = write_bytes(&file.join("a.txt"), b"x").unwrap_err();
    assert_eq!(error.exit_code(), 2, "{error}");
    assert!(error.to_string().contains("a.txt"));
}

#[test]
fn a_read_only_file_stays() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.txt");
    write_bytes(&path, b"old").unwrap();
    let mut permissions = std::fs::metadata(&path).unwrap().permissions();
    permissions.set_readonly(true);
    std::fs::set_permissions(&path, permissions).unwrap();
    let error = write_bytes(&path, b"new").unwrap_err();
    assert!(error.to_string().contains("read-only"), "{error}");
    assert_eq!(std::fs::read(&path).unwrap(), b"old");
}

#[cfg(unix)]
mod unix {
    use super::*;
    use std::os::unix::fs::PermissionsExt;

    fn mode(path: &Path) -> u32 {
        std::fs::metadata(path).unwrap().permissions().mode() & 0o777
    }

    #[test]
    fn permissions_are_the_usual_ones_and_are_kept() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.txt");
        let plain = folder.path().join("plain.txt");
        std::fs::write(&plain, b"").unwrap();
        write_bytes(&path, b"x").unwrap();
        assert_eq!(mode(&path), mode(&plain));
        std::fs::set_permissions(&path, PermissionsExt::from_mode(0o640)).unwrap();
        write_bytes(&path, b"y").unwrap();
        assert_eq!(mode(&path), 0o640);
    }

    #[test]
    fn a_link_keeps_pointing_at_its_target() {
        let folder = tempfile::tempdir().unwrap();
        let target = folder.path().join("target.txt");
        let link = folder.path().join("link.txt");
        write_bytes(&target, b"old").unwrap();
        std::os::unix::fs::symlink(&target, &link).unwrap();
        write_bytes(&link, b"new").unwrap();
        assert!(std::fs::symlink_metadata(&link).unwrap().is_symlink());
        assert_eq!(std::fs::read(&target).unwrap(), b"new");
    }

    #[test]
    fn a_path_leads_to_one_place_however_it_is_spelt() {
        let folder = tempfile::tempdir().unwrap();
        std::fs::create_dir(folder.path().join("sub")).unwrap();
        std::os::unix::fs::symlink("sub", folder.path().join("link")).unwrap();
        let to = |path: &str| resolved(&folder.path().join(path));
        for (one, other) in [
            ("a.exr", "./a.exr"),
            ("a.exr", ".//a.exr"),
            ("a.exr", "sub/../a.exr"),
            ("a.exr", "nowhere/../a.exr"),
            ("sub/a.exr", "link/a.exr"),
            ("sub/new/a.exr", "link/new/./a.exr"),
            ("a.exr", "link/../a.exr"),
        ] {
            assert_eq!(to(one), to(other), "{one} and {other}");
        }
        assert_ne!(to("a.exr"), to("sub/a.exr"));
        write_bytes(&folder.path().join("a.exr"), b"x").unwrap();
        std::os::unix::fs::symlink("a.exr", folder.path().join("b.exr")).unwrap();
        assert_eq!(to("a.exr"), to("b.exr"));
        assert_eq!(
            resolved(Path::new("c.exr")),
            std::env::current_dir().unwrap().canonicalize().unwrap().join("c.exr")
        );
    }

    /// Memory as a file system is one like any other, though its name begins like that of a device.
    #[cfg(target_os = "linux")]
    #[test]
    fn files_below_dev_are_files() {
        let folder = tempfile::tempdir_in("/dev/shm").unwrap();
        let path = folder.path().join("new/a.txt");
        write_bytes(&path, b"first, longer").unwrap();
        write_bytes(&path, b"second").unwrap();
        assert_eq!(std::fs::read(&path).unwrap(), b"second");
        assert_eq!(names(path.parent().unwrap()), ["a.txt"]);
    }

    /// As `/dev/stdout` is where the shell has sent it to a file, and a link of the user's to that.
    #[cfg(target_os = "linux")]
    #[test]
    fn an_open_file_is_written_to_and_not_replaced() {
        use std::os::fd::AsRawFd;
        use std::os::unix::fs::MetadataExt;
        let folder = tempfile::tempdir().unwrap();
        let file = std::fs::File::create(folder.path().join("a.txt")).unwrap();
        let link = folder.path().join("link.txt");
        std::os::unix::fs::symlink(format!("/proc/self/fd/{}", file.as_raw_fd()), &link).unwrap();
        for (path, text) in [(format!("/dev/fd/{}", file.as_raw_fd()).into(), "one"), (link, "two")] {
            write_bytes(&path, text.as_bytes()).unwrap();
            let there = folder.path().join("a.txt");
            assert_eq!(std::fs::read_to_string(&there).unwrap(), text);
            assert_eq!(std::fs::metadata(&there).unwrap().ino(), file.metadata().unwrap().ino());
        }
    }

    #[test]
    fn devices_are_written_to_and_stay_devices() {
        write_bytes(Path::new("/dev/null"), b"x").unwrap();
        assert!(!std::fs::metadata("/dev/null").unwrap().is_file());
    }

    #[cfg(target_os = "linux")]
    #[test]
    fn a_full_disk_is_told_from_a_wrong_path() {
        let error = write_bytes(Path::new("/dev/full"), b"x").unwrap_err();
        assert_eq!((error.kind(), error.exit_code()), (Kind::DiskFull, 3), "{error}");
        let error = write_bytes(Path::new("/proc/nothing/a.txt"), b"x").unwrap_err();
        assert_eq!(error.exit_code(), 2, "{error}");
    }
}
