//! Parameters of the graph, with the values from the command line.

use rustc_hash::FxHashMap;
use tyndall_document::{Decoder, Diagnostic, Diagnostics, Place, Span};

use super::mistakes::Mistakes;
use super::scope::Scope;
use crate::codes;
use crate::descriptor::ParamValue;
use crate::graph::{GraphParam, ParamRef};
use crate::handle::{Handle, Table};
use crate::overrides::{Override, moved_to_argument};

/// Parameters of the graph by name.
pub(super) struct Params<'a> {
    by_name: FxHashMap<&'a str, Handle<GraphValue>>,
    pub values: Table<GraphValue>,
}

/// A parameter of the graph.
pub(super) struct GraphValue {
    pub name: String,
    /// Where the file defines it.
    pub definition: Span,
    /// `None` if a mistake hides it.
    pub value: Option<ParamValue>,
    /// The place of the value.
    pub place: Place,
    /// Whether the value came from the command line.
    pub overridden: bool,
}

/// Reads the parameters of the graph, then what the command line says about them.
pub(super) fn read<'a>(scope: &Scope<'a>, out: &mut Mistakes) -> Params<'a> {
    let file = scope.file;
    let mut params = Params { by_name: FxHashMap::default(), values: Table::new() };
    for entry in &file.params {
        let name = file.text(&entry.name);
        let param = params.values.push(GraphValue {
            name: name.to_owned(),
            definition: entry.name.span,
            value: ParamValue::read(&mut Decoder::new(&file.source, out.diagnostics()), &entry.value),
            place: scope.place(entry.value.span),
            overridden: false,
        });
        params.by_name.entry(name).or_insert(param);
    }
    for given in scope.request.overrides.params.iter().filter(|given| !given.name.contains('.')) {
        params.set(scope, given, out);
    }
    params
}

impl Params<'_> {
    fn set(&mut self, scope: &Scope<'_>, given: &Override, out: &mut Mistakes) {
        let place = Place::Argument(given.argument.clone());
        let Some(param) = self.by_name.get(given.name.as_str()).copied() else {
            let message = format!("the graph has no parameter `{}`", given.name);
            let code = (codes::UNKNOWN_PARAMETER, place);
            out.report_unknown(code, message, &given.name, names(scope), str::to_owned);
            return;
        };
        let mut found = Diagnostics::default();
        let value = ParamValue::read(&mut Decoder::new(&given.source, &mut found), &given.value);
        out.extend(moved_to_argument(found, &given.argument));
        let param = &mut self.values[param];
        if let (Some(declared), Some(value)) = (&param.value, &value)
            && declared.words() != value.words()
        {
            let message = format!("`{}` is {}, but {value} is {}", param.name, declared.words(), value.words());
            let diagnostic = Diagnostic::error(tyndall_document::WRONG_TYPE, place, message);
            out.report(diagnostic.relate(scope.place(param.definition), "it takes its type from here"));
            return;
        }
        if value.is_some() {
            (param.value, param.place, param.overridden) = (value, place, true);
        }
    }

    /// The parameter of this name.
    pub fn find(&self, name: &str) -> Option<Handle<GraphValue>> {
        self.by_name.get(name).copied()
    }

    /// The parameter that `$name` means.
    ///
    /// # Errors
    /// The one that was probably meant, after the unknown name has been reported.
    pub fn resolve(
        &self,
        scope: &Scope<'_>,
        name: &str,
        place: &Place,
        out: &mut Mistakes,
    ) -> Result<Handle<GraphValue>, Option<Handle<GraphValue>>> {
        self.find(name).ok_or_else(|| {
            let message = format!("the graph has no parameter `{name}`");
            let code = (codes::UNKNOWN_NAME, place.clone());
            let names = names(scope).chain(["frame", "time"]);
            let near = out.report_unknown(code, message, name, names, |near| format!("${near}"));
            near.and_then(|near| self.find(near))
        })
    }

    /// Reports the parameters that are not used, not even by mistake.
    pub fn check_used<'u>(
        &self,
        scope: &Scope<'_>,
        used: impl Iterator<Item = &'u Handle<GraphValue>>,
        out: &mut Mistakes,
    ) {
        let mut is_used = self.values.column(false);
        used.for_each(|param| is_used[*param] = true);
        for (param, _) in self.values.iter().zip(&is_used).filter(|(_, used)| !**used) {
            let message = format!("nothing uses the parameter `{}`", param.name);
            let suggestion = format!("write \"${}\" where it should be used, or remove it", param.name);
            let place = scope.place(param.definition);
            out.report(Diagnostic::error(codes::UNUSED_PARAMETER, place, message).suggest(suggestion));
        }
    }

    /// As a graph has them.
    pub fn into_graph_params(self, uses: &[(Handle<GraphValue>, ParamRef)]) -> Vec<GraphParam> {
        let mut uses_of = self.values.column(Vec::new());
        uses.iter().for_each(|(param, by)| uses_of[*param].push(*by));
        let params = self.values.into_iter().zip(uses_of);
        params.filter_map(|(param, uses)| Some(GraphParam { name: param.name, value: param.value?, uses })).collect()
    }
}

fn names<'a>(scope: &Scope<'a>) -> impl Iterator<Item = &'a str> + Clone + use<'a> {
    let file = scope.file;
    file.params.iter().map(|param| file.text(&param.name))
}
