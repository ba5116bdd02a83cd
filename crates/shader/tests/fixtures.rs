//! Every code is pinned: `fixtures/CODE.wgsl` or `CODE.VARIANT.wgsl`, with the exact text of what is reported in the
//! `.txt` beside it. `UPDATE_FIXTURES=1` writes the texts instead of comparing them.
//!
//! A fixture is linked with the shared modules of `fixtures/modules` and the plugin's files of `fixtures/files`, and
//! where it links, held against the descriptor in `descriptor/mod.rs`.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

use std::fs;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use tyndall_document::{Diagnostic, Source, render_text};
use tyndall_shader::{CODES, Library, check, link};

mod descriptor;

fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/fixtures")
}

/// The `.wgsl` files of a folder: stems and sources, sorted.
fn shaders(folder: &Path, shown: &str) -> Vec<(String, Arc<Source>)> {
    let mut paths: Vec<_> = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()).collect();
    paths.sort();
    let wgsl = paths.iter().filter_map(|path| Some((path, path.file_name()?.to_str()?.strip_suffix(".wgsl")?)));
    wgsl.map(|(path, stem)| {
        let text = fs::read_to_string(path).unwrap();
        (stem.to_owned(), Source::new(format!("{shown}{stem}.wgsl"), text))
    })
    .collect()
}

fn report(source: &Arc<Source>) -> Vec<Diagnostic> {
    let mut library = Library::default();
    for (stem, module) in shaders(&folder().join("modules"), "shaders/") {
        library.insert(&stem, module);
    }
    for (stem, file) in shaders(&folder().join("files"), "") {
        library.insert_file(&format!("{stem}.wgsl"), file);
    }
    match link(source, &library) {
        Ok(linked) => check(&linked, &descriptor::descriptor(), descriptor::SCENE),
        Err(problems) => problems,
    }
}

#[test]
fn every_code_is_pinned() {
    let update = std::env::var_os("UPDATE_FIXTURES").is_some_and(|value| value == "1");
    let (fixtures, mut problems) = (shaders(&folder(), ""), String::new());
    for (stem, source) in &fixtures {
        let reported = report(source);
        let text = render_text(&reported, false);
        let path = folder().join(format!("{stem}.txt"));
        if reported.first().is_none_or(|first| first.code.0 != stem.split('.').next().unwrap()) {
            problems.push_str(&format!("{stem}.wgsl does not report its code first, but:\n{text}\n"));
        } else if update {
            fs::write(path, text).unwrap();
        } else if fs::read_to_string(path).ok().as_deref() != Some(&text) {
            problems.push_str(&format!("{stem}.txt is missing or differs from:\n{text}\n"));
        }
    }
    for code in CODES.iter().filter(|code| code.0 != "shader-internal") {
        if !fixtures.iter().any(|(stem, _)| stem.split('.').next() == Some(code.0)) {
            problems.push_str(&format!("the code {code} has no fixture\n"));
        }
    }
    for entry in fs::read_dir(folder()).unwrap() {
        let name = entry.unwrap().file_name().into_string().unwrap();
        if name.strip_suffix(".txt").is_some_and(|stem| !fixtures.iter().any(|(other, _)| other == stem)) {
            problems.push_str(&format!("{name} has no fixture\n"));
        }
    }
    assert!(problems.is_empty(), "{problems}");
}

#[test]
fn what_is_right_is_not_reported() {
    let (_, good) = shaders(&folder().join("right"), "").pop().expect("the right shader is gone");
    let text = render_text(&report(&good), false);
    assert!(text.is_empty(), "{text}");
}
