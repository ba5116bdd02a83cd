//! Whether a value is one that a parameter may have.

use tyndall_document::{Code, Decoder, Diagnostic, Node, OUT_OF_RANGE, Place, Value, did_you_mean, near};

use crate::codes;
use crate::descriptor::{ParamDescriptor, ParamValue};

/// A value that does not do, in words.
pub(super) struct Mistake {
    code: Code,
    message: String,
    suggestion: Option<String>,
}

impl Mistake {
    fn new(code: Code, message: String) -> Self {
        Self { code, message, suggestion: None }
    }

    /// The mistake at its place.
    pub fn at(self, place: Place) -> Diagnostic {
        let diagnostic = Diagnostic::error(self.code, place, self.message);
        match self.suggestion {
            Some(suggestion) => diagnostic.suggest(suggestion),
            None => diagnostic,
        }
    }
}

/// A value of the parameter's type and within its range.
pub(super) fn typed(decoder: &mut Decoder<'_>, param: &ParamDescriptor, node: &Node) -> Option<ParamValue> {
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
pub(super) fn converted(value: ParamValue, default: &ParamValue) -> Option<ParamValue> {
    Some(match (value, default) {
        (ParamValue::Integer(value), ParamValue::Float(_)) => ParamValue::Float(value as f64),
        (ParamValue::Choice(text), ParamValue::File(_)) => ParamValue::File(text),
        (value, default) if same_kind(&value, default) => value,
        _ => return None,
    })
}

pub(super) fn same_kind(a: &ParamValue, b: &ParamValue) -> bool {
    match (a, b) {
        (ParamValue::Vector(a), ParamValue::Vector(b)) => a.len() == b.len(),
        _ => std::mem::discriminant(a) == std::mem::discriminant(b),
    }
}

pub(super) fn kind_of(param: &ParamDescriptor) -> String {
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
pub(super) fn within(param: &ParamDescriptor, value: &ParamValue) -> Result<(), Mistake> {
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
    Err(Mistake::new(OUT_OF_RANGE, format!("`{}` is {bounds}{unit}, and not {value}", param.name)))
}

fn unknown_choice(param: &ParamDescriptor, word: &str) -> Mistake {
    let words: Vec<String> = param.choices.iter().map(|word| format!("`{word}`")).collect();
    let message = format!("`{}` is one of {}, and not `{word}`", param.name, words.join(", "));
    let suggestion = near(word, param.choices.iter().map(String::as_str)).map(did_you_mean);
    Mistake { suggestion, ..Mistake::new(codes::UNKNOWN_CHOICE, message) }
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
