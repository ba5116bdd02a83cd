//! From the text of a test file to what it says.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use tyndall_document::{BAD_SIZE, Decoder, Diagnostic, Diagnostics, MISSING_FILE, Node, Source, Value, parse};
use tyndall_render::{Request, Setting};

use super::expect::{metric, properties, relations};
use super::reason::{demand_reason, reason, said};
use super::{Golden, Reference, Tap, TestFile};
use crate::adapter::AdapterClass;
use crate::codes;
use crate::metric::Metric;
use crate::picture::MOST_SIDE;

const VERSION: i64 = 1;
const DEFAULT_SIZE: (u32, u32) = (64, 48);
/// The last frame that a test may look at: what remembers frames is rendered from the first on.
const MOST_FRAME: u32 = 9999;

const FIELDS: &[&str] = &["version", "about", "graph", "scene", "size", "set", "frames", "taps", "relations"];
const TAP_FIELDS: &[&str] = &["golden", "adapters", "reason", "reference", "properties"];

/// Reads a test file; every mistake that can be seen without its graph goes to `out`.
pub fn read(path: &Path, out: &mut Diagnostics) -> Option<TestFile> {
    let source = match Source::read(path) {
        Ok(source) => source,
        Err(mistake) => {
            out.push(mistake);
            return None;
        }
    };
    let mut found = Diagnostics::default();
    let file = parse(&source, &mut found).and_then(|root| test(&source, path, &root, &mut found));
    let broken = found.has_errors();
    out.extend(found);
    file.filter(|_| !broken)
}

fn test(source: &Arc<Source>, path: &Path, root: &Node, out: &mut Diagnostics) -> Option<TestFile> {
    let mut decoder = Decoder { source, out };
    let fields = decoder.fields(root, "a test", FIELDS)?;
    if let Some(node) = fields.required(&mut decoder, "version") {
        decoder.version(node, VERSION);
    }
    let folder = path.parent().unwrap_or(Path::new(""));
    let graph = fields.required(&mut decoder, "graph").and_then(|node| file(&mut decoder, folder, node));
    let scene = fields.get("scene").and_then(|node| file(&mut decoder, folder, node));
    let size = fields.get("size").map_or(Some(DEFAULT_SIZE), |node| size(&mut decoder, node));
    let set = fields.get("set").map(|node| settings(&mut decoder, node)).unwrap_or_default();
    let frames = fields.get("frames").map_or(Some(vec![0]), |node| frames(&mut decoder, node));
    let taps = match fields.required(&mut decoder, "taps") {
        Some(node) => taps(&mut decoder, folder, node),
        None => Vec::new(),
    };
    let relations = fields.get("relations").map(|node| relations(&mut decoder, node)).unwrap_or_default();
    let about = fields.get("about").and_then(|node| decoder.text(node)).unwrap_or_default().to_owned();
    let (size, frames) = (size?, frames?);
    if let Some(node) = fields.get("size")
        && size.0.max(size.1) > MOST_SIDE
        && taps.iter().any(|tap| tap.golden.is_some())
    {
        let place = decoder.place(node.span);
        let message = format!("a golden of {}x{} pixels is too large for a repository", size.0, size.1);
        let most = format!("{MOST_SIDE} pixels along each side at most");
        decoder.report(Diagnostic::error(BAD_SIZE, place, message).suggest(most));
    }
    let request = Request { graph: graph?, scene, size: Some(size), set };
    Some(TestFile { source: source.clone(), path: path.to_owned(), about, request, frames, taps, relations })
}

/// A file that the test names; one that is not there is told where it is named.
fn file(decoder: &mut Decoder<'_>, folder: &Path, node: &Node) -> Option<PathBuf> {
    let path = folder.join(decoder.text(node)?);
    if path.exists() {
        return Some(path);
    }
    let place = decoder.place(node.span);
    let message = format!("there is no file `{}`", path.display());
    decoder.report(Diagnostic::error(MISSING_FILE, place, message).suggest("paths are relative to this file"));
    None
}

fn size(decoder: &mut Decoder<'_>, node: &Node) -> Option<(u32, u32)> {
    let pair = match &node.value {
        Value::Tuple(parts) => match parts.as_slice() {
            [width, height] => Some((decoder.integer(width)?, decoder.integer(height)?)),
            _ => None,
        },
        _ => None,
    };
    let extent = |value: i64| u32::try_from(value).ok().filter(|extent| (1..=16384).contains(extent));
    let size = pair.and_then(|(width, height)| Some((extent(width)?, extent(height)?)));
    if size.is_none() {
        let place = decoder.place(node.span);
        let message = "a size is two whole numbers above 0, (width, height)";
        decoder.report(Diagnostic::error(BAD_SIZE, place, message).suggest("write size: (64, 48)"));
    }
    size
}

fn frames(decoder: &mut Decoder<'_>, node: &Node) -> Option<Vec<u32>> {
    let items = decoder.list(node)?;
    let numbers: Option<Vec<u32>> =
        items.iter().map(|item| decoder.integer(item).and_then(|number| u32::try_from(number).ok())).collect();
    let in_order = |frames: &Vec<u32>| {
        !frames.is_empty() && frames.windows(2).all(|pair| pair[0] < pair[1]) && frames.last() <= Some(&MOST_FRAME)
    };
    let frames = numbers.filter(in_order);
    if frames.is_none() {
        let place = decoder.place(node.span);
        let message =
            format!("frames are a list of whole numbers, each larger than the one before, up to {MOST_FRAME}");
        decoder.report(Diagnostic::error(codes::BAD_FRAMES, place, message).suggest("write frames: [0, 12]"));
    }
    frames
}

/// `{ "name": value }` as what a command line would set; the values keep their text.
pub(super) fn settings(decoder: &mut Decoder<'_>, node: &Node) -> Vec<Setting> {
    let source = decoder.source.clone();
    let entries = decoder.map(node).unwrap_or_default();
    let setting = |(name, span, value): (&str, tyndall_document::Span, &Node)| {
        let (line, column) = source.line_column(span.start);
        let value = source.slice(value.span);
        Setting {
            text: format!("{name}={value}"),
            argument: format!("{}:{line}:{column}: {name}: {value}", source.name()),
        }
    };
    entries.into_iter().map(setting).collect()
}

fn taps(decoder: &mut Decoder<'_>, folder: &Path, node: &Node) -> Vec<Tap> {
    let entries = decoder.map(node).unwrap_or_default();
    if entries.is_empty() {
        let place = decoder.place(node.span);
        let problem = Diagnostic::error(codes::NO_TAPS, place, "the test looks at no port");
        decoder.report(problem.suggest("write taps: { \"*\": (golden: RelativeRmse(1e-4)) }"));
    }
    entries.into_iter().filter_map(|(pattern, span, node)| tap(decoder, folder, pattern, span, node)).collect()
}

fn tap(
    decoder: &mut Decoder<'_>,
    folder: &Path,
    pattern: &str,
    span: tyndall_document::Span,
    node: &Node,
) -> Option<Tap> {
    if !is_pattern(pattern) {
        let place = decoder.place(span);
        let message = format!("`{pattern}` is not a pattern of ports");
        let problem = Diagnostic::error(codes::BAD_PATTERN, place, message);
        decoder.report(problem.suggest("write `pass.port`, `pass.*`, `*.port` or `*`"));
    }
    let fields = decoder.fields(node, "a tap", TAP_FIELDS)?;
    let reason = reason(decoder, &fields);
    let adapters = fields.get("adapters").map(|node| adapters(decoder, node)).unwrap_or_default();
    let golden = fields.get("golden").and_then(|node| {
        let metric = metric(decoder, node)?;
        demand_reason(decoder, node, metric.is_strict(), reason);
        Some(Golden { metric, adapters, span: node.span })
    });
    if let Some(node) = fields.get("adapters").filter(|_| fields.get("golden").is_none()) {
        let message = "`adapters` says how far a port may be from its golden, and this tap has none";
        let problem = Diagnostic::error(codes::WRONG_CHECK, decoder.place(node.span), message);
        decoder.report(problem.suggest("give the tap a `golden`, or move `adapters` to the tap that has one"));
    }
    let reference = fields.get("reference").and_then(|node| reference(decoder, folder, node, reason));
    let asked = fields.get("properties");
    let properties = asked.map(|node| properties(decoder, node, reason)).unwrap_or_default();
    let asks_nothing = asked.is_none_or(|node| matches!(&node.value, Value::List(items) if items.is_empty()));
    if asks_nothing && ["golden", "reference"].iter().all(|name| fields.get(name).is_none()) {
        let place = decoder.place(node.span);
        let problem = Diagnostic::error(codes::EMPTY_TAP, place, format!("`{pattern}` says nothing about its ports"));
        decoder.report(problem.suggest("give it a `golden`, a `reference` or `properties`"));
    }
    Some(Tap { pattern: pattern.to_owned(), span, golden, reference, properties })
}

fn is_pattern(text: &str) -> bool {
    let known = |byte: u8| byte.is_ascii_lowercase() || byte.is_ascii_digit() || b"_*".contains(&byte);
    let part = |part: &str| !part.is_empty() && part.bytes().all(known);
    match text.split_once('.') {
        Some((pass, port)) => part(pass) && part(port),
        None => text == "*",
    }
}

fn adapters(decoder: &mut Decoder<'_>, node: &Node) -> Vec<(AdapterClass, Metric)> {
    let entries = decoder.map(node).unwrap_or_default();
    let mut found = Vec::new();
    for (name, span, node) in entries {
        let Some(class) = AdapterClass::named(name) else {
            let place = decoder.place(span);
            let message = format!("unknown class of adapters `{name}`");
            let names = AdapterClass::ALL.map(AdapterClass::name).join(", ");
            decoder.report(Diagnostic::error(codes::UNKNOWN_ADAPTER_CLASS, place, message).suggest(names));
            continue;
        };
        let Some(fields) = decoder.fields(node, "a tolerance of a class of adapters", &["golden", "reason"]) else {
            continue;
        };
        let golden = fields.required(decoder, "golden").and_then(|node| metric(decoder, node));
        if let (Some(metric), Some(_)) =
            (golden, fields.required(decoder, "reason").and_then(|node| said(decoder, node, "reason")))
        {
            found.push((class, metric));
        }
    }
    found
}

fn reference(decoder: &mut Decoder<'_>, folder: &Path, node: &Node, reason: bool) -> Option<Reference> {
    let fields = decoder.fields(node, "a reference", &["file", "by", "provenance"])?;
    let path = fields.required(decoder, "file").and_then(|node| file(decoder, folder, node));
    let by = fields.required(decoder, "by").and_then(|node| {
        let metric = metric(decoder, node)?;
        demand_reason(decoder, node, metric.is_strict(), reason);
        Some((metric, node.span))
    });
    let provenance = fields.required(decoder, "provenance").and_then(|node| said(decoder, node, "provenance"));
    let (metric, span) = by?;
    Some(Reference { file: path?, metric, provenance: provenance?.to_owned(), span })
}
