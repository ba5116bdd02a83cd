//! Values of parameters.

use std::fmt;

use tyndall_document::{Decoder, Node, Value};

/// Value of a parameter.
#[derive(Debug, Clone, PartialEq)]
pub enum ParamValue {
    /// A switch.
    Bool(bool),
    /// A whole number.
    Integer(i64),
    /// A number.
    Float(f64),
    /// Two to four numbers.
    Vector(Vec<f64>),
    /// A word.
    Choice(String),
    /// A path.
    File(String),
}

impl ParamValue {
    /// A value as written: a text stays a [`ParamValue::Choice`] until its use says what it means.
    pub(crate) fn read(decoder: &mut Decoder<'_>, node: &Node) -> Option<Self> {
        match &node.value {
            Value::Bool(value) => Some(ParamValue::Bool(*value)),
            Value::Number(number) => match number.integer {
                Some(integer) => Some(ParamValue::Integer(integer)),
                None => decoder.float(node).map(ParamValue::Float),
            },
            Value::Text(text) if !text.starts_with('$') => Some(ParamValue::Choice(text.clone())),
            Value::Tuple(parts) if (2..=4).contains(&parts.len()) => {
                let numbers: Vec<Option<f64>> = parts.iter().map(|part| decoder.float(part)).collect();
                numbers.into_iter().collect::<Option<_>>().map(ParamValue::Vector)
            }
            _ => {
                decoder.wrong_type(node, "a switch, a number, a string or 2 to 4 numbers");
                None
            }
        }
    }

    /// What it is, in words; a whole number is a number like any other.
    pub(crate) fn words(&self) -> &'static str {
        match self {
            ParamValue::Bool(_) => "a switch",
            ParamValue::Integer(_) | ParamValue::Float(_) => "a number",
            ParamValue::Vector(parts) => ["", "", "2 numbers", "3 numbers", "4 numbers"][parts.len().min(4)],
            ParamValue::Choice(_) | ParamValue::File(_) => "a text",
        }
    }
}

impl fmt::Display for ParamValue {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            ParamValue::Bool(value) => write!(f, "{value}"),
            ParamValue::Integer(value) => write!(f, "{value}"),
            ParamValue::Float(value) => write!(f, "{value:?}"),
            ParamValue::Vector(values) => {
                let parts: Vec<String> = values.iter().map(|value| format!("{value:?}")).collect();
                write!(f, "({})", parts.join(", "))
            }
            ParamValue::Choice(word) | ParamValue::File(word) => write!(f, "{word:?}"),
        }
    }
}
