//! Every shader of the repository links and is valid. A folder's `.wgsl` files are entry shaders where they have an
//! entry point, and modules otherwise. A module is linked by importing it into an empty shader; where it requires what that
//! does not declare, some entry shader must import it.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

use std::collections::BTreeSet;
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

fn has_entry_point(source: &Source) -> bool {
    ["@compute", "@vertex", "@fragment"].iter().any(|stage| source.text().contains(stage))
}

fn text(problems: &[Diagnostic]) -> String {
    render_text(problems, false)
}

fn link_text(name: &str, text: String, library: &Library) -> Result<Linked, Vec<Diagnostic>> {
    link(&Source::new(name, text), library)
}

/// What linking many shaders found.
#[derive(Default)]
struct Findings {
    wrong: String,
    /// Modules that require what a shader declares, by the names of their sources.
    open: BTreeSet<String>,
    /// Sources of entry shaders.
    reached: BTreeSet<String>,
}

impl Findings {
    fn shader(&mut self, linked: &Linked) {
        assert!(linked.module.global_variables.iter().all(|(_, v)| v.binding.is_none_or(|b| b.group == 0)));
        self.reached.extend(linked.sources().map(|source| source.name().to_owned()));
    }

    fn module(&mut self, source: &Source, import: &str, library: &Library) {
        match link_text("import", format!("#import {import}\n"), library) {
            Ok(_) => {}
            Err(problems) if problems.iter().all(|problem| problem.message.starts_with("nothing declares `")) => {
                self.open.insert(source.name().to_owned());
            }
            Err(problems) => self.wrong.push_str(&text(&problems)),
        }
    }
}

#[test]
fn every_shader_and_module_is_valid() {
    let (mut found, mut findings, library) = (Vec::new(), Findings::default(), shared());
    folders(&root(), &mut found);
    found.retain(|folder| !folder.ends_with("shaders"));
    for folder in &found {
        let mut library = library.clone();
        library.read_folder(folder).unwrap();
        for (name, source) in files(folder) {
            match link(&source, &library) {
                Ok(linked) if !linked.entry_points.is_empty() => findings.shader(&linked),
                Err(problems) if has_entry_point(&source) => findings.wrong.push_str(&text(&problems)),
                _ => findings.module(&source, &format!("\"{name}\""), &library),
            }
        }
    }
    for name in library.module_names() {
        findings.module(library.module(name).unwrap(), name, &library);
    }
    let Findings { wrong, open, reached } = findings;
    assert!(wrong.is_empty(), "{wrong}");
    assert!(library.module_names().count() > 0 && !reached.is_empty() && !open.is_empty(), "no shader was found");
    let never_linked: Vec<_> = open.difference(&reached).collect();
    assert!(never_linked.is_empty(), "no entry shader imports {never_linked:?}");
}

#[test]
fn a_wrong_shader_would_be_noticed() {
    let problems = link_text("wrong.wgsl", "fn f() -> u32 { return 1.5; }".to_owned(), &shared()).unwrap_err();
    assert!(text(&problems).contains("wrong.wgsl:1:"), "{}", text(&problems));
}
