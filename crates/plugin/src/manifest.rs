//! `plugin.ron`: what a plugin says of itself and of its passes, beyond what its WGSL says.

use std::fmt;
use std::sync::Arc;

use tyndall_document::{BAD_VERSION, Decoder, Diagnostic, Diagnostics, Fields, Node, Source, Span, Value, parse};
use tyndall_scene::{Extensions, Feature};

use crate::codes::BAD_PLUGIN_NAME;
use crate::dispatch::Over;
use crate::keys;
use crate::limits::{self, Limit};
use crate::ports::arguments;

/// A semantic version.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub struct Version {
    /// Raised when graphs that use the plugin must be changed.
    pub major: u32,
    /// Raised when something is added.
    pub minor: u32,
    /// Raised when something is mended.
    pub patch: u32,
}

impl Version {
    fn parse(text: &str) -> Option<Self> {
        let mut parts = text.split('.').map(|part| part.parse::<u32>().ok());
        let version = Self { major: parts.next()??, minor: parts.next()??, patch: parts.next()?? };
        parts.next().is_none().then_some(version)
    }
}

impl fmt::Display for Version {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}.{}.{}", self.major, self.minor, self.patch)
    }
}

/// A manifest as it is written; ports and parameters are still nodes, because the shader decides how they are read.
pub(crate) struct Manifest {
    pub source: Arc<Source>,
    pub name: String,
    pub version: Version,
    pub about: String,
    pub passes: Vec<ManifestPass>,
}

/// A pass of a manifest.
pub(crate) struct ManifestPass {
    pub name: String,
    pub name_span: Span,
    pub about: String,
    pub origin: String,
    pub shader: String,
    pub shader_span: Span,
    pub over: Option<(Over, Span)>,
    pub limits: Vec<Limit>,
    pub refuses: Vec<Limit>,
    pub ports: Vec<Entry>,
    pub params: Vec<Entry>,
    pub presets: Vec<Entry>,
}

/// A named entry of a map.
pub(crate) struct Entry {
    pub name: String,
    pub name_span: Span,
    pub value: Node,
}

/// Reads a manifest, and the plugin's name also where the rest cannot be read; every mistake goes to `out`.
pub(crate) fn read(
    source: &Arc<Source>,
    extensions: &Extensions,
    out: &mut Diagnostics,
) -> (Option<String>, Option<Manifest>) {
    let root = parse(source, out);
    let mut decoder = Decoder::new(source, out);
    let fields = root.as_ref().and_then(|root| decoder.fields(root, "a plugin", keys::PLUGIN));
    let Some(fields) = fields else { return (None, None) };
    let name = fields.required(&mut decoder, "name").and_then(|node| name(&mut decoder, node));
    let features = extensions.features(name.as_deref().unwrap_or_default());
    (name.clone(), manifest(&mut decoder, &fields, name, &features))
}

fn manifest(
    decoder: &mut Decoder<'_>,
    fields: &Fields<'_>,
    name: Option<String>,
    features: &[Feature],
) -> Option<Manifest> {
    let version = fields.required(decoder, "version").and_then(|node| version(decoder, node));
    let about = fields.required(decoder, "about").and_then(|node| decoder.text(node)).map(str::to_owned);
    let entries = entries(decoder, fields.get("passes"));
    let passes = entries.into_iter().filter_map(|entry| pass(decoder, entry, features)).collect();
    Some(Manifest { source: decoder.source.clone(), name: name?, version: version?, about: about?, passes })
}

fn name(decoder: &mut Decoder<'_>, node: &Node) -> Option<String> {
    let text = decoder.text(node)?;
    decoder.check_name(text, node.span, BAD_PLUGIN_NAME).then(|| text.to_owned())
}

fn version(decoder: &mut Decoder<'_>, node: &Node) -> Option<Version> {
    let text = decoder.text(node)?;
    let version = Version::parse(text);
    if version.is_none() {
        let place = decoder.place(node.span);
        let problem = Diagnostic::error(BAD_VERSION, place, format!("{text:?} is not a version"));
        decoder.report(problem.suggest("write MAJOR.MINOR.PATCH: \"0.1.0\""));
    }
    version
}

fn pass(decoder: &mut Decoder<'_>, entry: Entry, features: &[Feature]) -> Option<ManifestPass> {
    let fields = decoder.fields(&entry.value, "a pass", keys::PASS)?;
    let text = |decoder: &mut Decoder<'_>, name: &str| {
        fields.get(name).and_then(|node| decoder.text(node)).unwrap_or_default().to_owned()
    };
    let valid = decoder.check_name(&entry.name, entry.name_span, BAD_PLUGIN_NAME);
    let about = fields.required(decoder, "about").and_then(|node| decoder.text(node)).map(str::to_owned);
    let shader = fields.required(decoder, "shader");
    let shader_span = shader.map_or(entry.value.span, |node| node.span);
    let shader = shader.and_then(|node| decoder.text(node)).map(str::to_owned);
    let over = fields.get("dispatch").and_then(|node| Some((over(decoder, node)?, node.span)));
    let origin = text(decoder, "source");
    let mut limits = |name| fields.get(name).map(|node| limits::limits(decoder, node, features)).unwrap_or_default();
    let (limits, refuses) = (limits("limits"), limits("refuses"));
    let ports = entries(decoder, fields.get("ports"));
    let params = entries(decoder, fields.get("params"));
    let presets = entries(decoder, fields.get("presets"));
    let (about, shader) = (about?, shader?);
    let pass = ManifestPass {
        name: entry.name,
        name_span: entry.name_span,
        about,
        origin,
        shader,
        shader_span,
        over,
        limits,
        refuses,
        ports,
        params,
        presets,
    };
    valid.then_some(pass)
}

/// The name of a port, or a number of threads in x, and in y and z.
fn over(decoder: &mut Decoder<'_>, node: &Node) -> Option<Over> {
    if let Value::Text(port) = &node.value {
        return Some(Over::Port(port.clone()));
    }
    let count = |node: &Node| match node.value {
        Value::Number(number) => number.integer.and_then(|count| u32::try_from(count).ok()).filter(|count| *count > 0),
        _ => None,
    };
    let counts: Option<Vec<u32>> = arguments(node).into_iter().map(count).collect();
    match counts.as_deref() {
        Some(&[x]) => Some(Over::Threads([x, 1, 1])),
        Some(&[x, y]) => Some(Over::Threads([x, y, 1])),
        Some(&[x, y, z]) => Some(Over::Threads([x, y, z])),
        _ => {
            decoder.wrong_type(node, "the name of a port, or numbers of threads: (x, y, z)");
            None
        }
    }
}

fn entries(decoder: &mut Decoder<'_>, node: Option<&Node>) -> Vec<Entry> {
    let entries = node.and_then(|node| decoder.map(node)).unwrap_or_default();
    let entry = |(name, name_span, value): (&str, Span, &Node)| Entry {
        name: name.to_owned(),
        name_span,
        value: value.clone(),
    };
    entries.into_iter().map(entry).collect()
}
