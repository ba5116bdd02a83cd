//! The spanned tree of a graph file: what the text says, before any name is looked up.

use std::sync::Arc;

use tyndall_document::{Decoder, Diagnostic, Diagnostics, Fields, Node, Source, Span, Value, parse};

use crate::codes;

/// The version of the file format that this crate reads.
pub(crate) const VERSION: i64 = 1;

const GRAPH_FIELDS: &[&str] = &["version", "about", "scene", "size", "params", "passes", "outputs"];
const PASS_FIELDS: &[&str] = &["use", "inputs", "params", "enabled"];

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
    pub passes: Vec<PassEntry>,
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

/// A named value.
#[derive(Debug, Clone)]
pub struct ParamEntry {
    /// Name.
    pub name: Spanned<String>,
    /// Value, or a text `$name`.
    pub value: Node,
}

/// A pass of the file.
#[derive(Debug, Clone)]
pub struct PassEntry {
    /// Name.
    pub name: Spanned<String>,
    /// What `use` says; `None` where it is missing, which has been reported.
    pub kind: Option<Spanned<String>>,
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
    pub name: Spanned<String>,
    /// `pass.port`; `None` where something else stands there, which has been reported.
    pub from: Option<Spanned<String>>,
}

/// An output of the graph.
#[derive(Debug, Clone)]
pub struct OutputEntry {
    /// Name of the output.
    pub name: Spanned<String>,
    /// `pass.port`.
    pub from: Spanned<String>,
}

/// What `enabled` says.
#[derive(Debug, Clone, PartialEq)]
pub enum Switch {
    /// `true` or `false`.
    Fixed(bool),
    /// `"$name"`, without the `$`.
    Param(String),
}

/// Reads a graph file, and reports every mistake that can be seen without knowing any pass.
///
/// Gives `None` only where the text is too broken to say anything more about it.
pub fn read(source: &Arc<Source>, out: &mut Diagnostics) -> Option<GraphFile> {
    let mut found = Diagnostics::default();
    let file = parse(source, &mut found).and_then(|root| graph(source, &root, &mut found));
    let broken = found.has_errors();
    out.extend(found);
    file.map(|file| GraphFile { broken, ..file })
}

fn graph(source: &Arc<Source>, root: &Node, out: &mut Diagnostics) -> Option<GraphFile> {
    let mut decoder = Decoder { source, out };
    let fields = decoder.fields(root, "a graph", GRAPH_FIELDS)?;
    version(&mut decoder, &fields);
    Some(GraphFile {
        source: source.clone(),
        about: fields.get("about").and_then(|node| decoder.text(node)).unwrap_or_default().to_owned(),
        scene: fields.get("scene").and_then(|node| spanned_text(&mut decoder, node)),
        size: fields.get("size").and_then(|node| size(&mut decoder, node)),
        params: fields.get("params").map(|node| graph_params(&mut decoder, node)).unwrap_or_default(),
        passes: fields.required(&mut decoder, "passes").map(|node| passes(&mut decoder, node)).unwrap_or_default(),
        outputs: fields.required(&mut decoder, "outputs").map(|node| outputs(&mut decoder, node)).unwrap_or_default(),
        outputs_span: fields.get("outputs").map_or(root.span, |node| node.span),
        broken: false,
    })
}

fn version(decoder: &mut Decoder<'_>, fields: &Fields<'_>) {
    let Some(node) = fields.required(decoder, "version") else { return };
    let Some(version) = decoder.integer(node) else { return };
    let (code, message, suggestion) = if version > VERSION {
        let message = format!("this file has version {version}, and this program reads up to {VERSION}");
        (codes::NEWER_VERSION, message, "use a newer program")
    } else if version < VERSION {
        (codes::BAD_VERSION, format!("there is no version {version}"), "write version: 1")
    } else {
        return;
    };
    let place = decoder.place(node.span);
    decoder.report(Diagnostic::error(code, place, message).suggest(suggestion));
}

fn size(decoder: &mut Decoder<'_>, node: &Node) -> Option<Spanned<(u32, u32)>> {
    let Value::Tuple(parts) = &node.value else { return wrong_size(decoder, node) };
    let [width, height] = parts.as_slice() else { return wrong_size(decoder, node) };
    let (width, height) = (extent(decoder, width), extent(decoder, height));
    Some(Spanned { value: (width?, height?), span: node.span })
}

fn wrong_size(decoder: &mut Decoder<'_>, node: &Node) -> Option<Spanned<(u32, u32)>> {
    let message = "a size is two whole numbers, (width, height)";
    let place = decoder.place(node.span);
    decoder.report(Diagnostic::error(codes::BAD_SIZE, place, message).suggest("write size: (640, 480)"));
    None
}

fn extent(decoder: &mut Decoder<'_>, node: &Node) -> Option<u32> {
    let value = decoder.integer(node)?;
    match u32::try_from(value) {
        Ok(extent) if extent > 0 => Some(extent),
        _ => {
            let place = decoder.place(node.span);
            let message = format!("a size of {value} pixels is none");
            decoder.report(Diagnostic::error(codes::BAD_SIZE, place, message).suggest("give a number of 1 or more"));
            None
        }
    }
}

fn graph_params(decoder: &mut Decoder<'_>, node: &Node) -> Vec<ParamEntry> {
    let entries = params(decoder, node);
    for entry in &entries {
        check_name(decoder, &entry.name.value, entry.name.span);
    }
    entries
}

fn params(decoder: &mut Decoder<'_>, node: &Node) -> Vec<ParamEntry> {
    let entry = |(name, span, value): (&str, Span, &Node)| ParamEntry {
        name: Spanned { value: name.to_owned(), span },
        value: value.clone(),
    };
    decoder.map(node).unwrap_or_default().into_iter().map(entry).collect()
}

fn passes(decoder: &mut Decoder<'_>, node: &Node) -> Vec<PassEntry> {
    let entries = decoder.map(node).unwrap_or_default();
    entries.into_iter().map(|(name, span, node)| pass(decoder, name, span, node)).collect()
}

fn pass(decoder: &mut Decoder<'_>, name: &str, span: Span, node: &Node) -> PassEntry {
    let name = named(decoder, name, span);
    let mut entry = PassEntry { name, kind: None, inputs: Vec::new(), params: Vec::new(), enabled: None };
    let Some(fields) = decoder.fields(node, "a pass", PASS_FIELDS) else { return entry };
    entry.kind = fields.required(decoder, "use").and_then(|node| spanned_text(decoder, node));
    if let Some(node) = fields.get("inputs") {
        entry.inputs = references(decoder, node).into_iter().map(|(name, from)| InputEntry { name, from }).collect();
    }
    if let Some(node) = fields.get("params") {
        entry.params = params(decoder, node);
    }
    entry.enabled = fields.get("enabled").and_then(|node| switch(decoder, node));
    entry
}

fn outputs(decoder: &mut Decoder<'_>, node: &Node) -> Vec<OutputEntry> {
    let mut outputs = Vec::new();
    for (name, from) in references(decoder, node) {
        let name = named(decoder, &name.value, name.span);
        outputs.extend(from.map(|from| OutputEntry { name, from }));
    }
    outputs
}

/// A map from names to `pass.port`.
fn references(decoder: &mut Decoder<'_>, node: &Node) -> Vec<(Spanned<String>, Option<Spanned<String>>)> {
    let entries = decoder.map(node).unwrap_or_default();
    let entry = |(name, span, value): (&str, Span, &Node)| {
        let from = spanned_text(decoder, value);
        (Spanned { value: name.to_owned(), span }, from)
    };
    entries.into_iter().map(entry).collect()
}

fn switch(decoder: &mut Decoder<'_>, node: &Node) -> Option<Spanned<Switch>> {
    let value = match &node.value {
        Value::Text(text) if text.starts_with('$') => Switch::Param(text[1..].to_owned()),
        _ => Switch::Fixed(decoder.bool(node)?),
    };
    Some(Spanned { value, span: node.span })
}

fn spanned_text(decoder: &mut Decoder<'_>, node: &Node) -> Option<Spanned<String>> {
    let value = decoder.text(node)?.to_owned();
    Some(Spanned { value, span: node.span })
}

/// A name that the file gives to something of its own.
fn named(decoder: &mut Decoder<'_>, name: &str, span: Span) -> Spanned<String> {
    check_name(decoder, name, span);
    Spanned { value: name.to_owned(), span }
}

fn check_name(decoder: &mut Decoder<'_>, name: &str, span: Span) {
    if !is_name(name) {
        let place = decoder.place(span);
        let message = format!("`{name}` is not a name");
        let rule = "a name is lower-case letters, digits and `_`, and begins with a letter";
        decoder.report(Diagnostic::error(codes::BAD_NAME, place, message).suggest(rule));
    }
}

/// Whether a text matches `[a-z][a-z0-9_]*`.
pub(crate) fn is_name(text: &str) -> bool {
    let mut bytes = text.bytes();
    bytes.next().is_some_and(|first| first.is_ascii_lowercase())
        && bytes.all(|byte| byte.is_ascii_lowercase() || byte.is_ascii_digit() || byte == b'_')
}
