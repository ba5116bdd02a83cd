//! The spanned tree of a graph file: what the text says, before any name is looked up.

use std::sync::Arc;

use tyndall_document::{Node, Source, Span};

use crate::graph::Pass;
use crate::handle::Table;

mod read;

pub use read::read;

/// A graph file, as read from its text.
#[derive(Debug, Clone)]
pub struct GraphFile {
    /// The text.
    pub source: Arc<Source>,
    /// What the graph is for; empty if the file does not say.
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
    /// The place of the outputs; the whole file if there are none.
    pub outputs_span: Span,
    /// Whether mistakes were reported while it was read, so that it cannot become a graph.
    pub broken: bool,
}

/// Something, and its place.
#[derive(Debug, Clone, PartialEq)]
pub struct Spanned<T> {
    /// The value.
    pub value: T,
    /// Its place.
    pub span: Span,
}

/// A text of the file. Most are in the file letter by letter, so only the others are stored; [`GraphFile::text`] reads both.
#[derive(Debug, Clone)]
pub struct Text {
    /// Its place, quotes included.
    pub span: Span,
    escaped: Option<Box<str>>,
}

impl GraphFile {
    /// What a text of this file says.
    pub fn text<'a>(&'a self, text: &'a Text) -> &'a str {
        match &text.escaped {
            Some(text) => text,
            // `Text::new` has checked that each quote is one byte.
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
    /// Its value, or the text `$name`.
    pub value: Node,
}

/// A pass of the file.
#[derive(Debug, Clone)]
pub struct PassEntry {
    /// Name.
    pub name: Text,
    /// What `use` says; `None` if it is missing, which has been reported.
    pub kind: Option<Text>,
    /// Inputs, in file order.
    pub inputs: Vec<InputEntry>,
    /// Parameters, in file order.
    pub params: Vec<ParamEntry>,
    /// What `enabled` says.
    pub enabled: Option<Spanned<Switch>>,
}

/// An input that is connected.
#[derive(Debug, Clone)]
pub struct InputEntry {
    /// Name of the input.
    pub name: Text,
    /// `pass.port`; `None` if it is something else, which has been reported.
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
