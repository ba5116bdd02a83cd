//! Parameters of passes: of the right type, within their range, or set to a parameter of the graph.

use std::path::Path;

use tyndall_document::{Decoder, Diagnostic, Diagnostics, Node, Place, Span, Value};

use super::params::GraphValue;
use super::values::{converted, kind_of, same_kind, typed, within};
use super::{Validator, missing_file};
use crate::codes;
use crate::descriptor::{PRESET, ParamDescriptor, ParamValue, PassDescriptor};
use crate::file::PassEntry;
use crate::graph::{ParamRef, ParamSetting, Pass};
use crate::handle::{Handle, Table};
use crate::overrides::moved_to_argument;

type Settings = Table<ParamDescriptor, ParamSetting>;

impl<'a> Validator<'a> {
    /// Sets every parameter of a pass: to its default or what a preset puts in its place, to what the file says, to
    /// what the command line says.
    pub(super) fn set_params(&mut self, pass: Handle<Pass>, entry: &'a PassEntry) {
        let kind = self.kind_of(pass);
        let params = &kind.descriptor.params;
        let mut settings: Settings = params.iter().map(|param| ParamSetting::Value(param.default.clone())).collect();
        let mut given = params.column(false);
        let file = self.file;
        for entry in &entry.params {
            let name = file.text(&entry.name);
            let Some(index) = kind.descriptor.param_named(name) else {
                if self.is_known_pass(pass) {
                    let message = format!("`{}` has no parameter named `{name}`", kind.descriptor.name);
                    let place = self.place(entry.name.span);
                    let names = params.iter().map(|param| param.name.as_str());
                    self.report_unknown((codes::UNKNOWN_PARAMETER, place), message, name, names, str::to_owned);
                }
                self.mark_used(&entry.value);
                continue;
            };
            given[index] = true;
            let param = ParamRef { pass, param: index };
            if let Some(setting) = self.setting(&params[index], param, &entry.value) {
                settings[index] = setting;
            }
            self.size_place(param, &settings[index], self.place(entry.value.span));
        }
        if !self.params.passes.is_empty() {
            self.override_settings(pass, params, &mut settings, &mut given);
        }
        use_preset(&kind.descriptor, &mut settings, &given);
        self.passes[pass].params = settings;
    }

    fn override_settings(
        &mut self,
        pass: Handle<Pass>,
        params: &Table<ParamDescriptor>,
        settings: &mut Settings,
        was_given: &mut Table<ParamDescriptor, bool>,
    ) {
        for (index, descriptor) in params.entries() {
            let param = ParamRef { pass, param: index };
            let Some(given) = self.params.passes.get(&param).copied() else { continue };
            was_given[index] = true;
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
        let value = self.params.graph[index].value.clone()?;
        let definition = self.place(self.params.graph[index].definition);
        let given = &mut self.params.graph[index];
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
    pub(super) fn graph_param(&mut self, name: &str, place: &Place) -> Option<Handle<GraphValue>> {
        let found = self.params.by_name.get(name).copied();
        match found {
            Some(index) => self.params.graph[index].used = true,
            None => {
                let message = format!("the graph has no parameter named `{name}`");
                let file = self.file;
                let names = file.params.iter().map(|param| file.text(&param.name)).chain(["frame", "time"]);
                let code = (codes::UNKNOWN_NAME, place.clone());
                let near = self.report_unknown(code, message, name, names, |near| format!("${near}"));
                // What was probably meant is not unused as well.
                if let Some(index) = near.and_then(|near| self.params.by_name.get(near)) {
                    self.params.graph[*index].used = true;
                }
            }
        }
        found
    }

    /// A parameter that only a mistake uses is not unused as well.
    fn mark_used(&mut self, node: &Node) {
        let index = reference(node).and_then(|name| self.params.by_name.get(name));
        if let Some(index) = index {
            self.params.graph[*index].used = true;
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
            let name = &kind.descriptor.params[param.param].name;
            let message = format!("`{name}` sets the size of a port, and cannot change from frame to frame");
            self.report(Diagnostic::error(codes::LIVE_SIZE, place.clone(), message));
        }
        if let ParamSetting::Value(ParamValue::File(path)) = setting {
            let size = self.catalogue.picture_size.and_then(|size| size(Path::new(path)));
            // A file that is not there has been reported already.
            let size = size.or_else(|| (!(self.exists)(Path::new(path))).then_some((1, 1)));
            // A later setting of the command line replaces that of the file, also where it is no picture.
            match size {
                Some(size) => self.pictures.insert(param, size),
                None => self.pictures.remove(&param),
            };
        }
        self.size_param_places.insert(param, place);
    }

    /// Where a pass's name stands.
    pub(super) fn pass_span(&self, pass: Handle<Pass>) -> Span {
        self.file.passes[pass].name.span
    }
}

/// Puts the values of the chosen preset in the place of the defaults of all parameters that are not given.
fn use_preset(descriptor: &PassDescriptor, settings: &mut Settings, given: &Table<ParamDescriptor, bool>) {
    let chosen = descriptor.param_named(PRESET).and_then(|index| match &settings[index] {
        ParamSetting::Value(ParamValue::Choice(word)) => descriptor.presets.iter().find(|preset| preset.name == *word),
        _ => None,
    });
    for (name, value) in chosen.map(|preset| preset.values.as_slice()).unwrap_or_default() {
        if let Some(index) = descriptor.param_named(name).filter(|index| !given[*index]) {
            settings[index] = ParamSetting::Value(value.clone());
        }
    }
}

/// The name behind the `$`.
fn reference(node: &Node) -> Option<&str> {
    match &node.value {
        Value::Text(text) => text.strip_prefix('$'),
        _ => None,
    }
}
