//! The verbs, a module each.

mod adapters;
mod bench;
mod check;
mod compare;
mod diff;
mod explain;
mod mutants;
mod new;
mod passes;
mod probe;
mod render;
mod show;
mod test;
mod watch;

use crate::App;
use crate::cli::{Arguments, Verb};
use crate::failure::Failure;

/// Does what the command line says.
pub(crate) fn run(app: &App, arguments: &Arguments) -> Result<(), Failure> {
    match &arguments.verb {
        Verb::Render(verb) if verb.watch => watch::run(app, arguments, verb),
        Verb::Render(verb) => render::run(app, arguments, verb).map(|_| ()),
        Verb::Check(verb) => check::run(app, arguments, verb),
        Verb::Show(verb) => show::run(app, arguments, verb),
        Verb::Explain(verb) => explain::run(app, arguments, verb),
        Verb::Passes(verb) => passes::run(app, arguments, verb),
        Verb::Bench(verb) => bench::run(app, arguments, verb),
        Verb::Compare(verb) => compare::run(app, arguments, verb),
        Verb::Probe(verb) => probe::run(app, arguments, verb),
        Verb::Test(verb) => test::run(app, arguments, verb),
        Verb::Mutants(verb) => mutants::run(app, arguments, verb),
        Verb::Diff(verb) => diff::run(verb),
        Verb::Adapters => adapters::run(),
        Verb::New { what } => new::run(what),
    }
}
