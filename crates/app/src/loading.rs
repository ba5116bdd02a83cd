//! From the command line to a checked graph and scene.

use tyndall_document::{Diagnostics, render_text};
use tyndall_plugin::Registry;
use tyndall_render::{Request, Running, Setting};

use crate::cli::GraphArguments;
use crate::failure::Failure;
use crate::terminal;
use crate::warnings::Untold;

pub(crate) use tyndall_render::{Loaded, Wanted, plan};

/// Reads and checks a graph and its scene; warnings go to standard error, but for those that are not told.
pub(crate) fn load(arguments: &GraphArguments, registry: &Registry, untold: &Untold) -> Result<Loaded, Failure> {
    let mut out = Diagnostics::default();
    let loaded = try_load(arguments, registry, &mut out);
    if let Some(loaded) = &loaded {
        loaded.warn_of_needs(registry, &mut out);
        loaded.warn_of_limits(registry, &mut out);
    }
    out.sort();
    out.dedup();
    let out = untold.without(out);
    if out.has_errors() {
        return Err(Failure::Mistakes(out));
    }
    if !out.is_empty() {
        terminal::error(&render_text(&out, terminal::color()));
    }
    loaded.ok_or(Failure::Mistakes(out))
}

/// Warns of passes whose loops the driver ended before they were done.
pub(crate) fn warn_of_unfinished(running: &Running<'_>, untold: &Untold) -> Result<(), Failure> {
    let mut out = Diagnostics::default();
    running.warn_of_unfinished(&mut out)?;
    let out = untold.without(out);
    if !out.is_empty() {
        terminal::error(&render_text(&out, terminal::color()));
    }
    Ok(())
}

/// As [`load`]; every mistake and every warning goes to `out`.
pub(crate) fn try_load(arguments: &GraphArguments, registry: &Registry, out: &mut Diagnostics) -> Option<Loaded> {
    let setting = |text: &String| Setting { text: text.clone(), argument: format!("--set {text}") };
    let request = Request {
        graph: arguments.graph.clone(),
        scene: arguments.scene.clone(),
        size: arguments.size,
        set: arguments.set.iter().map(setting).collect(),
    };
    tyndall_render::load(&request, registry, out)
}
