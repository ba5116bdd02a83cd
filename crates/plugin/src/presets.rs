//! Presets of a manifest: values of several parameters under one word.
//!
//! ```ron
//! presets: {
//!     "clear": (about: "The defaults"),
//!     "dusk": (about: "A darker picture", values: { "exposure": 0.25 }),
//! }
//! ```

use tyndall_document::{Decoder, Diagnostic, Node, Span};
use tyndall_graph::descriptor::{PRESET, ParamDescriptor, ParamValue, Preset};

use crate::codes::BAD_PARAM;
use crate::manifest::Entry;

/// The presets of a pass with these parameters.
pub(crate) fn presets(decoder: &mut Decoder<'_>, entries: &[Entry], params: &[ParamDescriptor]) -> Vec<Preset> {
    entries.iter().filter_map(|entry| preset(decoder, entry, params)).collect()
}

fn preset(decoder: &mut Decoder<'_>, entry: &Entry, params: &[ParamDescriptor]) -> Option<Preset> {
    let fields = decoder.fields(&entry.value, "a preset", &["about", "values"])?;
    let about = fields.required(decoder, "about").and_then(|node| decoder.text(node)).unwrap_or_default().to_owned();
    let given = fields.get("values").and_then(|node| decoder.map(node)).unwrap_or_default();
    let mut values = Vec::new();
    for (name, span, node) in given {
        match params.iter().find(|param| param.name == name) {
            Some(param) => values.extend(value(decoder, node, param).map(|value| (name.to_owned(), value))),
            None => unknown(decoder, name, span, params),
        }
    }
    Some(Preset { name: entry.name.clone(), about, values })
}

/// A value of the type of the parameter's default; whether it is in its range is told with the descriptor.
fn value(decoder: &mut Decoder<'_>, node: &Node, param: &ParamDescriptor) -> Option<ParamValue> {
    Some(match &param.default {
        ParamValue::Bool(_) => ParamValue::Bool(decoder.bool(node)?),
        ParamValue::Integer(_) => ParamValue::Integer(decoder.integer(node)?),
        ParamValue::Float(_) => ParamValue::Float(decoder.float(node)?),
        ParamValue::Vector(default) => ParamValue::Vector(match default.len() {
            2 => decoder.floats::<2>(node)?.to_vec(),
            3 => decoder.floats::<3>(node)?.to_vec(),
            _ => decoder.floats::<4>(node)?.to_vec(),
        }),
        ParamValue::Choice(_) => ParamValue::Choice(decoder.text(node)?.to_owned()),
        ParamValue::File(_) => ParamValue::File(decoder.text(node)?.to_owned()),
    })
}

fn unknown(decoder: &mut Decoder<'_>, name: &str, span: Span, params: &[ParamDescriptor]) {
    let message = format!("the pass has no parameter `{name}` that a preset could give");
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
        default: ParamValue::Choice(first.name.clone()),
        range: None,
        choices: presets.iter().map(|preset| preset.name.clone()).collect(),
        fixed: false,
    })
}
