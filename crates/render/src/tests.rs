//! Every code has a fixture that pins its text and position: a graph of the passes of `tests/fixtures/fog`.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use tyndall_document::{Diagnostics, Source, fixture};
use tyndall_plugin::{Registry, SearchPath};

use crate::codes::{CODES, UNFINISHED};
use crate::running::unfinished;
use crate::{Request, load, registry};

const FIXTURES: &str = "tests/fixtures";

/// All that is said about a graph before it runs; of one that is named after it, what is said after a driver has ended
/// the loops of its first pass.
fn mistakes(source: &Arc<Source>, registry: &Registry) -> Diagnostics {
    let mut out = Diagnostics::default();
    let request = Request { graph: Path::new(FIXTURES).join(source.name()), ..Request::default() };
    let Some(loaded) = load(&request, registry, &mut out) else { return out };
    loaded.warn_of_needs(registry, &mut out);
    loaded.warn_of_limits(registry, &mut out);
    if source.name().starts_with(UNFINISHED.0) {
        let first = loaded.graph.passes.iter().next();
        out.extend(first.map(|pass| unfinished(&loaded.graph, pass, "llvmpipe", 48)));
    }
    out
}

#[test]
fn every_code_has_its_text() {
    let plugin = SearchPath { path: PathBuf::from(FIXTURES).join("fog"), required: true };
    let registry = registry(Vec::new(), &[plugin]).unwrap();
    fixture::check(Path::new(FIXTURES), CODES, &|source| mistakes(source, &registry));
}
