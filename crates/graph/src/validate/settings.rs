//! Parameters of passes: of the right type, within their range, or set to a parameter of the graph.

use std::path::Path;

use rustc_hash::FxHashMap;
use tyndall_document::{Diagnostic, Place};

use super::mistakes::Mistakes;
use super::params::{GraphValue, Params};
use super::scope::{Scope, missing_file};
use super::stated::{Stated, overrides, unknown_param};
use crate::codes;
use crate::descriptor::{PRESET, ParamDescriptor, ParamValue, PassDescriptor};
use crate::file::PassEntry;
use crate::graph::{ParamRef, ParamSetting, Pass, SizeParam};
use crate::handle::{Handle, Table};
use crate::overrides::Override;

/// What every parameter of every pass is set to.
#[derive(Default)]
pub(super) struct Settings {
    pub of_passes: OfPasses,
    /// Which parameters of passes are set to a parameter of the graph.
    pub uses: Vec<(Handle<GraphValue>, ParamRef)>,
    /// The parameters of the graph that are used, even where that is a mistake.
    pub used: Vec<Handle<GraphValue>>,
    /// The parameters that set sizes, where they are set.
    pub size_params: FxHashMap<ParamRef, SizeParam>,
}

pub(super) type OfPasses = Table<Pass, OfPass>;
type OfPass = Table<ParamDescriptor, ParamSetting>;

/// Sets every parameter of every pass: to its default or a preset's value, then as the file says, then as the command line
/// says.
pub(super) fn read(scope: &Scope<'_>, params: &Params<'_>, out: &mut Mistakes) -> Settings {
    let overrides = overrides(scope, out);
    let mut reader = Reader { scope, params, overrides, settings: Settings::default(), out };
    for (pass, entry) in scope.file.passes.entries() {
        let settings = reader.pass(pass, entry);
        reader.settings.of_passes.push(settings);
    }
    reader.settings
}

/// The settings of a pass, and which of them the file or the command line gives.
struct Found {
    settings: OfPass,
    is_given: Table<ParamDescriptor, bool>,
}

struct Reader<'s, 'a> {
    scope: &'s Scope<'a>,
    params: &'s Params<'a>,
    overrides: FxHashMap<ParamRef, &'a Override>,
    settings: Settings,
    out: &'s mut Mistakes,
}

impl<'a> Reader<'_, 'a> {
    fn pass(&mut self, pass: Handle<Pass>, entry: &'a PassEntry) -> OfPass {
        let (scope, file) = (self.scope, self.scope.file);
        let descriptor = &scope.passes.kind(pass).descriptor;
        let defaults = descriptor.params.iter().map(|param| ParamSetting::Value(param.default.clone()));
        let mut found = Found { settings: defaults.collect(), is_given: descriptor.params.column(false) };
        for entry in &entry.params {
            let name = file.text(&entry.name);
            let stated = Stated { node: &entry.value, source: &file.source, argument: None };
            if let Some(param) = descriptor.param_named(name) {
                self.set(&mut found, ParamRef { pass, param }, stated);
                continue;
            }
            if scope.is_known(pass) {
                unknown_param(descriptor, name, scope.place(entry.name.span), str::to_owned, self.out);
            }
            self.settings.used.extend(stated.reference().and_then(|name| self.params.find(name)));
        }
        for param in descriptor.params.handles().map(|param| ParamRef { pass, param }) {
            if let Some(Override { value: node, source, argument, .. }) = self.overrides.get(&param).copied() {
                self.settings.uses.retain(|(_, by)| *by != param);
                self.set(&mut found, param, Stated { node, source, argument: Some(argument) });
            }
        }
        use_preset(descriptor, &mut found);
        found.settings
    }

    /// Sets a parameter to what is given.
    fn set(&mut self, found: &mut Found, param: ParamRef, given: Stated<'_>) {
        let kind = self.scope.passes.kind(param.pass);
        let descriptor = &kind.descriptor.params[param.param];
        found.is_given[param.param] = true;
        if let Some(setting) = self.setting(descriptor, param, given) {
            found.settings[param.param] = setting;
        }
        if kind.signature.size_params.contains(&param.param) {
            self.size_param(&descriptor.name, param, &found.settings[param.param], given.place());
        }
    }

    /// What is given as a setting of a parameter.
    fn setting(&mut self, descriptor: &ParamDescriptor, param: ParamRef, given: Stated<'_>) -> Option<ParamSetting> {
        if let Some(name) = given.reference() {
            return self.referred(name, descriptor, param, given.place());
        }
        let mut value = given.typed(descriptor, self.out)?;
        self.find_file(&mut value, given.argument.is_none(), given.place());
        Some(ParamSetting::Value(value))
    }

    /// What `$name`, at `place`, sets a parameter to.
    fn referred(
        &mut self,
        name: &str,
        descriptor: &ParamDescriptor,
        param: ParamRef,
        place: Place,
    ) -> Option<ParamSetting> {
        if let "frame" | "time" = name {
            return self.live(name, descriptor, place);
        }
        let found = self.params.resolve(self.scope, name, &place, self.out);
        self.settings.used.extend(found.map_or_else(|meant| meant, Some));
        let found = found.ok()?;
        let source = &self.params.values[found];
        let value = source.value.clone()?;
        self.settings.uses.push((found, param));
        let Some(mut value) = descriptor.accepts.convert(value) else {
            self.report_other_type(source, descriptor, place);
            return None;
        };
        if let Err(refusal) = descriptor.check(&value) {
            let mistake = refusal.at(&descriptor.name, source.place.clone());
            self.out.report(mistake.relate(place, "used here"));
            return None;
        }
        self.find_file(&mut value, !source.overridden, source.place.clone());
        Some(ParamSetting::Value(value))
    }

    /// A parameter that is set to `$frame` or `$time`.
    fn live(&mut self, name: &str, descriptor: &ParamDescriptor, place: Place) -> Option<ParamSetting> {
        let fits = |number: ParamValue| descriptor.accepts.is_type_of(&number);
        match name {
            "frame" if fits(ParamValue::Integer(0)) || fits(ParamValue::Float(0.0)) => Some(ParamSetting::Frame),
            "time" if fits(ParamValue::Float(0.0)) => Some(ParamSetting::Time),
            _ => {
                let what = if name == "time" { "a number of seconds" } else { "a whole number" };
                let message = format!("`{}` is {}, but ${name} is {what}", descriptor.name, descriptor.accepts.words());
                self.out.report(Diagnostic::error(codes::WRONG_REFERENCE_TYPE, place, message));
                None
            }
        }
    }

    fn report_other_type(&mut self, source: &GraphValue, descriptor: &ParamDescriptor, place: Place) {
        let message = format!("`{}` is {}, but ${} is not", descriptor.name, descriptor.accepts.words(), source.name);
        let (at, related, what) = match source.overridden {
            true => (source.place.clone(), place, "used here"),
            false => (place, self.scope.place(source.definition), "defined here"),
        };
        self.out.report(Diagnostic::error(codes::WRONG_REFERENCE_TYPE, at, message).relate(related, what));
    }

    /// Makes a path from the graph's file relative to the working directory, and checks that the file exists.
    fn find_file(&mut self, value: &mut ParamValue, is_beside_file: bool, place: Place) {
        let ParamValue::File(path) = value else { return };
        if is_beside_file {
            *path = self.scope.beside_file(path);
        }
        if !path.contains("####") && !self.scope.exists(path) {
            self.out.report(missing_file(path, place));
        }
    }

    /// Remembers where a parameter that sets a size is set, and refuses one that changes with the frame.
    fn size_param(&mut self, name: &str, param: ParamRef, setting: &ParamSetting, place: Place) {
        let mut picture = None;
        match setting {
            ParamSetting::Value(ParamValue::File(path)) => {
                let size = self.scope.request.catalogue.picture_size.and_then(|size| size(Path::new(path)));
                // A missing file has been reported already.
                picture = size.or_else(|| (!self.scope.exists(path)).then_some((1, 1)));
            }
            ParamSetting::Value(_) => {}
            ParamSetting::Frame | ParamSetting::Time => {
                let message = format!("`{name}` sets the size of a port, so it cannot change from frame to frame");
                self.out.report(Diagnostic::error(codes::LIVE_SIZE, place.clone(), message));
            }
        }
        self.settings.size_params.insert(param, SizeParam { place, picture });
    }
}

/// Replaces the defaults of all parameters that are not set by the values of the chosen preset.
fn use_preset(descriptor: &PassDescriptor, found: &mut Found) {
    let chosen = descriptor.param_named(PRESET).and_then(|param| match &found.settings[param] {
        ParamSetting::Value(ParamValue::Choice(word)) => descriptor.presets.iter().find(|preset| preset.name == *word),
        _ => None,
    });
    for (name, value) in chosen.map(|preset| preset.values.as_slice()).unwrap_or_default() {
        if let Some(param) = descriptor.param_named(name).filter(|param| !found.is_given[*param]) {
            found.settings[param] = ParamSetting::Value(value.clone());
        }
    }
}
