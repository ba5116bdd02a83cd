//! Mistakes in descriptors.

use std::fmt;

use tyndall_document::NAME_RULE;

/// A mistake in a descriptor.
#[derive(Debug, Clone, PartialEq, Eq)]
#[allow(missing_docs, reason = "each displays its meaning")]
pub enum DescriptorError {
    DuplicatePass(String),
    BadName(String),
    DuplicatePort(String),
    DuplicateParam(String),
    UnknownSizePort { port: String, named: String },
    HistorySize { port: String, named: String },
    UnknownSizeParam { port: String, named: String },
    SizeParamNotInteger { port: String, named: String },
    BadScale { port: String },
    ZeroSize { port: String },
    SizeCycle { port: String },
    NoFormat { port: String },
    NoClass { port: String },
    UnknownThrough { port: String, named: String },
    ThroughHistory { port: String, named: String },
    ThroughOther { port: String, named: String },
    NoChoices(String),
    BadDefault { param: String, why: String },
    BadPreset { preset: String, why: String },
}

impl fmt::Display for DescriptorError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        use DescriptorError as E;
        match self {
            E::DuplicatePass(name) => write!(f, "there already is a pass `{name}`"),
            E::BadName(name) => write!(f, "{name:?} is not a valid name: {NAME_RULE}"),
            E::DuplicatePort(name) => write!(f, "two ports are named `{name}`"),
            E::DuplicateParam(name) => write!(f, "two parameters are named `{name}`"),
            E::UnknownSizePort { port, named } => {
                write!(f, "the size of `{port}` names `{named}`, which is not a port")
            }
            E::HistorySize { port, named } => {
                write!(f, "the size of `{port}` names the history port `{named}`, whose size is known last")
            }
            E::UnknownSizeParam { port, named } => {
                write!(f, "the size of `{port}` names `{named}`, which is not a parameter")
            }
            E::SizeParamNotInteger { port, named } => {
                write!(f, "the size of `{port}` names the parameter `{named}`, which is not a whole number")
            }
            E::BadScale { port } => write!(f, "the size of `{port}` has a factor that is not positive"),
            E::ZeroSize { port } => write!(f, "the size of `{port}` has an extent of 0"),
            E::SizeCycle { port } => write!(f, "the size of `{port}` depends on itself"),
            E::NoFormat { port } => write!(f, "the output `{port}` has no format"),
            E::NoClass { port } => write!(f, "the output `{port}` has any class, but its size names no texture input"),
            E::UnknownThrough { port, named } => {
                write!(f, "while the pass is off, `{port}` passes on `{named}`, which is not an input")
            }
            E::ThroughHistory { port, named } => {
                write!(
                    f,
                    "while the pass is off, `{port}` passes on the history port `{named}`, which holds another frame"
                )
            }
            E::ThroughOther { port, named } => {
                write!(f, "while the pass is off, `{port}` passes on `{named}`, which is of another kind")
            }
            E::NoChoices(param) => write!(f, "the parameter `{param}` has no choices"),
            E::BadPreset { preset, why } => write!(f, "the preset `{preset}` {why}"),
            E::BadDefault { param, why } => write!(f, "the default of the parameter `{param}` {why}"),
        }
    }
}

impl std::error::Error for DescriptorError {}
