//! The test file of the README is one.

#![allow(clippy::unwrap_used, reason = "a test may panic")]

use tyndall_document::{Diagnostics, render_text};
use tyndall_testing::file::read;

#[test]
fn the_file_in_the_readme_is_read() {
    let readme = include_str!("../README.md");
    let snippet = readme.split("```ron\n").nth(1).unwrap().split("```").next().unwrap();
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("readme.test.ron");
    std::fs::write(&path, snippet).unwrap();
    // What it names is there.
    ["fog.graph.ron", "fog.scene.ron"].map(|name| std::fs::write(folder.path().join(name), "()").unwrap());
    let mut out = Diagnostics::default();
    let file = read(&path, &mut out);
    assert!(out.is_empty(), "{}", render_text(&out, false));
    assert_eq!(file.map(|file| (file.taps.len(), file.relations.len())), Some((4, 1)));
}
