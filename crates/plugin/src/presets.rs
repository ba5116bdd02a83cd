//! Presets of a manifest: values of several parameters under one word.
//!
//! ```ron
//! presets: {
//!     "clear": (about: "The defaults"),
//!     "dusk": (about: "A darker picture", values: { "exposure": 0.25 }),
//! }
//! ```

use tyndall_document::{Decoder, Diagnostic, Span};
use tyndall_graph::descriptor::{PRESET, ParamDescriptor, ParamType, ParamValue, Preset};

use crate::codes::BAD_PARAM;
use crate::keys;
use crate::manifest::Entry;

/// The presets of a pass with these parameters.
pub(crate) fn presets(decoder: &mut Decoder<'_>, entries: &[Entry], params: &[ParamDescriptor]) -> Vec<Preset> {
    entries.iter().filter_map(|entry| preset(decoder, entry, params)).collect()
}

fn preset(decoder: &mut Decoder<'_>, entry: &Entry, params: &[ParamDescriptor]) -> Option<Preset> {
    let fields = decoder.fields(&entry.value, "a preset", keys::PRESET)?;
    let about = fields.required(decoder, "about").and_then(|node| decoder.text(node)).unwrap_or_default().to_owned();
    let given = fields.get("values").and_then(|node| decoder.map(node)).unwrap_or_default();
    let mut values = Vec::new();
    for (name, span, node) in given {
        match params.iter().find(|param| param.name == name) {
            Some(param) => values.extend(param.read(decoder, node).map(|value| (name.to_owned(), value))),
            None => unknown(decoder, name, span, params),
        }
    }
    Some(Preset { name: entry.name.clone(), about, values })
}

fn unknown(decoder: &mut Decoder<'_>, name: &str, span: Span, params: &[ParamDescriptor]) {
    let message = format!("the preset sets `{name}`, which is not a parameter of the pass");
    let problem = Diagnostic::error(BAD_PARAM, decoder.place(span), message);
    decoder.report(problem.suggest_near(name, params.iter().map(|param| param.name.as_str())));
}

/// The parameter that chooses one of them; the first is the default.
pub(crate) fn preset_param(presets: &[Preset]) -> Option<ParamDescriptor> {
    let first = presets.first()?;
    Some(ParamDescriptor {
        name: PRESET.to_owned(),
        about: "Values of several parameters under one word; a parameter that is given keeps what it is given"
            .to_owned(),
        unit: String::new(),
        accepts: ParamType::Choice { words: presets.iter().map(|preset| preset.name.clone()).collect() },
        default: ParamValue::Choice(first.name.clone()),
        fixed: false,
    })
}
