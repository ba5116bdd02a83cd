//! `check`: every mistake of graphs, scenes and comparisons, without a GPU.

use std::path::Path;

use tyndall_document::{Diagnostics, Source, render_json, render_text};
use tyndall_scene::{Overrides, Scene};

use crate::App;
use crate::cli::{Arguments, Check, Format, GraphArguments};
use crate::failure::Failure;
use crate::warnings::Untold;
use crate::{loading, plugins, terminal};

use super::compare;

pub(crate) fn run(app: &App, arguments: &Arguments, verb: &Check) -> Result<(), Failure> {
    let untold = Untold::of(&verb.warnings)?;
    let mut out = Diagnostics::default();
    for path in &verb.files {
        let mut found = Diagnostics::default();
        let name = path.to_string_lossy();
        let checked = if name.ends_with(".scene.ron") {
            scene(app, arguments, path, &mut found)
        } else if name.ends_with(".compare.ron") {
            comparison(app, arguments, path, &mut found)
        } else if name.ends_with(".test.ron") {
            Err(Failure::Usage(format!("{name} is an image test: run `tyndall test {name}`")))
        } else {
            graph(app, arguments, path, &mut found)
        };
        match checked {
            Err(Failure::Mistakes(mistakes)) => found.extend(mistakes),
            other => other?,
        }
        found.sort();
        found.dedup();
        out.extend(found);
    }
    // Two graphs that name the same scene report its mistakes once.
    out.dedup();
    let out = untold.without(out);
    match verb.format {
        Format::Json => terminal::line(&render_json(&out)),
        Format::Text => {
            if !out.is_empty() {
                terminal::error(&render_text(&out, terminal::color()));
            }
            if !out.has_errors() {
                let files = verb.files.len();
                terminal::line(&format!("{files} {} without mistakes", if files == 1 { "file" } else { "files" }));
            }
        }
    }
    if out.has_errors() { Err(Failure::Reported(2)) } else { Ok(()) }
}

fn graph(app: &App, arguments: &Arguments, path: &Path, found: &mut Diagnostics) -> Result<(), Failure> {
    let registry = plugins::registry(app, arguments, &[path])?;
    let graph = GraphArguments { graph: path.to_owned(), scene: None, size: None, set: Vec::new() };
    let loaded = loading::try_load(&graph, &registry, found);
    if let Some(loaded) = loaded.filter(|_| !found.has_errors()) {
        let wanted = loading::Wanted { roots: tyndall_graph::Roots::Outputs, keep: false, live: &[] };
        if let Err(tyndall_render::Error::Mistakes(mistakes)) = loading::plan(&loaded, wanted) {
            found.extend(mistakes);
        }
    }
    Ok(())
}

fn scene(app: &App, arguments: &Arguments, path: &Path, found: &mut Diagnostics) -> Result<(), Failure> {
    let registry = plugins::registry(app, arguments, &[path])?;
    let (_, warnings) = Scene::load(path, &Overrides::new(), registry.extensions())?;
    found.extend(warnings);
    Ok(())
}

fn comparison(app: &App, arguments: &Arguments, path: &Path, found: &mut Diagnostics) -> Result<(), Failure> {
    if let Some(file) = tyndall_compare::read(&Source::read(path)?, found) {
        let registry = compare::registry(app, arguments, path, &file)?;
        tyndall_compare::prepare(&file, &registry, found);
    }
    Ok(())
}
