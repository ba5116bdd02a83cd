//! Fixtures that pin the text and the position of every code.
//!
//! A fixture is a document `CODE.ron`, or `CODE.VARIANT.ron`, and beside it `CODE.txt` (`CODE.VARIANT.txt`) with the
//! exact text of the diagnostics that it causes, in which it is named without its folder.
//!
//! ```no_run
//! use tyndall_document::{CODES, Diagnostics, fixture, parse};
//! # let folder = std::path::Path::new("tests/fixtures");
//! fixture::check(folder, CODES, &|source| {
//!     let mut out = Diagnostics::new();
//!     parse(source, &mut out);
//!     out
//! });
//! ```

use std::collections::BTreeSet;
use std::fs;
use std::path::Path;
use std::sync::Arc;

use crate::{Code, Diagnostics, Source, render_text};

/// Runs every fixture of a folder and compares what it reports. With the environment variable `UPDATE_FIXTURES=1` the
/// texts are written instead of compared; everything else is still checked.
///
/// # Panics
/// Where a code has no fixture; a fixture's name is not a code; the first diagnostic of a fixture has another code; a
/// text is missing or differs (both are shown); a text has no fixture; the folder holds no fixture or cannot be read.
pub fn check(dir: &Path, codes: &[Code], run: &dyn Fn(&Arc<Source>) -> Diagnostics) {
    let update = std::env::var_os("UPDATE_FIXTURES").is_some_and(|value| value == "1");
    let problems = problems(dir, codes, run, update);
    assert!(problems.is_empty(), "{} problems with fixtures:\n\n{}", problems.len(), problems.join("\n"));
}

/// What [`check`] would panic about; `update` writes the texts.
pub fn problems(dir: &Path, codes: &[Code], run: &dyn Fn(&Arc<Source>) -> Diagnostics, update: bool) -> Vec<String> {
    let mut names = BTreeSet::new();
    let mut texts = BTreeSet::new();
    match fs::read_dir(dir) {
        Err(error) => return vec![format!("{} cannot be read: {error}", dir.display())],
        Ok(entries) => {
            for name in entries.flatten().filter_map(|entry| entry.file_name().into_string().ok()) {
                if let Some(stem) = name.strip_suffix(".ron") {
                    names.insert(stem.to_owned());
                } else if let Some(stem) = name.strip_suffix(".txt") {
                    texts.insert(stem.to_owned());
                }
            }
        }
    }
    let mut problems = Vec::new();
    if names.is_empty() {
        problems.push(format!("{} holds no fixture", dir.display()));
    }
    for code in codes.iter().filter(|code| !names.iter().any(|name| code_of(name) == code.0)) {
        problems.push(format!("the code `{code}` has no fixture `{code}.ron`"));
    }
    for name in texts.difference(&names) {
        problems.push(format!("`{name}.txt` has no fixture `{name}.ron`"));
    }
    for name in &names {
        match codes.iter().find(|code| code.0 == code_of(name)) {
            Some(code) => problems.extend(problem(dir, name, *code, run, update)),
            None => problems.push(format!("`{name}.ron` is not named after a code")),
        }
    }
    problems
}

/// The code that a fixture is named after.
fn code_of(name: &str) -> &str {
    name.split('.').next().unwrap_or(name)
}

/// What is wrong with one fixture.
fn problem(
    dir: &Path,
    name: &str,
    code: Code,
    run: &dyn Fn(&Arc<Source>) -> Diagnostics,
    update: bool,
) -> Option<String> {
    let text = match fs::read_to_string(dir.join(format!("{name}.ron"))) {
        Ok(text) => text,
        Err(error) => return Some(format!("`{name}.ron` cannot be read: {error}")),
    };
    let diagnostics = run(&Source::new(format!("{name}.ron"), text));
    let rendered = render_text(&diagnostics, false);
    let path = dir.join(format!("{name}.txt"));
    if diagnostics.iter().next().is_none_or(|first| first.code != code) {
        return Some(format!("`{name}.ron` does not report `{code}` first, but:\n{rendered}"));
    }
    if update {
        return fs::write(&path, &rendered).err().map(|error| format!("`{name}.txt` cannot be written: {error}"));
    }
    match fs::read_to_string(&path) {
        Ok(pinned) if pinned.replace("\r\n", "\n") == rendered => None,
        Ok(pinned) => Some(format!("`{name}.txt` differs.\n--- pinned\n{pinned}--- reported\n{rendered}{HOW}")),
        Err(_) => Some(format!("`{name}.txt` is missing.\n--- reported\n{rendered}{HOW}")),
    }
}

const HOW: &str = "--- run the test with UPDATE_FIXTURES=1 to pin what is reported now\n";
