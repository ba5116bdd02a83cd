//! What is wrong with the value of a parameter.

use std::fmt;

use tyndall_document::{Code, Diagnostic, OUT_OF_RANGE, Place, WRONG_TYPE, did_you_mean, near};

use super::ParamValue;
use crate::codes;

/// Why a parameter does not accept a value: `must be at least 1, got 0`.
#[derive(Debug, Clone, PartialEq)]
pub struct Refusal {
    code: Code,
    why: String,
    suggestion: Option<String>,
}

impl Refusal {
    /// As the mistake of a parameter of this name, at its place.
    pub fn at(self, name: &str, place: Place) -> Diagnostic {
        let diagnostic = Diagnostic::error(self.code, place, format!("`{name}` {}", self.why));
        match self.suggestion {
            Some(suggestion) => diagnostic.suggest(suggestion),
            None => diagnostic,
        }
    }

    /// A value of another type than `wanted`.
    pub(super) fn of_type(wanted: &str, value: &ParamValue) -> Self {
        let got = if let ParamValue::Integer(_) = value { "a whole number" } else { value.words() };
        Self { code: WRONG_TYPE, why: format!("must be {wanted}, got {got}"), suggestion: None }
    }

    /// A number within a range, and within that of its type.
    pub(super) fn unless_within(
        value: f64,
        range: Option<(f64, f64)>,
        of_type: (f64, f64),
        unit: &str,
    ) -> Result<(), Self> {
        let (low, high) = range.unwrap_or(of_type);
        let (low, high) = (low.max(of_type.0), high.min(of_type.1));
        if value >= low && value <= high {
            return Ok(());
        }
        let bounds = match (low == of_type.0, high == of_type.1) {
            (false, true) => format!("at least {low}"),
            (true, false) => format!("at most {high}"),
            _ => format!("between {low} and {high}"),
        };
        let unit = if matches!(unit, "" | "1") { String::new() } else { format!(" {unit}") };
        let why = format!("must be {bounds}{unit}, got {value}");
        Err(Self { code: OUT_OF_RANGE, why, suggestion: None })
    }

    /// One of some words.
    pub(super) fn unless_one_of(word: &str, words: &[String]) -> Result<(), Self> {
        if words.iter().any(|other| other == word) {
            return Ok(());
        }
        let quoted: Vec<String> = words.iter().map(|word| format!("`{word}`")).collect();
        let why = format!("must be one of {}, got `{word}`", quoted.join(", "));
        let near = near(word, words.iter().map(String::as_str));
        Err(Self { code: codes::UNKNOWN_CHOICE, why, suggestion: near.map(did_you_mean) })
    }
}

impl fmt::Display for Refusal {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.why)
    }
}
