//! The spanned tree of a graph file: what the text says, before any name is looked up.

use std::sync::Arc;

use tyndall_document::{Node, Source, Span};

use crate::graph::Pass;
use crate::handle::Table;

mod read;

pub use read::read;

/// A graph file as it stands in its text.
#[derive(Debug, Clone)]
pub struct GraphFile {
    /// The text.
    pub source: Arc<Source>,
    /// What the graph is for; empty where the file does not say.
    pub about: String,
    /// Path of the scene, relative to the file.
    pub scene: Option<Spanned<String>>,
    /// Size of the frame in pixels.
    pub size: Option<Spanned<(u32, u32)>>,
    /// Parameters of the graph, in file order.
    pub params: Vec<ParamEntry>,
    /// Passes, in file order.
    pub passes: Table<Pass, PassEntry>,
    /// Outputs, in file order.
    pub outputs: Vec<OutputEntry>,
    /// Where the outputs stand; the whole file where they do not.
    pub outputs_span: Span,
    /// Mistakes were reported while it was read, so that no graph can come of it.
    pub broken: bool,
}

/// Something, and where it stands.
#[derive(Debug, Clone, PartialEq)]
pub struct Spanned<T> {
    /// What.
    pub value: T,
    /// Where.
    pub span: Span,
}

/// A text of the file. Most stand there letter by letter, so only the others are stored; [`GraphFile::text`] reads both.
#[derive(Debug, Clone)]
pub struct Text {
    /// Where, quotes included.
    pub span: Span,
    escaped: Option<Box<str>>,
}

impl GraphFile {
    /// What a text of this file says.
    pub fn text<'a>(&'a self, text: &'a Text) -> &'a str {
        match &text.escaped {
            Some(text) => text,
            // As `Text::new` has seen, the quotes are a byte each.
            None => &self.source.text()[text.span.start as usize + 1..text.span.end as usize - 1],
        }
    }
}

impl Text {
    fn new(source: &Source, span: Span, text: String) -> Self {
        let written = source.slice(span);
        let plain = written.strip_prefix('"').and_then(|written| written.strip_suffix('"')) == Some(&text);
        Self { span, escaped: (!plain).then(|| text.into_boxed_str()) }
    }
}

/// A named value.
#[derive(Debug, Clone)]
pub struct ParamEntry {
    /// Name.
    pub name: Text,
    /// Value, or a text `$name`.
    pub value: Node,
}

/// A pass of the file.
#[derive(Debug, Clone)]
pub struct PassEntry {
    /// Name.
    pub name: Text,
    /// What `use` says; `None` where it is missing, which has been reported.
    pub kind: Option<Text>,
    /// Inputs, in file order.
    pub inputs: Vec<InputEntry>,
    /// Parameters, in file order.
    pub params: Vec<ParamEntry>,
    /// What `enabled` says.
    pub enabled: Option<Spanned<Switch>>,
}

/// An input that is fed.
#[derive(Debug, Clone)]
pub struct InputEntry {
    /// Name of the input.
    pub name: Text,
    /// `pass.port`; `None` where something else stands there, which has been reported.
    pub from: Option<Text>,
}

/// An output of the graph.
#[derive(Debug, Clone)]
pub struct OutputEntry {
    /// Name of the output.
    pub name: Text,
    /// `pass.port`.
    pub from: Text,
}

/// What `enabled` says.
#[derive(Debug, Clone, PartialEq)]
pub enum Switch {
    /// `true` or `false`.
    Fixed(bool),
    /// `"$name"`, without the `$`.
    Param(String),
}
