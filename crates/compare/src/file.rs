//! `NAME.compare.ron`: which scenes are drawn by which methods, and what of them is compared.
//!
//! ```ron
//! (
//!     version: 1,
//!     about: "What the page says it is for.",
//!     output: "airlight",            // an output of every graph; its truth is known to the program
//!     shadows: true,                 // false without it: whether what casts shadows hides lights from the truth
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

use tyndall_document::{Decoder, Diagnostic, Diagnostics, Fields, Node, Source, Span, Value, parse};
use tyndall_graph::codes::{BAD_SIZE, BAD_VERSION, NEWER_VERSION};

use crate::codes::{NO_TRUTH, NOTHING_TO_COMPARE};
use crate::truth::Light;

/// The version of the format that this program reads.
const VERSION: i64 = 1;

/// Where the file gives no size.
const SIZE: (u32, u32) = (320, 240);

/// A comparison as it stands in its file.
#[derive(Debug, Clone)]
pub struct CompareFile {
    pub(crate) source: Arc<Source>,
    /// What it is for.
    pub(crate) about: String,
    /// What is compared.
    pub(crate) light: Light,
    /// Where it says so.
    pub(crate) output_span: Span,
    /// Whether what casts shadows hides lights from the truth.
    pub(crate) shadows: bool,
    /// Of every picture, in pixels.
    pub size: (u32, u32),
    /// In the order of the file.
    pub scenes: Vec<Entry>,
    /// In the order of the file.
    pub methods: Vec<Entry>,
}

/// A scene or a method.
#[derive(Debug, Clone)]
pub struct Entry {
    /// What tables and the page call it.
    pub name: String,
    pub(crate) name_span: Span,
    /// A sentence; empty where the file does not say.
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
    /// Of the value.
    pub span: Span,
}

/// Reads a comparison file; every mistake that can be seen without the files that it names goes to `out`.
pub fn read(source: &Arc<Source>, out: &mut Diagnostics) -> Option<CompareFile> {
    let root = parse(source, out)?;
    let decoder = &mut Decoder::new(source, out);
    let known = ["version", "about", "output", "shadows", "size", "scenes", "methods"];
    let fields = decoder.fields(&root, "a comparison", &known)?;
    if let Some(node) = fields.required(decoder, "version") {
        version(decoder, node);
    }
    let about = text(decoder, &fields, "about");
    let output = fields.required(decoder, "output");
    let light = output.and_then(|node| light(decoder, node));
    let shadows = fields.get("shadows").is_some_and(|node| shadows(decoder, node, light));
    let size = fields.get("size").map_or(Some(SIZE), |node| size(decoder, node));
    let scenes = entries(decoder, &fields, ("scenes", "a scene"), "scene");
    let methods = entries(decoder, &fields, ("methods", "a method"), "graph");
    let output_span = output.map_or(root.span, |node| node.span);
    let (light, size) = (light?, size?);
    Some(CompareFile { source: source.clone(), about, light, output_span, shadows, size, scenes, methods })
}

fn version(decoder: &mut Decoder<'_>, node: &Node) {
    let Some(version) = decoder.integer(node) else { return };
    let (code, message, suggestion) = if version > VERSION {
        let message = format!("this file has version {version}, and this program reads up to {VERSION}");
        (NEWER_VERSION, message, "use a newer program")
    } else if version < VERSION {
        (BAD_VERSION, format!("there is no version {version}"), "write version: 1")
    } else {
        return;
    };
    let place = decoder.place(node.span);
    decoder.report(Diagnostic::error(code, place, message).suggest(suggestion));
}

fn light(decoder: &mut Decoder<'_>, node: &Node) -> Option<Light> {
    let name = decoder.text(node)?;
    let light = Light::ALL.into_iter().find(|light| light.output() == name);
    if light.is_none() {
        let known: Vec<String> = Light::ALL.iter().map(|light| format!("`{}`", light.output())).collect();
        let message = format!("there is no truth for the output `{name}` to be compared with");
        let place = decoder.place(node.span);
        decoder.report(
            Diagnostic::error(NO_TRUTH, place, message).suggest(format!("truth is known for {}", known.join(", "))),
        );
    }
    light
}

/// Of surfaces there is no truth with shadows: the scattered part of their light has none by any method.
fn shadows(decoder: &mut Decoder<'_>, node: &Node, light: Option<Light>) -> bool {
    let wanted = decoder.bool(node).unwrap_or_default();
    if wanted && light == Some(Light::Surface) {
        let place = decoder.place(node.span);
        let message = "there is no truth for shadows on surfaces to be compared with";
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
        let message = "a size is two whole numbers of 1 or more, (width, height)";
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
