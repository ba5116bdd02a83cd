//! `NAME.compare.ron`: which scenes are drawn by which methods, and which output is compared.
//!
//! ```ron
//! (
//!     version: 1,
//!     about: "What the page says it is for.",
//!     output: "airlight",            // an output of every graph, of which the program computes the truth
//!     shadows: true,                 // whether the truth has shadows; false by default
//!     size: (320, 240),
//!     scenes: {
//!         "lamp": (scene: "scenes/lamp.scene.ron", about: "A lamp in view", set: { "scene.medium.albedo": (1, 1, 1) }),
//!     },
//!     methods: {
//!         "quadrature, 8 nodes": (graph: "airlight.graph.ron", set: { "air.nodes": 8 }),
//!     },
//! )
//! ```
//!
//! Paths are relative to the file. `set` takes what `--set` takes.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use tyndall_document::{BAD_SIZE, Decoder, Diagnostic, Diagnostics, Fields, Node, Source, Span, Value, parse};

use crate::codes::{NO_TRUTH, NOTHING_TO_COMPARE};
use crate::truth::Output;

/// The version of the format that this program reads.
const VERSION: i64 = 1;

/// The size, unless the file gives one.
const SIZE: (u32, u32) = (320, 240);

/// A comparison, as read from its file.
#[derive(Debug, Clone)]
pub struct CompareFile {
    pub(crate) source: Arc<Source>,
    /// What the comparison is for.
    pub(crate) about: String,
    /// The output that is compared.
    pub(crate) output: Output,
    /// The place of its name.
    pub(crate) output_span: Span,
    /// Whether the truth has shadows.
    pub(crate) shadows: bool,
    /// The size of every picture, in pixels.
    pub size: (u32, u32),
    /// In the order of the file.
    pub scenes: Vec<Entry>,
    /// In the order of the file.
    pub methods: Vec<Entry>,
}

/// A scene or a method.
#[derive(Debug, Clone)]
pub struct Entry {
    /// Its name in the tables and on the page.
    pub name: String,
    pub(crate) name_span: Span,
    /// A sentence; empty if the file has none.
    pub(crate) about: String,
    /// The scene or the graph, relative to the working directory (or absolute).
    pub path: PathBuf,
    pub(crate) settings: Vec<Setting>,
}

/// `"name": value` of a `set`.
#[derive(Debug, Clone)]
pub(crate) struct Setting {
    /// `name=value`, as `--set` takes it.
    pub text: String,
    /// The place of the value.
    pub span: Span,
}

/// Reads a comparison file; every mistake that does not concern the files that it names goes to `out`.
pub fn read(source: &Arc<Source>, out: &mut Diagnostics) -> Option<CompareFile> {
    let root = parse(source, out)?;
    let decoder = &mut Decoder::new(source, out);
    let known = ["version", "about", "output", "shadows", "size", "scenes", "methods"];
    let fields = decoder.fields(&root, "a comparison", &known)?;
    if let Some(node) = fields.required(decoder, "version") {
        decoder.version(node, VERSION);
    }
    let about = text(decoder, &fields, "about");
    let output_node = fields.required(decoder, "output");
    let output_span = output_node.map_or(root.span, |node| node.span);
    let output = output_node.and_then(|node| output(decoder, node));
    let shadows = fields.get("shadows").is_some_and(|node| shadows(decoder, node, output));
    let size = fields.get("size").map_or(Some(SIZE), |node| size(decoder, node));
    let scenes = entries(decoder, &fields, ("scenes", "a scene"), "scene");
    let methods = entries(decoder, &fields, ("methods", "a method"), "graph");
    let (output, size) = (output?, size?);
    Some(CompareFile { source: source.clone(), about, output, output_span, shadows, size, scenes, methods })
}

fn output(decoder: &mut Decoder<'_>, node: &Node) -> Option<Output> {
    let name = decoder.text(node)?;
    let output = Output::ALL.into_iter().find(|output| output.name() == name);
    if output.is_none() {
        let message = format!("no truth can be computed for the output `{name}`");
        let problem = Diagnostic::error(NO_TRUTH, decoder.place(node.span), message);
        decoder.report(problem.suggest_available(Output::ALL.map(Output::name)));
    }
    output
}

/// The truth of surfaces has no shadows, because no method has any in the light that is scattered onto them.
fn shadows(decoder: &mut Decoder<'_>, node: &Node, output: Option<Output>) -> bool {
    let wanted = decoder.bool(node).unwrap_or_default();
    if wanted && output == Some(Output::Surface) {
        let place = decoder.place(node.span);
        let message = "no truth can be computed for shadows on surfaces";
        decoder
            .report(Diagnostic::error(NO_TRUTH, place, message).suggest("compare `airlight`, or leave `shadows` out"));
    }
    wanted
}

fn size(decoder: &mut Decoder<'_>, node: &Node) -> Option<(u32, u32)> {
    let extent = |node: &Node| match node.value {
        Value::Number(number) => number.integer.and_then(|number| u32::try_from(number).ok()).filter(|n| *n > 0),
        _ => None,
    };
    let size = match &node.value {
        Value::Tuple(parts) => match parts.as_slice() {
            [width, height] => extent(width).zip(extent(height)),
            _ => None,
        },
        _ => None,
    };
    if size.is_none() {
        let place = decoder.place(node.span);
        let message = "expected a size: two whole numbers of at least 1, (width, height)";
        decoder.report(Diagnostic::error(BAD_SIZE, place, message).suggest("write size: (320, 240)"));
    }
    size
}

/// The scenes, or the methods; `file` is the field that names the file of one.
fn entries(decoder: &mut Decoder<'_>, fields: &Fields<'_>, (name, what): (&str, &str), file: &str) -> Vec<Entry> {
    let Some(node) = fields.required(decoder, name) else { return Vec::new() };
    let Some(found) = decoder.map(node) else { return Vec::new() };
    if found.is_empty() {
        let place = decoder.place(node.span);
        let message = format!("there are no {name} to compare");
        decoder.report(Diagnostic::error(NOTHING_TO_COMPARE, place, message).suggest(format!("add {what}")));
    }
    found
        .into_iter()
        .filter_map(|(name, name_span, node)| entry(decoder, (name, name_span), node, what, file))
        .collect()
}

fn entry(
    decoder: &mut Decoder<'_>,
    (name, name_span): (&str, Span),
    node: &Node,
    what: &str,
    file: &str,
) -> Option<Entry> {
    let fields = decoder.fields(node, what, &["about", file, "set"])?;
    let about = text(decoder, &fields, "about");
    let path = fields.required(decoder, file).and_then(|node| decoder.text(node).map(str::to_owned));
    let settings = fields.get("set").map(|node| settings(decoder, node)).unwrap_or_default();
    let folder = Path::new(decoder.source.name()).parent().unwrap_or(Path::new("")).to_owned();
    Some(Entry { name: name.to_owned(), name_span, about, path: folder.join(path?), settings })
}

fn settings(decoder: &mut Decoder<'_>, node: &Node) -> Vec<Setting> {
    let entries = decoder.map(node).unwrap_or_default();
    let setting = |(name, _, value): (&str, Span, &Node)| {
        let text = format!("{name}={}", decoder.source.slice(value.span));
        Setting { text, span: value.span }
    };
    entries.into_iter().map(setting).collect()
}

fn text(decoder: &mut Decoder<'_>, fields: &Fields<'_>, name: &str) -> String {
    fields.get(name).and_then(|node| decoder.text(node)).unwrap_or_default().to_owned()
}
