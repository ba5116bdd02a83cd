//! `show`: the scheduled graph as text, drawing, dot or JSON.

use std::path::{Path, PathBuf};

use tyndall_graph::{Roots, show};

use crate::App;
use crate::cli::{Arguments, Show};
use crate::failure::Failure;
use crate::loading::{self, Wanted};
use crate::pictures::distinct;
use crate::warnings::Untold;
use crate::{plugins, terminal};

pub(crate) fn run(app: &App, arguments: &Arguments, verb: &Show) -> Result<(), Failure> {
    let files: Vec<PathBuf> = [&verb.svg, &verb.dot, &verb.json].into_iter().flatten().cloned().collect();
    distinct(&files)?;
    let registry = plugins::registry(app, arguments, &[&verb.graph.graph])?;
    let loaded = loading::load(&verb.graph, &registry, &Untold::of_models())?;
    let plan = loading::plan(&loaded, Wanted { roots: Roots::Outputs, keep: false, live: &[] })?;
    let mut wrote = false;
    let mut write = |path: &Option<PathBuf>, text: &dyn Fn() -> String| -> Result<(), Failure> {
        if let Some(path) = path {
            save(path, &text())?;
            wrote = true;
        }
        Ok(())
    };
    write(&verb.svg, &|| show::svg(&plan))?;
    write(&verb.dot, &|| show::dot(&plan))?;
    write(&verb.json, &|| show::json(&plan))?;
    if !wrote {
        terminal::text(&show::text(&plan));
    }
    Ok(())
}

fn save(path: &Path, text: &str) -> Result<(), Failure> {
    tyndall_image::write_bytes(path, text.as_bytes())?;
    terminal::line(&format!("wrote {}", path.display()));
    Ok(())
}
