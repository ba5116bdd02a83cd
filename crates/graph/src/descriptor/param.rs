//! Parameters of passes: what each accepts, and what is wrong with a value that it does not accept.

use tyndall_document::{Decoder, Node};

use super::{ParamValue, Refusal};

/// One parameter of a pass.
#[derive(Debug, Clone, PartialEq)]
pub struct ParamDescriptor {
    /// Name in graph files, and of the member of the WGSL `Params` or of the `override`.
    pub name: String,
    /// What it does.
    pub about: String,
    /// Unit; `""` if there is none.
    pub unit: String,
    /// What it accepts.
    pub accepts: ParamType,
    /// Value where a graph gives none.
    pub default: ParamValue,
    /// Whether it is part of the pipeline (an `override` in WGSL), so that a change builds a new one.
    pub fixed: bool,
}

/// What a parameter accepts.
///
/// A range is the smallest and the largest value of every component, inclusive. Without one, and beyond one, it is what
/// 32 bits of a shader hold.
#[derive(Debug, Clone, PartialEq)]
pub enum ParamType {
    /// A switch; `u32` 0 or 1 in WGSL.
    Bool,
    /// A whole number; `i32` or `u32` in WGSL.
    Integer {
        /// Its range.
        range: Option<(f64, f64)>,
    },
    /// A number; `f32` in WGSL.
    Float {
        /// Its range.
        range: Option<(f64, f64)>,
    },
    /// Two to four numbers; `vec2<f32>` to `vec4<f32>` in WGSL.
    Vector {
        /// How many.
        length: usize,
        /// The range of each.
        range: Option<(f64, f64)>,
    },
    /// One of these words; `u32` index in WGSL.
    Choice {
        /// The words.
        words: Vec<String>,
    },
    /// A path, relative to the file that holds it; for passes in Rust.
    File,
}

impl ParamDescriptor {
    /// The value that stands at a node; reports a node that is of another type or not accepted.
    pub fn read(&self, decoder: &mut Decoder<'_>, node: &Node) -> Option<ParamValue> {
        self.accepts.read(decoder, node, &self.name, &self.unit)
    }

    /// Whether it accepts a value.
    ///
    /// # Errors
    /// What is wrong with the value.
    pub fn check(&self, value: &ParamValue) -> Result<(), Refusal> {
        self.accepts.check(value, &self.unit)
    }
}

impl ParamType {
    /// The value that stands at a node, for a parameter of this name and unit; reports a node that is of another type or
    /// not accepted.
    pub fn read(&self, decoder: &mut Decoder<'_>, node: &Node, name: &str, unit: &str) -> Option<ParamValue> {
        let value = match self {
            ParamType::Bool => ParamValue::Bool(decoder.bool(node)?),
            ParamType::Integer { .. } => ParamValue::Integer(decoder.integer(node)?),
            ParamType::Float { .. } => ParamValue::Float(decoder.float(node)?),
            ParamType::Vector { length: 2, .. } => ParamValue::Vector(decoder.floats::<2>(node)?.to_vec()),
            ParamType::Vector { length: 3, .. } => ParamValue::Vector(decoder.floats::<3>(node)?.to_vec()),
            ParamType::Vector { .. } => ParamValue::Vector(decoder.floats::<4>(node)?.to_vec()),
            ParamType::Choice { .. } => ParamValue::Choice(decoder.text(node)?.to_owned()),
            ParamType::File => ParamValue::File(decoder.text(node)?.to_owned()),
        };
        match self.check(&value, unit) {
            Ok(()) => Some(value),
            Err(refusal) => {
                decoder.report(refusal.at(name, decoder.place(node.span)));
                None
            }
        }
    }

    /// Whether a parameter of this unit accepts a value.
    ///
    /// # Errors
    /// What is wrong with the value.
    pub fn check(&self, value: &ParamValue, unit: &str) -> Result<(), Refusal> {
        let integers = (f64::from(i32::MIN), f64::from(u32::MAX));
        let floats = (f64::from(f32::MIN), f64::from(f32::MAX));
        match (self, value) {
            (ParamType::Bool, ParamValue::Bool(_)) | (ParamType::File, ParamValue::File(_)) => Ok(()),
            (ParamType::Integer { range }, ParamValue::Integer(value)) => {
                Refusal::unless_within(*value as f64, *range, integers, unit)
            }
            (ParamType::Float { range }, ParamValue::Float(value)) => {
                Refusal::unless_within(*value, *range, floats, unit)
            }
            (ParamType::Vector { length, range }, ParamValue::Vector(values)) if *length == values.len() => {
                values.iter().try_for_each(|value| Refusal::unless_within(*value, *range, floats, unit))
            }
            (ParamType::Choice { words }, ParamValue::Choice(word)) => Refusal::unless_one_of(word, words),
            _ => Err(Refusal::of_type(&self.words(), value)),
        }
    }

    /// A value of another type as one of this, where it can serve as one: a whole number as a number, a text as a path.
    pub fn convert(&self, value: ParamValue) -> Option<ParamValue> {
        match (self, value) {
            (ParamType::Float { .. }, ParamValue::Integer(value)) => Some(ParamValue::Float(value as f64)),
            (ParamType::File, ParamValue::Choice(text)) => Some(ParamValue::File(text)),
            (_, value) => self.is_type_of(&value).then_some(value),
        }
    }

    /// Whether a value is of this type, accepted or not.
    pub fn is_type_of(&self, value: &ParamValue) -> bool {
        match (self, value) {
            (ParamType::Vector { length, .. }, ParamValue::Vector(values)) => *length == values.len(),
            (ParamType::Bool, ParamValue::Bool(_))
            | (ParamType::Integer { .. }, ParamValue::Integer(_))
            | (ParamType::Float { .. }, ParamValue::Float(_))
            | (ParamType::Choice { .. }, ParamValue::Choice(_))
            | (ParamType::File, ParamValue::File(_)) => true,
            _ => false,
        }
    }

    /// The range that it states.
    pub fn range(&self) -> Option<(f64, f64)> {
        match self {
            ParamType::Integer { range } | ParamType::Float { range } | ParamType::Vector { range, .. } => *range,
            ParamType::Bool | ParamType::Choice { .. } | ParamType::File => None,
        }
    }

    /// The words to choose from; none of a type that is not a choice.
    pub fn choices(&self) -> &[String] {
        if let ParamType::Choice { words } = self { words } else { &[] }
    }

    /// `a whole number`.
    pub fn words(&self) -> String {
        match self {
            ParamType::Bool => "a switch".to_owned(),
            ParamType::Integer { .. } => "a whole number".to_owned(),
            ParamType::Float { .. } => "a number".to_owned(),
            ParamType::Vector { length, .. } => format!("{length} numbers"),
            ParamType::Choice { .. } => "a choice".to_owned(),
            ParamType::File => "a file".to_owned(),
        }
    }
}
