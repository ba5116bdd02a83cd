//! A crate that is not in the repository: a program of its own with a plugin that adds a section to the scene file, a table
//! that is made from it on the CPU, and a pass that reads the table. `outside/flare` is all that its author writes.
//!
//! The crate is built in a workspace that is not the repository's. The repository's crates are linked into that workspace, so
//! that cargo knows them by the paths that it knows them by here, and it is built as the tests of the whole workspace are, so
//! that all crates have the features that they have there: they are compiled already, and only the new crate is built.

#![cfg(unix)]
#![allow(clippy::unwrap_used, reason = "a test may panic")]

use std::os::unix::fs::symlink;
use std::path::{Path, PathBuf};
use std::process::Command;

const REPOSITORY: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../..");

const GRAPH: &str = r#"(
    version: 1,
    scene: "flare.scene.ron",
    passes: { "flare": (use: "flare.row") },
    outputs: { "radiance": "flare.radiance" },
)"#;

const SCENE: &str = r#"(
    camera: (position: (0.0, 0.0, 1.0), look_at: (0.0, 0.0, 0.0)),
    lights: [Point(position: (0.0, 0.0, 0.0), intensity: (1.0, 1.0, 1.0))],
    flare: (color: Keys([(0.0, (1.0, 0.0, 2.0)), (1.0, (0.0, 4.0, 2.0))]), strength: 3.0, profile: "shares.txt"),
)"#;

/// Copies the files of a folder and of the folders in it.
fn copy(from: &Path, to: &Path) {
    std::fs::create_dir_all(to).unwrap();
    for entry in std::fs::read_dir(from).unwrap().map(Result::unwrap) {
        let target = to.join(entry.file_name());
        match entry.path().is_dir() {
            true => copy(&entry.path(), &target),
            false => drop(std::fs::copy(entry.path(), target).unwrap()),
        }
    }
}

/// A workspace in this folder of the repository's crates and `flare`.
fn workspace(folder: &Path) {
    let repository = Path::new(REPOSITORY).canonicalize().unwrap();
    for linked in ["crates", "plugins", "shaders", "tests"] {
        symlink(repository.join(linked), folder.join(linked)).unwrap();
    }
    std::fs::copy(repository.join("Cargo.lock"), folder.join("Cargo.lock")).unwrap();
    let manifest = std::fs::read_to_string(repository.join("Cargo.toml")).unwrap();
    assert_eq!(manifest.matches("members = [").count(), 1);
    std::fs::write(folder.join("Cargo.toml"), manifest.replace("members = [", "members = [\"flare\", ")).unwrap();
    copy(&repository.join("tests/outside/flare"), &folder.join("flare"));
}

/// Builds the crate, and gives its program.
fn build(folder: &Path) -> PathBuf {
    let target = Path::new(env!("CARGO_TARGET_TMPDIR")).parent().unwrap();
    let mut cargo = Command::new(env!("CARGO"));
    cargo.args([
        "test",
        "--release",
        "--workspace",
        "--offline",
        "--no-run",
        "--bin",
        "flare",
        "--message-format",
        "json",
    ]);
    let built = cargo.arg("--target-dir").arg(target).current_dir(folder).output().unwrap();
    assert!(built.status.success(), "{}", String::from_utf8_lossy(&built.stderr));
    let artifacts = String::from_utf8_lossy(&built.stdout);
    let artifacts = artifacts.lines().map(|line| serde_json::from_str::<serde_json::Value>(line).unwrap());
    let mut programs = artifacts.filter(|artifact| artifact["target"]["name"] == "flare");
    PathBuf::from(programs.find_map(|program| program["executable"].as_str().map(str::to_owned)).unwrap())
}

struct Desk {
    folder: tempfile::TempDir,
    program: PathBuf,
}

impl Desk {
    fn put(&self, name: &str, text: &str) {
        std::fs::write(self.folder.path().join(name), text).unwrap();
    }

    /// Exit code, and all that was printed.
    fn run(&self, arguments: &[&str]) -> (i32, String) {
        let ended = Command::new(&self.program).args(arguments).current_dir(self.folder.path()).output().unwrap();
        let text = [ended.stdout, ended.stderr].concat();
        (ended.status.code().unwrap_or(-1), String::from_utf8_lossy(&text).into_owned())
    }

    /// What is messages of the scene with a part of it replaced.
    fn mistakes(&self, from: &str, to: &str) -> String {
        assert!(SCENE.contains(from));
        self.put("wrong.scene.ron", &SCENE.replace(from, to));
        let (code, messages) = self.run(&["check", "wrong.scene.ron"]);
        assert_eq!(code, 2, "{messages}");
        messages
    }

    /// Four channels of a pixel of the graph's picture.
    fn pixel(&self, x: u32, frame: u32, settings: &[&str]) -> Vec<f64> {
        let (pixel, frame) = (format!("{x},0"), frame.to_string());
        let arguments = ["probe", "flare.graph.ron", "radiance", &pixel, "--frame", &frame];
        let (code, messages) = self.run(&[&arguments[..], settings].concat());
        assert_eq!(code, 0, "{messages}");
        let numbers =
            messages.trim().strip_prefix(&format!("radiance {pixel}: ")).unwrap_or_else(|| panic!("{messages}"));
        numbers.split_whitespace().map_while(|word| word.parse().ok()).collect()
    }
}

#[test]
fn a_crate_outside_brings_a_scene_field_a_table_and_a_pass() {
    let folder = tempfile::tempdir().unwrap();
    workspace(folder.path());
    let program = build(folder.path());
    let desk = Desk { folder, program };
    desk.put("flare.graph.ron", GRAPH);
    desk.put("flare.scene.ron", SCENE);
    desk.put("shares.txt", "1 0.5\n0.25 0\n");

    // At 0 s the first key, halfway between the keys at 0.5 s; times the strength and the share of the step.
    assert_eq!(desk.pixel(0, 0, &[]), [3.0, 0.0, 6.0, 1.0]);
    assert_eq!(desk.pixel(2, 0, &[]), [0.75, 0.0, 1.5, 1.0]);
    assert_eq!(desk.pixel(1, 12, &[]), [0.75, 3.0, 3.0, 1.0]);
    assert_eq!(desk.pixel(3, 12, &[]), [0.0, 0.0, 0.0, 1.0]);
    assert_eq!(
        desk.pixel(0, 0, &["--set", "scene.flare.color=(1, 2, 4)", "--set", "scene.flare.strength=2"]),
        [2.0, 4.0, 8.0, 1.0]
    );
    // The data vary with the time, so the pass runs anew; where they do not, its result is kept.
    let (code, messages) =
        desk.run(&["render", "flare.graph.ron", "--frames", "0..2", "--output", "radiance=####.npy"]);
    assert_eq!(code, 0, "{messages}");
    let frames = ["0000.npy", "0001.npy"].map(|name| std::fs::read(desk.folder.path().join(name)).unwrap());
    assert_ne!(frames[0], frames[1]);

    for (from, to, expected) in [
        ("flare: (color", "flares: (color", &["wrong.scene.ron:4:5", "`flares`", "did you mean `flare`?"][..]),
        (
            "strength:",
            "strenght:",
            &["wrong.scene.ron:4:76", "a flare has no field `strenght`", "did you mean `strength`?"],
        ),
        ("strength: 3.0", "strength: 0.0", &["out-of-range", "wrong.scene.ron:4:86", "`strength`"]),
        ("(1.0, (0.0, 4.0", "(0.0, (0.0, 4.0", &["unsorted-keys", "wrong.scene.ron:4:50"]),
        ("shares.txt", "share.txt", &["missing-file", "share.txt", "wrong.scene.ron:4:100"]),
        (", profile: \"shares.txt\"", "", &["missing-field", "a flare needs the field `profile`"]),
    ] {
        let messages = desk.mistakes(from, to);
        assert!(expected.iter().all(|text| messages.contains(text)), "{to}: {expected:?}\n{messages}");
    }
    let (code, messages) = desk.run(&["check", "flare.graph.ron"]);
    assert_eq!(code, 0, "{messages}");
    let (_, messages) = desk.run(&["probe", "flare.graph.ron", "radiance", "0,0", "--set", "scene.flare.strength=1e9"]);
    assert!(messages.contains("the flare is brighter than any eye can bear"), "{messages}");
    let (code, messages) = desk.run(&["probe", "flare.graph.ron", "radiance", "0,0", "--set", "scene.lights=[]"]);
    assert!(
        code == 2 && messages.contains("pass `flare` (flare.row) draws lamps, and the scene has none"),
        "{messages}"
    );
}

/// A program without the plugin does not know its field, and says which there are.
#[test]
fn a_field_of_a_plugin_that_is_not_there_is_unknown() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("flare.scene.ron"), SCENE).unwrap();
    let mut checked = Command::new(env!("CARGO_BIN_EXE_tyndall"));
    let checked = checked.args(["check", "flare.scene.ron"]).current_dir(&folder).output().unwrap();
    let messages = String::from_utf8_lossy(&checked.stderr);
    assert_eq!(checked.status.code(), Some(2), "{messages}");
    assert!(
        messages.contains("a scene has no field `flare`")
            && messages.contains("available: `camera`, `medium`, `background`"),
        "{messages}"
    );
}
