//! From a file's tree to a typed graph, with every mistake on the way.
//!
//! Each step goes on after a mistake as far as it can without reporting the same mistake a second time: what a mistake
//! hides has an unknown type and an unknown size, and nothing is demanded of those.

mod connections;
mod cycles;
mod names;
mod params;
mod settings;
mod sizes;
mod switches;
mod types;
mod values;

use std::path::Path;
use std::sync::Arc;

use rustc_hash::FxHashMap;
use tyndall_document::{Code, Diagnostic, Diagnostics, MISSING_FILE, Place, Span, near};

use crate::catalogue::{Catalogue, Kind};
use crate::codes;
use crate::file::GraphFile;
use crate::graph::{Connection, Graph, ParamRef, Pass, PortRef};
use crate::handle::{Handle, Table};
use crate::names::Names;
use crate::overrides::Overrides;
use crate::wiring::{Feeds, GraphPort, Wiring};

pub(crate) use sizes::size_mistakes;

use params::Params;

/// Names for which a near one is sought in one file: the search is not cheap, and nobody reads more.
const MOST_SUGGESTIONS: u32 = 100;

/// Checks a file against the passes that there are, and gives its graph where it has no mistake.
///
/// Reports every mistake, in the order of the file; those of the command line last. Looks on the disk for the files
/// that are named.
pub fn validate(
    file: &GraphFile,
    catalogue: &Catalogue,
    overrides: &Overrides,
    out: &mut Diagnostics,
) -> Option<Arc<Graph>> {
    validate_with(file, catalogue, overrides, &Path::exists, out)
}

/// The same, with something else than the disk that says which files exist.
pub fn validate_with(
    file: &GraphFile,
    catalogue: &Catalogue,
    overrides: &Overrides,
    exists: &dyn Fn(&Path) -> bool,
    out: &mut Diagnostics,
) -> Option<Arc<Graph>> {
    let unknown = names::unknown_kind();
    let mut validator = Validator::new(file, catalogue, overrides, exists, &unknown);
    let graph = validator.graph();
    let sound = !file.broken && !validator.out.has_errors();
    if !validator.out.is_empty() {
        out.extend(validator.out);
        out.sort();
        out.dedup();
    }
    sound.then(|| Arc::new(graph))
}

struct Validator<'a> {
    file: &'a GraphFile,
    catalogue: &'a Catalogue,
    overrides: &'a Overrides,
    exists: &'a dyn Fn(&Path) -> bool,
    out: Diagnostics,
    suggestions: u32,
    names: Names<Pass>,
    /// The kind of a pass whose `use` names none.
    unknown: &'a Arc<Kind>,
    kinds: Table<Kind, &'a Arc<Kind>>,
    params: Params<'a>,
    passes: Table<Pass>,
    connections: Table<Connection>,
    wiring: Wiring,
    /// What flows into each port if every pass were switched on.
    written: Feeds,
    size_param_places: FxHashMap<ParamRef, Place>,
    pictures: FxHashMap<ParamRef, (u32, u32)>,
    /// Whether the file names a port among the inputs of its pass.
    named: Table<GraphPort, bool>,
}

impl<'a> Validator<'a> {
    fn new(
        file: &'a GraphFile,
        catalogue: &'a Catalogue,
        overrides: &'a Overrides,
        exists: &'a dyn Fn(&Path) -> bool,
        unknown: &'a Arc<Kind>,
    ) -> Self {
        Self {
            file,
            catalogue,
            overrides,
            exists,
            out: Diagnostics::default(),
            suggestions: MOST_SUGGESTIONS,
            names: Names::with_capacity(file.passes.len()),
            unknown,
            kinds: Table::new(),
            params: Params::default(),
            passes: Table::with_capacity(file.passes.len()),
            connections: Table::with_capacity(file.passes.iter().map(|pass| pass.inputs.len()).sum()),
            wiring: Wiring::default(),
            written: Table::new(),
            size_param_places: FxHashMap::default(),
            pictures: FxHashMap::default(),
            named: Table::new(),
        }
    }

    /// The graph, complete only where nothing was reported.
    fn graph(&mut self) -> Graph {
        self.index_passes();
        self.read_params();
        let file = self.file;
        for (pass, entry) in file.passes.entries() {
            self.set_params(pass, entry);
            self.connect(pass, entry);
        }
        let outputs = self.outputs();
        self.find_order();
        self.switch_passes();
        self.check_unused_params();
        self.check_types();
        let scene = self.scene();
        let size = self.size();
        let mut graph = Graph {
            source: self.file.source.clone(),
            about: self.file.about.clone(),
            scene,
            size,
            params: std::mem::take(&mut self.params).into_graph_params(),
            passes: std::mem::take(&mut self.passes),
            outputs,
            connections: std::mem::take(&mut self.connections),
            names: std::mem::replace(&mut self.names, Names::with_capacity(0)),
            size_param_places: std::mem::take(&mut self.size_param_places),
            pictures: std::mem::take(&mut self.pictures),
            wiring: std::mem::take(&mut self.wiring),
        };
        graph.wiring.kinds = self.kinds.iter().map(|kind| (*kind).clone()).collect();
        self.check_sizes(&graph);
        graph
    }

    /// The outputs of the graph that name a port.
    fn outputs(&mut self) -> Vec<(String, PortRef)> {
        let file = self.file;
        if file.outputs.is_empty() && !file.broken {
            let message = "the graph has no outputs, so nothing would be drawn";
            let suggestion = "add outputs: { \"image\": \"pass.port\" }";
            self.report(
                Diagnostic::error(codes::NO_OUTPUTS, self.place(file.outputs_span), message).suggest(suggestion),
            );
        }
        let mut outputs = Vec::with_capacity(file.outputs.len());
        for output in &file.outputs {
            if let Some((port, _)) = self.source(&output.from) {
                outputs.push((file.text(&output.name).to_owned(), port));
            }
        }
        outputs
    }

    fn scene(&mut self) -> Option<String> {
        if let Some(scene) = &self.overrides.scene {
            return Some(scene.clone());
        }
        let scene = self.file.scene.as_ref()?;
        let path = self.beside_file(&scene.value);
        if !(self.exists)(Path::new(&path)) {
            self.report(missing_file(&path, self.place(scene.span)));
        }
        Some(path)
    }

    fn size(&mut self) -> (u32, u32) {
        let Some((width, height)) = self.overrides.size else {
            return self.file.size.as_ref().map_or((640, 480), |size| size.value);
        };
        if width == 0 || height == 0 {
            let place = Place::Argument(format!("--size {width}x{height}"));
            let message = format!("a size of {width}×{height} pixels is none");
            self.report(Diagnostic::error(codes::BAD_SIZE, place, message).suggest("give two numbers of 1 or more"));
        }
        (width, height)
    }

    /// A path that stands in the file, relative to the working directory.
    fn beside_file(&self, path: &str) -> String {
        let folder = Path::new(self.file.source.name()).parent().unwrap_or(Path::new(""));
        folder.join(path).to_string_lossy().into_owned()
    }

    /// The pass of this name.
    fn pass_named(&self, name: &str) -> Option<Handle<Pass>> {
        let file = self.file;
        self.names.find(name, |pass| file.text(&file.passes[pass].name) == name)
    }

    /// Names of all passes.
    fn pass_names(&self) -> impl Iterator<Item = &'a str> + Clone + use<'a> {
        let file = self.file;
        file.passes.iter().map(|pass| file.text(&pass.name))
    }

    fn place(&self, span: Span) -> Place {
        self.file.source.place(span)
    }

    fn report(&mut self, diagnostic: Diagnostic) {
        self.out.push(diagnostic);
    }

    /// Reports an unknown name with the near one, if there is one, and gives it; `suggestion` says how it is written.
    fn report_unknown<'n>(
        &mut self,
        (code, place): (Code, Place),
        message: String,
        name: &str,
        candidates: impl IntoIterator<Item = &'n str> + Clone,
        suggestion: impl Fn(&str) -> String,
    ) -> Option<&'n str> {
        let mut diagnostic = Diagnostic::error(code, place, message);
        let mut found = None;
        if self.suggestions > 0 {
            self.suggestions -= 1;
            found = near(name, candidates.clone());
            diagnostic = match found {
                Some(near) => diagnostic.suggest(format!("did you mean `{}`?", suggestion(near))),
                None => list_few(diagnostic, candidates, suggestion),
            };
        }
        self.report(diagnostic);
        found
    }
}

/// Names what there is, where that is little.
fn list_few<'n>(
    diagnostic: Diagnostic,
    candidates: impl IntoIterator<Item = &'n str>,
    suggestion: impl Fn(&str) -> String,
) -> Diagnostic {
    const MOST: usize = 12;
    let few: Vec<String> =
        candidates.into_iter().take(MOST + 1).map(|name| format!("`{}`", suggestion(name))).collect();
    match few.len() {
        0 => diagnostic.suggest("there is none"),
        1..=MOST => diagnostic.suggest(format!("there is {}", few.join(", "))),
        _ => diagnostic,
    }
}

fn missing_file(path: &str, place: Place) -> Diagnostic {
    Diagnostic::error(MISSING_FILE, place, format!("there is no file `{path}`"))
}
