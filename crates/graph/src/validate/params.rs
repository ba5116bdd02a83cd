//! Parameters of the graph, and what the command line puts in their place.

use rustc_hash::FxHashMap;
use tyndall_document::{Decoder, Diagnostic, Diagnostics, Node, Place, Span, Value};

use super::Validator;
use crate::codes;
use crate::descriptor::ParamValue;
use crate::graph::{GraphParam, ParamRef};
use crate::handle::{Handle, Table};
use crate::overrides::{Override, moved_to_argument};

/// Parameters of the graph by name, and overridden parameters of passes.
#[derive(Default)]
pub(super) struct Params<'a> {
    pub by_name: FxHashMap<&'a str, Handle<GraphValue>>,
    pub graph: Table<GraphValue>,
    pub passes: FxHashMap<ParamRef, &'a Override>,
}

/// A parameter of the graph.
pub(super) struct GraphValue {
    pub name: String,
    /// Where the file defines it.
    pub definition: Span,
    /// `None`: a mistake hides it.
    pub value: Option<ParamValue>,
    /// Where the value stands.
    pub place: Place,
    /// The value came from the command line.
    pub overridden: bool,
    pub uses: Vec<ParamRef>,
    pub used: bool,
}

impl Params<'_> {
    pub fn into_graph_params(self) -> Vec<GraphParam> {
        let param = |param: GraphValue| Some(GraphParam { name: param.name, value: param.value?, uses: param.uses });
        self.graph.into_iter().filter_map(param).collect()
    }
}

impl<'a> Validator<'a> {
    /// Reads the parameters of the graph, then what the command line says about any parameter.
    pub(super) fn read_params(&mut self) {
        let file = self.file;
        for entry in &file.params {
            let mut decoder = Decoder::new(&file.source, &mut self.out);
            let value = free_value(&mut decoder, &entry.value);
            let param = self.params.graph.push(GraphValue {
                name: file.text(&entry.name).to_owned(),
                definition: entry.name.span,
                value,
                place: file.source.place(entry.value.span),
                overridden: false,
                uses: Vec::new(),
                used: false,
            });
            self.params.by_name.entry(file.text(&entry.name)).or_insert(param);
        }
        let overrides = self.overrides;
        for given in &overrides.params {
            match given.name.split_once('.') {
                Some((pass, param)) => self.override_pass(given, pass, param),
                None => self.override_graph(given),
            }
        }
    }

    fn override_graph(&mut self, given: &'a Override) {
        let place = Place::Argument(given.argument.clone());
        let Some(index) = self.params.by_name.get(given.name.as_str()).copied() else {
            let message = format!("the graph has no parameter named `{}`", given.name);
            let file = self.file;
            let names = file.params.iter().map(|param| file.text(&param.name));
            self.report_unknown((codes::UNKNOWN_PARAMETER, place), message, &given.name, names, str::to_owned);
            return;
        };
        let mut out = Diagnostics::default();
        let value = free_value(&mut Decoder::new(&given.source, &mut out), &given.value);
        self.out.extend(moved_to_argument(out, &given.argument));
        let definition = self.place(self.params.graph[index].definition);
        let param = &mut self.params.graph[index];
        if let (Some(declared), Some(value)) = (&param.value, &value)
            && kind_name(declared) != kind_name(value)
        {
            let message = format!("`{}` is {}, and {value} is {}", param.name, kind_name(declared), kind_name(value));
            let diagnostic = Diagnostic::error(tyndall_document::WRONG_TYPE, place, message);
            self.out.push(diagnostic.relate(definition, "it takes its type from here"));
            return;
        }
        if value.is_some() {
            (param.value, param.place, param.overridden) = (value, place, true);
        }
    }

    fn override_pass(&mut self, given: &'a Override, pass_name: &str, param_name: &str) {
        let place = Place::Argument(given.argument.clone());
        let Some(pass) = self.pass_named(pass_name) else {
            let message = format!("there is no pass named `{pass_name}`");
            let names = self.pass_names();
            let whole = |near: &str| format!("{near}.{param_name}");
            self.report_unknown((codes::UNKNOWN_REFERENCE, place), message, pass_name, names, whole);
            return;
        };
        let kind = self.kind_of(pass);
        match kind.descriptor.param_named(param_name) {
            Some(param) => {
                self.params.passes.insert(ParamRef { pass, param }, given);
            }
            None if !self.is_known_pass(pass) => {}
            None => {
                let message = format!("`{}` has no parameter named `{param_name}`", kind.descriptor.name);
                let names = kind.descriptor.params.iter().map(|param| param.name.as_str());
                let whole = |near: &str| format!("{pass_name}.{near}");
                self.report_unknown((codes::UNKNOWN_PARAMETER, place), message, param_name, names, whole);
            }
        }
    }

    /// Every parameter of the graph must set or switch something.
    pub(super) fn check_unused_params(&mut self) {
        for index in self.params.graph.handles() {
            let param = &self.params.graph[index];
            if !param.used {
                let message = format!("nothing uses the parameter `{}`", param.name);
                let suggestion = format!("write \"${}\" where it should be used, or remove it", param.name);
                let place = self.place(param.definition);
                self.report(Diagnostic::error(codes::UNUSED_PARAMETER, place, message).suggest(suggestion));
            }
        }
    }
}

/// A value whose type is its own: a text stays a [`ParamValue::Choice`] until its use says what it means.
fn free_value(decoder: &mut Decoder<'_>, node: &Node) -> Option<ParamValue> {
    match &node.value {
        Value::Bool(value) => Some(ParamValue::Bool(*value)),
        Value::Number(number) => match number.integer {
            Some(integer) => Some(ParamValue::Integer(integer)),
            None => decoder.float(node).map(ParamValue::Float),
        },
        Value::Text(text) if !text.starts_with('$') => Some(ParamValue::Choice(text.clone())),
        Value::Tuple(parts) if (2..=4).contains(&parts.len()) => numbers(decoder, parts).map(ParamValue::Vector),
        _ => {
            decoder.wrong_type(node, "a switch, a number, a text or 2 to 4 numbers");
            None
        }
    }
}

/// Every number of a tuple; all that are wrong are reported.
pub(super) fn numbers(decoder: &mut Decoder<'_>, parts: &[Node]) -> Option<Vec<f64>> {
    let numbers: Vec<Option<f64>> = parts.iter().map(|part| decoder.float(part)).collect();
    numbers.into_iter().collect()
}

/// What a value is, in words; an integer is a number like any other.
pub(super) fn kind_name(value: &ParamValue) -> &'static str {
    match value {
        ParamValue::Bool(_) => "a switch",
        ParamValue::Integer(_) | ParamValue::Float(_) => "a number",
        ParamValue::Vector(parts) => ["", "", "2 numbers", "3 numbers", "4 numbers"][parts.len().min(4)],
        ParamValue::Choice(_) | ParamValue::File(_) => "a text",
    }
}
