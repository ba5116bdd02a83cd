//! Parameters of passes: of the right type, within their range, or set to a parameter of the graph.

use std::path::Path;

use petgraph::graph::NodeIndex;
use tyndall_document::{Code, Decoder, Diagnostic, Diagnostics, Node, Place, Span, Value, near};

use super::params::numbers;
use super::{Validator, missing_file};
use crate::codes;
use crate::descriptor::{ParamDescriptor, ParamValue};
use crate::graph::{ParamRef, ParamSetting};
use crate::overrides::moved_to_argument;

/// A value that does not do, in words.
struct Mistake {
    code: Code,
    message: String,
    suggestion: Option<String>,
}

impl Mistake {
    fn new(code: Code, message: String) -> Self {
        Self { code, message, suggestion: None }
    }

    fn at(self, place: Place) -> Diagnostic {
        let diagnostic = Diagnostic::error(self.code, place, self.message);
        match self.suggestion {
            Some(suggestion) => diagnostic.suggest(suggestion),
            None => diagnostic,
        }
    }
}

impl Validator<'_> {
    /// Sets every parameter of a pass: to its default, to what the file says, to what the command line says.
    pub(super) fn set_params(&mut self, pass: u32) {
        let kind = self.kind_of(pass);
        let params = &kind.descriptor.params;
        let mut settings: Vec<ParamSetting> =
            params.iter().map(|param| ParamSetting::Value(param.default.clone())).collect();
        let file = self.file;
        for entry in &file.passes[pass as usize].params {
            let name = &entry.name.value;
            let Some(index) = params.iter().position(|param| param.name == *name) else {
                if self.is_known_pass(pass) {
                    let message = format!("`{}` has no parameter named `{name}`", kind.descriptor.name);
                    let place = self.place(entry.name.span);
                    let names = params.iter().map(|param| param.name.as_str());
                    self.report_unknown((codes::UNKNOWN_PARAMETER, place), message, name, names, str::to_owned);
                }
                self.mark_used(&entry.value);
                continue;
            };
            let param = ParamRef { pass, param: index as u32 };
            if let Some(setting) = self.setting(&params[index], param, &entry.value) {
                settings[index] = setting;
            }
            self.size_place(param, &settings[index], self.place(entry.value.span));
        }
        if !self.params.passes.is_empty() {
            self.override_settings(pass, params, &mut settings);
        }
        self.passes[NodeIndex::new(pass as usize)].params = settings;
    }

    fn override_settings(&mut self, pass: u32, params: &[ParamDescriptor], settings: &mut [ParamSetting]) {
        for (index, descriptor) in params.iter().enumerate() {
            let param = ParamRef { pass, param: index as u32 };
            let Some(given) = self.params.passes.get(&param).copied() else { continue };
            for value in &mut self.params.graph {
                value.uses.retain(|other| *other != param);
            }
            let place = Place::Argument(given.argument.clone());
            if reference(&given.value).is_some() {
                if let Some(setting) = self.referred(descriptor, param, &given.value, place.clone()) {
                    settings[index] = setting;
                }
            } else {
                let mut out = Diagnostics::default();
                let value = typed(&mut Decoder::new(&given.source, &mut out), descriptor, &given.value);
                self.out.extend(moved_to_argument(out, &given.argument));
                if let Some(value) = value {
                    self.check_exists(&value, place.clone());
                    settings[index] = ParamSetting::Value(value);
                }
            }
            self.size_place(param, &settings[index], place);
        }
    }

    /// What an entry of the file sets a parameter to.
    fn setting(&mut self, descriptor: &ParamDescriptor, param: ParamRef, node: &Node) -> Option<ParamSetting> {
        if reference(node).is_some() {
            let place = self.place(node.span);
            return self.referred(descriptor, param, node, place);
        }
        let file = self.file;
        let mut value = typed(&mut Decoder::new(&file.source, &mut self.out), descriptor, node)?;
        if let ParamValue::File(path) = &mut value {
            *path = self.beside_file(path);
            self.check_exists(&value, self.place(node.span));
        }
        Some(ParamSetting::Value(value))
    }

    /// What `$name` sets a parameter to. `place` is where it stands.
    fn referred(
        &mut self,
        descriptor: &ParamDescriptor,
        param: ParamRef,
        node: &Node,
        place: Place,
    ) -> Option<ParamSetting> {
        let name = reference(node)?;
        let fits = |numbers: &[ParamValue]| numbers.iter().any(|number| same_kind(number, &descriptor.default));
        match name {
            "frame" if fits(&[ParamValue::Integer(0), ParamValue::Float(0.0)]) => return Some(ParamSetting::Frame),
            "time" if fits(&[ParamValue::Float(0.0)]) => return Some(ParamSetting::Time),
            "frame" | "time" => {
                let what = if name == "time" { "a number of seconds" } else { "a whole number" };
                let message = format!("`{}` is {}, and ${name} is {what}", descriptor.name, kind_of(descriptor));
                self.report(Diagnostic::error(codes::WRONG_REFERENCE_TYPE, place, message));
                return None;
            }
            _ => {}
        }
        let index = self.graph_param(name, &place)?;
        let value = self.params.graph[index as usize].value.clone()?;
        let definition = self.place(self.params.graph[index as usize].definition);
        let given = &mut self.params.graph[index as usize];
        given.uses.push(param);
        let Some(mut value) = converted(value, &descriptor.default) else {
            let message = format!("`{}` is {}, and ${name} is not", descriptor.name, kind_of(descriptor));
            let diagnostic = if given.overridden {
                Diagnostic::error(codes::WRONG_REFERENCE_TYPE, given.place.clone(), message).relate(place, "used here")
            } else {
                Diagnostic::error(codes::WRONG_REFERENCE_TYPE, place, message).relate(definition, "defined here")
            };
            self.report(diagnostic);
            return None;
        };
        let (value_place, overridden) = (given.place.clone(), given.overridden);
        if let Err(mistake) = within(descriptor, &value) {
            self.report(mistake.at(value_place).relate(place, "used here"));
            return None;
        }
        if let ParamValue::File(path) = &mut value {
            if !overridden {
                *path = self.beside_file(path);
            }
            self.check_exists(&value, value_place);
        }
        Some(ParamSetting::Value(value))
    }

    /// The parameter of the graph that `$name` means.
    pub(super) fn graph_param(&mut self, name: &str, place: &Place) -> Option<u32> {
        let found = self.params.by_name.get(name).copied();
        match found {
            Some(index) => self.params.graph[index as usize].used = true,
            None => {
                let message = format!("the graph has no parameter named `{name}`");
                let file = self.file;
                let names = file.params.iter().map(|param| param.name.value.as_str()).chain(["frame", "time"]);
                let code = (codes::UNKNOWN_NAME, place.clone());
                let near = self.report_unknown(code, message, name, names, |near| format!("${near}"));
                // What was probably meant is not unused as well.
                if let Some(index) = near.and_then(|near| self.params.by_name.get(near)) {
                    self.params.graph[*index as usize].used = true;
                }
            }
        }
        found
    }

    /// A parameter that only a mistake uses is not unused as well.
    fn mark_used(&mut self, node: &Node) {
        let index = reference(node).and_then(|name| self.params.by_name.get(name));
        if let Some(index) = index {
            self.params.graph[*index as usize].used = true;
        }
    }

    fn check_exists(&mut self, value: &ParamValue, place: Place) {
        if let ParamValue::File(path) = value
            && !path.contains("####")
            && !(self.exists)(Path::new(path))
        {
            self.report(missing_file(path, place));
        }
    }

    /// Remembers where a parameter that sets a size is set, and refuses one that changes with the frame.
    fn size_place(&mut self, param: ParamRef, setting: &ParamSetting, place: Place) {
        let kind = self.kind_of(param.pass);
        if !kind.signature.size_params.contains(&param.param) {
            return;
        }
        if !matches!(setting, ParamSetting::Value(_)) {
            let name = &kind.descriptor.params[param.param as usize].name;
            let message = format!("`{name}` sets the size of a port, and cannot change from frame to frame");
            self.report(Diagnostic::error(codes::LIVE_SIZE, place.clone(), message));
        }
        self.size_param_places.insert(param, place);
    }

    /// Where a pass's name stands.
    pub(super) fn pass_span(&self, pass: u32) -> Span {
        self.file.passes[pass as usize].name.span
    }
}

/// The name behind the `$`.
fn reference(node: &Node) -> Option<&str> {
    match &node.value {
        Value::Text(text) => text.strip_prefix('$'),
        _ => None,
    }
}

/// A value of the parameter's type and within its range.
fn typed(decoder: &mut Decoder<'_>, param: &ParamDescriptor, node: &Node) -> Option<ParamValue> {
    let value = match &param.default {
        ParamValue::Bool(_) => ParamValue::Bool(decoder.bool(node)?),
        ParamValue::Integer(_) => ParamValue::Integer(decoder.integer(node)?),
        ParamValue::Float(_) => ParamValue::Float(decoder.float(node)?),
        ParamValue::Vector(default) => ParamValue::Vector(vector(decoder, default.len(), node)?),
        ParamValue::Choice(_) => ParamValue::Choice(decoder.text(node)?.to_owned()),
        ParamValue::File(_) => ParamValue::File(decoder.text(node)?.to_owned()),
    };
    match within(param, &value) {
        Ok(()) => Some(value),
        Err(mistake) => {
            let place = decoder.place(node.span);
            decoder.report(mistake.at(place));
            None
        }
    }
}

fn vector(decoder: &mut Decoder<'_>, length: usize, node: &Node) -> Option<Vec<f64>> {
    match &node.value {
        Value::Tuple(parts) if parts.len() == length => numbers(decoder, parts),
        _ => {
            decoder.wrong_type(node, &format!("a tuple of {length} numbers"));
            None
        }
    }
}

/// A value of the graph as one of the type of `default`; integers serve as floats.
fn converted(value: ParamValue, default: &ParamValue) -> Option<ParamValue> {
    Some(match (value, default) {
        (ParamValue::Integer(value), ParamValue::Float(_)) => ParamValue::Float(value as f64),
        (ParamValue::Choice(text), ParamValue::File(_)) => ParamValue::File(text),
        (value, default) if same_kind(&value, default) => value,
        _ => return None,
    })
}

fn same_kind(a: &ParamValue, b: &ParamValue) -> bool {
    match (a, b) {
        (ParamValue::Vector(a), ParamValue::Vector(b)) => a.len() == b.len(),
        _ => std::mem::discriminant(a) == std::mem::discriminant(b),
    }
}

fn kind_of(param: &ParamDescriptor) -> String {
    match &param.default {
        ParamValue::Bool(_) => "a switch".to_owned(),
        ParamValue::Integer(_) => "a whole number".to_owned(),
        ParamValue::Float(_) => "a number".to_owned(),
        ParamValue::Vector(parts) => format!("{} numbers", parts.len()),
        ParamValue::Choice(_) => "one of some words".to_owned(),
        ParamValue::File(_) => "a file".to_owned(),
    }
}

/// Whether a value of the right type is one that the parameter may have.
fn within(param: &ParamDescriptor, value: &ParamValue) -> Result<(), Mistake> {
    // What 32 bits of a shader hold.
    let (least, most) = (f64::from(i32::MIN), f64::from(u32::MAX));
    match value {
        ParamValue::Integer(value) => in_range(param, *value as f64, (least, most)),
        ParamValue::Float(value) => in_range(param, *value, (f64::from(f32::MIN), f64::from(f32::MAX))),
        ParamValue::Vector(values) => {
            values.iter().try_for_each(|value| in_range(param, *value, (f64::from(f32::MIN), f64::from(f32::MAX))))
        }
        ParamValue::Choice(word) if !param.choices.contains(word) => Err(unknown_choice(param, word)),
        ParamValue::Bool(_) | ParamValue::Choice(_) | ParamValue::File(_) => Ok(()),
    }
}

fn in_range(param: &ParamDescriptor, value: f64, of_type: (f64, f64)) -> Result<(), Mistake> {
    let (low, high) = param.range.unwrap_or(of_type);
    let (low, high) = (low.max(of_type.0), high.min(of_type.1));
    if value >= low && value <= high {
        return Ok(());
    }
    let unit = if matches!(param.unit.as_str(), "" | "1") { String::new() } else { format!(" {}", param.unit) };
    let bounds = match (low == of_type.0, high == of_type.1) {
        (false, true) => format!("{low} or more"),
        (true, false) => format!("{high} or less"),
        _ => format!("{low} to {high}"),
    };
    Err(Mistake::new(codes::OUT_OF_RANGE, format!("`{}` is {bounds}{unit}, and not {value}", param.name)))
}

fn unknown_choice(param: &ParamDescriptor, word: &str) -> Mistake {
    let words: Vec<String> = param.choices.iter().map(|word| format!("`{word}`")).collect();
    let message = format!("`{}` is one of {}, and not `{word}`", param.name, words.join(", "));
    let near = near(word, param.choices.iter().map(String::as_str));
    let suggestion = near.map(|near| format!("did you mean `{near}`?"));
    Mistake { suggestion, ..Mistake::new(codes::UNKNOWN_CHOICE, message) }
}

