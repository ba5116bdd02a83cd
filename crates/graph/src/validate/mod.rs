//! From a file's tree to a typed graph, with every mistake on the way.
//!
//! Validation is a sequence of steps, each of which uses the results of those before it. A step goes on after a mistake as
//! far as it can without reporting the same mistake twice: what a mistake hides has an unknown type and an unknown size,
//! which satisfy every demand.

mod connections;
mod cycles;
mod mistakes;
mod outside;
mod params;
mod scope;
mod settings;
mod sizes;
mod stated;
mod switches;
mod types;

use std::path::Path;
use std::sync::Arc;

use tyndall_document::Diagnostics;

use crate::catalogue::Catalogue;
use crate::file::GraphFile;
use crate::graph::{Graph, Pass};
use crate::handle::Table;
use crate::overrides::Overrides;
use crate::wiring::Wiring;

pub(crate) use sizes::size_mistakes;

use mistakes::Mistakes;
use scope::Scope;

/// Checks a file against the available passes, and returns its graph if it has no mistakes.
///
/// Reports every mistake, in the order of the file, those of the command line last. Checks on disk whether the files that
/// it names exist.
pub fn validate(
    file: &GraphFile,
    catalogue: &Catalogue,
    overrides: &Overrides,
    out: &mut Diagnostics,
) -> Option<Arc<Graph>> {
    validate_with(file, catalogue, overrides, &Path::exists, out)
}

/// The same, with a function that says which files exist.
pub fn validate_with(
    file: &GraphFile,
    catalogue: &Catalogue,
    overrides: &Overrides,
    exists: &dyn Fn(&Path) -> bool,
    out: &mut Diagnostics,
) -> Option<Arc<Graph>> {
    let mut mistakes = Mistakes::new();
    let graph = graph(&Request { file, catalogue, overrides, exists }, &mut mistakes);
    let found = mistakes.into_diagnostics();
    let sound = !file.broken && !found.has_errors();
    if !found.is_empty() {
        out.extend(found);
        out.sort();
        out.dedup();
    }
    sound.then(|| Arc::new(graph))
}

/// What is validated, and against which passes.
struct Request<'a> {
    file: &'a GraphFile,
    catalogue: &'a Catalogue,
    overrides: &'a Overrides,
    exists: &'a dyn Fn(&Path) -> bool,
}

/// The graph of a file, complete only if nothing was reported.
fn graph(request: &Request<'_>, out: &mut Mistakes) -> Graph {
    let scope = Scope::of(request, out);
    let params = params::read(&scope, out);
    let settings = settings::read(&scope, &params, out);
    let connections = connections::connect(&scope, out);
    let outputs = connections::outputs(&scope, out);
    let order = cycles::order(&scope, &connections, out);
    let switches = switches::read(&scope, &params, out);
    params.check_used(&scope, settings.used.iter().chain(&switches.used), out);
    let feeds = switches::pass_through(&scope.passes, &order, &connections, &switches.enabled);
    let flows = types::check(&scope, &order, &connections, &feeds, out);
    let graph = Graph {
        source: request.file.source.clone(),
        about: request.file.about.clone(),
        scene: outside::scene(&scope, out),
        size: outside::size(request, out),
        params: params.into_graph_params(&settings.uses),
        passes: passes(&scope, settings.of_passes, &switches.enabled, switches.switched_by),
        connections: connections.list,
        outputs,
        names: scope.names,
        size_params: settings.size_params,
        wiring: Wiring {
            passes: scope.passes,
            connection_to: connections.to,
            history: connections.history,
            order,
            enabled: switches.enabled,
            feeds,
            flows,
        },
    };
    out.extend(sizes::check(&graph, &connections.written));
    graph
}

fn passes(
    scope: &Scope<'_>,
    settings: settings::OfPasses,
    enabled: &Table<Pass, bool>,
    switched_by: Table<Pass, Option<String>>,
) -> Table<Pass> {
    let mut passes = Table::with_capacity(settings.len());
    for ((pass, entry), (params, switch)) in scope.file.passes.entries().zip(settings.into_iter().zip(switched_by)) {
        passes.push(Pass {
            name: scope.file.text(&entry.name).to_owned(),
            span: entry.name.span,
            params,
            enabled: enabled[pass],
            switch,
            kind: scope.passes.kind(pass).clone(),
        });
    }
    passes
}
