//! Every shader of the repository links and is valid. A folder's `.wgsl` files are entry shaders where they have an
//! entry point, and modules otherwise; a module is linked by importing it into an empty shader.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

use std::path::{Path, PathBuf};
use std::sync::Arc;

use tyndall_document::{Diagnostic, Source, render_text};
use tyndall_shader::{Library, Linked, link};

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

/// Folders that hold `.wgsl` files, sorted; those of deliberate mistakes (`fixtures`) and of builds are left out.
fn folders(folder: &Path, found: &mut Vec<PathBuf>) {
    let mut entries: Vec<_> = std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()).collect();
    entries.sort();
    if entries.iter().any(|path| path.extension().is_some_and(|extension| extension == "wgsl")) {
        found.push(folder.to_owned());
    }
    for path in entries.iter().filter(|path| path.is_dir()) {
        let name = path.file_name().unwrap().to_string_lossy();
        if !(name.starts_with('.') || name == "target" || name == "out" || name == "fixtures") {
            folders(path, found);
        }
    }
}

fn files(folder: &Path) -> Vec<(String, Arc<Source>)> {
    let mut library = Library::default();
    library.read_folder(folder).unwrap();
    library.file_names().map(|name| (name.to_owned(), Arc::clone(library.file(name).unwrap()))).collect()
}

fn shared() -> Library {
    let mut library = Library::default();
    for (name, source) in files(&root().join("shaders")) {
        library.insert(name.trim_end_matches(".wgsl"), source);
    }
    library
}

fn text(problems: &[Diagnostic]) -> String {
    render_text(problems, false)
}

fn link_text(name: &str, text: String, library: &Library) -> Result<Linked, Vec<Diagnostic>> {
    link(&Source::new(name, text), library)
}

#[test]
fn every_shared_module_is_valid() {
    let library = shared();
    let mut wrong = String::new();
    for name in library.module_names() {
        if let Err(problems) = link_text(&format!("import of {name}"), format!("#import {name}\n"), &library) {
            wrong.push_str(&text(&problems));
        }
    }
    assert!(library.module_names().count() > 0, "no shared module was found");
    assert!(wrong.is_empty(), "{wrong}");
}

#[test]
fn every_shader_of_every_plugin_is_valid() {
    let mut found = Vec::new();
    folders(&root(), &mut found);
    found.retain(|folder| !folder.ends_with("shaders"));
    let (mut entry_shaders, mut wrong) = (0, String::new());
    for folder in &found {
        let mut library = shared();
        library.read_folder(folder).unwrap();
        for (name, source) in files(folder) {
            let linked = link(&source, &library);
            entry_shaders += usize::from(linked.as_ref().is_ok_and(|linked| !linked.entry_points.is_empty()));
            match linked {
                Ok(linked) => {
                    assert!(linked.module.global_variables.iter().all(|(_, v)| v.binding.is_none_or(|b| b.group == 0)));
                    if linked.entry_points.is_empty() {
                        let module = link_text("import", format!("#import \"{name}\"\n"), &library);
                        wrong.extend(module.err().map(|problems| text(&problems)));
                    }
                }
                Err(problems) => wrong.push_str(&text(&problems)),
            }
        }
    }
    assert!(entry_shaders > 0, "no shader with an entry point was found");
    assert!(wrong.is_empty(), "{wrong}");
}

#[test]
fn a_wrong_shader_would_be_noticed() {
    let problems = link_text("wrong.wgsl", "fn f() -> u32 { return 1.5; }".to_owned(), &shared()).unwrap_err();
    assert!(text(&problems).contains("wrong.wgsl:1:"), "{}", text(&problems));
}
