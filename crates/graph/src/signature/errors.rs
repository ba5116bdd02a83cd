//! What a descriptor can get wrong.

use std::fmt;

use tyndall_document::NAME_RULE;

/// What a descriptor gets wrong.
#[derive(Debug, Clone, PartialEq, Eq)]
#[allow(missing_docs, reason = "the text that each displays says it")]
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
            E::DuplicatePass(name) => write!(f, "there is a pass named `{name}` already"),
            E::BadName(name) => write!(f, "{name:?} is not a valid name: {NAME_RULE}"),
            E::DuplicatePort(name) => write!(f, "two ports are named `{name}`"),
            E::DuplicateParam(name) => write!(f, "two parameters are named `{name}`"),
            E::UnknownSizePort { port, named } => write!(f, "the size of `{port}` names `{named}`, which is no port"),
            E::HistorySize { port, named } => {
                write!(f, "the size of `{port}` names the history port `{named}`, whose size is known last")
            }
            E::UnknownSizeParam { port, named } => {
                write!(f, "the size of `{port}` names `{named}`, which is no parameter")
            }
            E::SizeParamNotInteger { port, named } => {
                write!(f, "the size of `{port}` names the parameter `{named}`, which is not a whole number")
            }
            E::BadScale { port } => write!(f, "the size of `{port}` has a factor that is not above 0"),
            E::ZeroSize { port } => write!(f, "the size of `{port}` has an extent of 0"),
            E::SizeCycle { port } => write!(f, "the size of `{port}` follows from itself"),
            E::NoFormat { port } => write!(f, "the output `{port}` has no format"),
            E::NoClass { port } => write!(f, "the output `{port}` has any class, but its size names no texture input"),
            E::UnknownThrough { port, named } => {
                write!(f, "where the pass is off `{port}` gives `{named}`, which is no input")
            }
            E::ThroughHistory { port, named } => {
                write!(f, "where the pass is off `{port}` gives the history port `{named}`, which holds another frame")
            }
            E::ThroughOther { port, named } => {
                write!(f, "where the pass is off `{port}` gives `{named}`, which is of another kind")
            }
            E::NoChoices(param) => write!(f, "the parameter `{param}` has no words to choose from"),
            E::BadPreset { preset, why } => write!(f, "the preset `{preset}` {why}"),
            E::BadDefault { param, why } => write!(f, "the default of the parameter `{param}` {why}"),
        }
    }
}

impl std::error::Error for DescriptorError {}
