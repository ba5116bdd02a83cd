//! `check`: every mistake of graph files and their scenes, without a GPU.

use tyndall_document::{Diagnostics, render_json, render_text};

use crate::App;
use crate::cli::{Arguments, Check, Format, GraphArguments};
use crate::failure::Failure;
use crate::{loading, plugins, terminal};

pub(crate) fn run(app: &App, arguments: &Arguments, verb: &Check) -> Result<(), Failure> {
    let mut out = Diagnostics::default();
    for path in &verb.graphs {
        let mut found = Diagnostics::default();
        match plugins::registry(app, arguments, &[path]) {
            Ok(registry) => {
                let graph = GraphArguments { graph: path.clone(), scene: None, size: None, set: Vec::new() };
                let loaded = loading::try_load(&graph, &registry, &mut found);
                if let Some(loaded) = loaded.filter(|_| !found.has_errors()) {
                    let wanted = loading::Wanted { roots: tyndall_graph::Roots::Outputs, keep: false, live: &[] };
                    if let Err(tyndall_render::Error::Mistakes(mistakes)) = loading::plan(&loaded, wanted) {
                        found.extend(mistakes);
                    }
                }
            }
            Err(Failure::Mistakes(mistakes)) => found.extend(mistakes),
            Err(other) => return Err(other),
        }
        found.sort();
        found.dedup();
        out.extend(found);
    }
    // Two graphs that name one scene tell its mistakes once.
    out.dedup();
    match verb.format {
        Format::Json => terminal::line(&render_json(&out)),
        Format::Text => {
            if !out.is_empty() {
                terminal::error(&render_text(&out, terminal::color()));
            }
            if !out.has_errors() {
                let files = verb.graphs.len();
                terminal::line(&format!("{files} {} without mistakes", if files == 1 { "graph" } else { "graphs" }));
            }
        }
    }
    if out.has_errors() { Err(Failure::Told(2)) } else { Ok(()) }
}
