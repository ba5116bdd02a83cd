//! Every code has a fixture that pins its text and position, and mistakes come all at once, in order, each once.

#![allow(clippy::unwrap_used, reason = "a test")]

mod support;

use std::path::Path;
use std::sync::Arc;

use support::{catalogue, exists};
use tyndall_document::{
    BAD_NAME, BAD_SIZE, BAD_VERSION, Code, DUPLICATE_NAME, Diagnostics, MISSING_FIELD, MISSING_FILE, NEWER_VERSION,
    NOT_FINITE, OUT_OF_RANGE, Place, Source, UNKNOWN_FIELD, WRONG_TYPE, fixture,
};
use tyndall_graph::{CODES, Override, Overrides, PlanOptions, plan, read, validate_with};

/// Those of the document crate that graph files cause as well.
const ALSO: &[Code] = &[
    BAD_NAME,
    BAD_SIZE,
    BAD_VERSION,
    DUPLICATE_NAME,
    MISSING_FIELD,
    MISSING_FILE,
    NEWER_VERSION,
    NOT_FINITE,
    OUT_OF_RANGE,
    UNKNOWN_FIELD,
    WRONG_TYPE,
];

/// Every mistake of a file, with the command line that its first lines give: `// --set NAME=VALUE`, `// --size WxH`,
/// `// --output NAME`; and `// plan WxH` plans at another size than was checked.
fn mistakes(source: &Arc<Source>) -> Diagnostics {
    let mut out = Diagnostics::default();
    let mut overrides = Overrides::default();
    let (mut outputs, mut planned) = (Vec::new(), None);
    let size =
        |text: &str| text.split_once('x').map(|(width, height)| (width.parse().unwrap(), height.parse().unwrap()));
    for line in source.text().lines().map_while(|line| line.strip_prefix("// ")) {
        match line.split_once(' ').unwrap() {
            ("--set", text) => match Override::parse(text, line) {
                Ok(given) => overrides.params.push(given),
                Err(mistakes) => out.extend(mistakes),
            },
            ("--size", text) => overrides.size = size(text),
            ("--output", name) => outputs.push((name.to_owned(), line.to_owned())),
            ("plan", text) => planned = size(text),
            (other, _) => panic!("{other}"),
        }
    }
    let file = read(source, &mut out);
    let graph = file.and_then(|file| validate_with(&file, &catalogue(), &overrides, &exists, &mut out));
    let sound = !out.has_errors();
    assert!(graph.is_none() || sound || overrides.params.is_empty(), "a graph in spite of mistakes");
    if let Some(graph) = graph {
        for (name, argument) in outputs {
            out.extend(graph.find(&name, Place::Argument(argument)).err());
        }
        if let Err(mistakes) = plan(&graph, &PlanOptions::new(planned.unwrap_or(graph.size))) {
            out.extend(mistakes);
        }
    } else if let Some(file) = read(source, &mut Diagnostics::default()) {
        // An unknown output of a graph with other mistakes is looked up once these are mended.
        assert!(!file.passes.is_empty() || file.broken);
    }
    out
}

#[test]
fn every_code_has_a_fixture() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/fixtures");
    let codes: Vec<Code> = CODES.iter().chain(ALSO).copied().collect();
    fixture::check(&folder, &codes, &mistakes);
}

#[test]
fn a_code_without_a_fixture_is_noticed() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/fixtures");
    let codes: Vec<Code> = CODES.iter().chain(ALSO).copied().chain([Code("no-such-code")]).collect();
    let problems = fixture::problems(&folder, &codes, &mistakes, false);
    assert!(problems.iter().any(|problem| problem.contains("no-such-code")), "{problems:?}");
}
