//! From a text to its tree, and from the tree to a file.

use std::sync::Arc;

use tyndall_document::{BAD_NAME, BAD_SIZE, Decoder, Diagnostic, Diagnostics, Field, Node, Source, Span, Value, parse};

use super::{GraphFile, InputEntry, OutputEntry, ParamEntry, PassEntry, Spanned, Switch, Text};
use crate::graph::Pass;
use crate::handle::Table;

/// The version of the file format that this crate reads.
pub(crate) const VERSION: i64 = 1;

const GRAPH_FIELDS: &[&str] = &["version", "about", "scene", "size", "params", "passes", "outputs"];
const PASS_FIELDS: &[&str] = &["use", "inputs", "params", "enabled"];

/// Reads a graph file, and reports every mistake that can be found without knowing any pass.
///
/// Returns `None` only if the text is too broken to say more about it.
pub fn read(source: &Arc<Source>, out: &mut Diagnostics) -> Option<GraphFile> {
    let mut found = Diagnostics::default();
    let file = parse(source, &mut found).and_then(|root| graph(source, root, &mut found));
    let broken = found.has_errors();
    out.extend(found);
    file.map(|file| GraphFile { broken, ..file })
}

/// Takes the tree apart: texts move into the file, because they are most of it.
fn graph(source: &Arc<Source>, mut root: Node, out: &mut Diagnostics) -> Option<GraphFile> {
    let mut decoder = Decoder { source, out };
    let whole = root.span;
    let fields = open(&mut decoder, &mut root, "a graph", GRAPH_FIELDS, &["version", "passes", "outputs"])?;
    if let Some(node) = field(fields, "version") {
        decoder.version(node, VERSION);
    }
    Some(GraphFile {
        source: source.clone(),
        about: field(fields, "about").and_then(|node| owned_text(&mut decoder, node)).unwrap_or_default(),
        scene: field(fields, "scene").and_then(|node| scene(&mut decoder, node)),
        size: field(fields, "size").and_then(|node| size(&mut decoder, node)),
        params: field(fields, "params").map(|node| graph_params(&mut decoder, node)).unwrap_or_default(),
        passes: field(fields, "passes").map(|node| passes(&mut decoder, node)).unwrap_or_default(),
        outputs_span: field(fields, "outputs").map_or(whole, |node| node.span),
        outputs: field(fields, "outputs").map(|node| outputs(&mut decoder, node)).unwrap_or_default(),
        broken: false,
    })
}

/// The fields of a struct; unknown and missing ones are reported.
fn open<'n>(
    decoder: &mut Decoder<'_>,
    node: &'n mut Node,
    what: &str,
    known: &[&str],
    required: &[&str],
) -> Option<&'n mut [Field]> {
    let fields = decoder.fields(node, what, known)?;
    for name in required {
        fields.required(decoder, name);
    }
    match &mut node.value {
        Value::Struct(fields) => Some(fields),
        _ => Some(&mut []),
    }
}

fn field<'n>(fields: &'n mut [Field], name: &str) -> Option<&'n mut Node> {
    fields.iter_mut().find(|field| field.name == name).map(|field| &mut field.value)
}

fn scene(decoder: &mut Decoder<'_>, node: &mut Node) -> Option<Spanned<String>> {
    let value = owned_text(decoder, node)?;
    Some(Spanned { value, span: node.span })
}

fn size(decoder: &mut Decoder<'_>, node: &Node) -> Option<Spanned<(u32, u32)>> {
    let Value::Tuple(parts) = &node.value else { return wrong_size(decoder, node) };
    let [width, height] = parts.as_slice() else { return wrong_size(decoder, node) };
    let (width, height) = (extent(decoder, width), extent(decoder, height));
    Some(Spanned { value: (width?, height?), span: node.span })
}

fn wrong_size(decoder: &mut Decoder<'_>, node: &Node) -> Option<Spanned<(u32, u32)>> {
    let message = "expected a size: two whole numbers, (width, height)";
    let place = decoder.place(node.span);
    decoder.report(Diagnostic::error(BAD_SIZE, place, message).suggest("write size: (640, 480)"));
    None
}

fn extent(decoder: &mut Decoder<'_>, node: &Node) -> Option<u32> {
    let value = decoder.integer(node)?;
    match u32::try_from(value) {
        Ok(extent) if extent > 0 => Some(extent),
        _ => {
            let place = decoder.place(node.span);
            let bound = if value < 1 { "at least 1".to_owned() } else { format!("at most {}", u32::MAX) };
            let message = format!("a size must be {bound}, got {value}");
            decoder.report(Diagnostic::error(BAD_SIZE, place, message));
            None
        }
    }
}

fn graph_params(decoder: &mut Decoder<'_>, node: &mut Node) -> Vec<ParamEntry> {
    params(decoder, node, check_name)
}

/// Parameters, whose names `check` checks.
fn params(decoder: &mut Decoder<'_>, node: &mut Node, check: fn(&mut Decoder<'_>, &str, Span)) -> Vec<ParamEntry> {
    let mut params = Vec::new();
    for (mut key, value) in entries(decoder, node) {
        params.extend(named(decoder, &mut key, check).map(|name| ParamEntry { name, value }));
    }
    params
}

fn passes(decoder: &mut Decoder<'_>, node: &mut Node) -> Table<Pass, PassEntry> {
    let entries = entries(decoder, node);
    let mut passes = Table::with_capacity(entries.len());
    for (mut key, mut value) in entries {
        passes.extend(named(decoder, &mut key, check_name).map(|name| pass(decoder, name, &mut value)));
    }
    passes
}

fn pass(decoder: &mut Decoder<'_>, name: Text, node: &mut Node) -> PassEntry {
    let mut entry = PassEntry { name, kind: None, inputs: Vec::new(), params: Vec::new(), enabled: None };
    let Some(fields) = open(decoder, node, "a pass", PASS_FIELDS, &["use"]) else { return entry };
    entry.kind = field(fields, "use").and_then(|node| text(decoder, node));
    if let Some(node) = field(fields, "inputs") {
        entry.inputs = inputs(decoder, node);
    }
    if let Some(node) = field(fields, "params") {
        entry.params = params(decoder, node, any_name);
    }
    entry.enabled = field(fields, "enabled").and_then(|node| switch(decoder, node));
    entry
}

fn inputs(decoder: &mut Decoder<'_>, node: &mut Node) -> Vec<InputEntry> {
    let entries = entries(decoder, node);
    let mut inputs = Vec::with_capacity(entries.len());
    for (mut key, mut value) in entries {
        let Some(name) = text(decoder, &mut key) else { continue };
        inputs.push(InputEntry { name, from: text(decoder, &mut value) });
    }
    inputs
}

fn outputs(decoder: &mut Decoder<'_>, node: &mut Node) -> Vec<OutputEntry> {
    let mut outputs = Vec::new();
    for (mut key, mut value) in entries(decoder, node) {
        let Some(name) = named(decoder, &mut key, check_name) else { continue };
        outputs.extend(text(decoder, &mut value).map(|from| OutputEntry { name, from }));
    }
    outputs
}

/// Takes the entries out of a map.
fn entries(decoder: &mut Decoder<'_>, node: &mut Node) -> Vec<(Node, Node)> {
    if let Value::Map(entries) = &mut node.value {
        return std::mem::take(entries);
    }
    // Reports the wrong type.
    decoder.map(node);
    Vec::new()
}

/// A text.
fn text(decoder: &mut Decoder<'_>, node: &mut Node) -> Option<Text> {
    named(decoder, node, any_name)
}

/// A text that is a name, which `check` checks.
fn named(decoder: &mut Decoder<'_>, node: &mut Node, check: fn(&mut Decoder<'_>, &str, Span)) -> Option<Text> {
    let text = owned_text(decoder, node)?;
    check(decoder, &text, node.span);
    Some(Text::new(decoder.source, node.span, text))
}

/// Takes a text out of its node.
fn owned_text(decoder: &mut Decoder<'_>, node: &mut Node) -> Option<String> {
    if let Value::Text(text) = &mut node.value {
        return Some(std::mem::take(text));
    }
    // Reports the wrong type.
    decoder.text(node);
    None
}

/// The name of something new, which must be a valid one.
fn check_name(decoder: &mut Decoder<'_>, name: &str, span: Span) {
    decoder.check_name(name, span, BAD_NAME);
}

/// The name of something that is looked up elsewhere.
fn any_name(_: &mut Decoder<'_>, _: &str, _: Span) {}

fn switch(decoder: &mut Decoder<'_>, node: &Node) -> Option<Spanned<Switch>> {
    let value = match &node.value {
        Value::Text(text) if text.starts_with('$') => Switch::Param(text[1..].to_owned()),
        _ => Switch::Fixed(decoder.bool(node)?),
    };
    Some(Spanned { value, span: node.span })
}
