//! `explain`: why a pass or port is as it is.

use tyndall_graph::Roots;

use crate::App;
use crate::cli::{Arguments, Explain};
use crate::failure::Failure;
use crate::loading::{self, Wanted};
use crate::warnings::Untold;
use crate::{plugins, terminal};

pub(crate) fn run(app: &App, arguments: &Arguments, verb: &Explain) -> Result<(), Failure> {
    let registry = plugins::registry(app, arguments, &[&verb.graph.graph])?;
    let loaded = loading::load(&verb.graph, &registry, &Untold::of_models())?;
    let plan = loading::plan(&loaded, Wanted { roots: Roots::Outputs, keep: true, live: &[] })?;
    terminal::text(&tyndall_graph::explain(&plan, &verb.name)?);
    Ok(())
}
