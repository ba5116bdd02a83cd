//! The codes of mistakes are one namespace over all crates.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::PathBuf;

use tyndall_document::Code;
use tyndall_tests::root;

/// The crates that report mistakes, and the codes that each declares.
fn declared() -> BTreeMap<&'static str, Vec<Code>> {
    BTreeMap::from([
        ("compare", tyndall_compare::CODES.to_vec()),
        ("document", [tyndall_document::CODES, tyndall_document::SHARED_CODES].concat()),
        ("graph", tyndall_graph::CODES.to_vec()),
        ("mutants", tyndall_mutants::CODES.to_vec()),
        ("plugin", tyndall_plugin::CODES.to_vec()),
        ("render", tyndall_render::CODES.to_vec()),
        ("scene", tyndall_scene::CODES.to_vec()),
        ("shader", tyndall_shader::CODES.to_vec()),
        ("testing", tyndall_testing::CODES.to_vec()),
    ])
}

/// Folders of crates in which there is this path.
fn crates_with(path: &str) -> Vec<PathBuf> {
    let folders = fs::read_dir(root().join("crates")).unwrap().map(|entry| entry.unwrap().path());
    folders.filter(|folder| folder.join(path).exists()).collect()
}

#[test]
fn every_code_is_declared_once() {
    let declared = declared();
    let listed: BTreeSet<PathBuf> = crates_with("src/codes.rs").into_iter().collect();
    let expected: BTreeSet<&str> = listed.iter().map(|folder| folder.file_name().unwrap().to_str().unwrap()).collect();
    assert_eq!(declared.keys().copied().collect::<BTreeSet<_>>(), expected, "every crate with codes is looked at");
    let mut seen = BTreeMap::new();
    for (name, code) in declared.iter().flat_map(|(name, codes)| codes.iter().map(move |code| (name, code))) {
        assert_eq!(seen.insert(code, name), None, "`{code}` is declared twice, in `{name}` at last");
    }
    assert!(seen.len() > 100);
}

/// A fixture is a file `CODE.ron` or `CODE.wgsl`, also with `.VARIANT` after the code.
#[test]
fn every_code_has_a_fixture() {
    let files =
        crates_with("tests/fixtures").into_iter().flat_map(|folder| fs::read_dir(folder.join("tests/fixtures")));
    let pinned: BTreeSet<String> = files
        .flatten()
        .filter_map(|entry| entry.unwrap().file_name().into_string().ok())
        .filter(|name| name.ends_with(".ron") || name.ends_with(".wgsl"))
        .filter_map(|name| name.split_once('.').map(|(code, _)| code.to_owned()))
        .collect();
    // naga itself fails: no shader is known that makes it.
    let unpinned = [tyndall_shader::codes::INTERNAL];
    for code in declared().into_values().flatten().filter(|code| !unpinned.contains(code)) {
        assert!(pinned.contains(code.0), "`{code}` has no fixture in any crate");
    }
}
