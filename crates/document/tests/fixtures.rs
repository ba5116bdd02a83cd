//! Every code is pinned, and the harness that pins them fails when it should.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking, its helpers too")]

use std::fs;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use tyndall_document::{
    BAD_NAME, CODES, Code, Decoder, Diagnostics, MISSING_COMMA, MISSING_VALUE, Node, Source, TOO_MANY_ERRORS,
    UNREADABLE_FILE, fixture, parse,
};

/// Reads a fixture. Its fields are named after the method that decodes them; `read` is a file to be read.
fn run(source: &Arc<Source>) -> Diagnostics {
    let mut out = Diagnostics::new();
    if let Some(node) = parse(source, &mut out) {
        decode(&mut Decoder::new(source, &mut out), &node);
    }
    out.sort();
    // It comes after the hundred errors that cause it.
    let last = out.iter().find(|diagnostic| diagnostic.code == TOO_MANY_ERRORS).cloned();
    last.map_or(out, Diagnostics::from)
}

const FIELDS: &[&str] = &[
    "read", "bool", "float", "integer", "text", "list", "map", "floats", "fields", "variant", "name", "format",
    "version", "params",
];

fn decode(decoder: &mut Decoder<'_>, node: &Node) {
    let Some(fields) = decoder.fields(node, "the document", FIELDS) else { return };
    for field in fields.iter() {
        let node = &field.value;
        match field.name.as_str() {
            "read" => {
                let path = decoder.text(node).unwrap();
                if let Err(diagnostic) = Source::read(Path::new(path)) {
                    decoder.report(diagnostic);
                }
            }
            "bool" => drop(decoder.bool(node)),
            "float" => drop(decoder.float(node)),
            "integer" => drop(decoder.integer(node)),
            "text" => drop(decoder.text(node)),
            "list" => drop(decoder.list(node)),
            "map" => drop(decoder.map(node)),
            "floats" => drop(decoder.floats::<3>(node)),
            "fields" => {
                if let Some(inner) = decoder.fields(node, "a thing", &["name", "other"]) {
                    inner.required(decoder, "name");
                }
            }
            "name" => {
                if let Some(name) = decoder.text(node) {
                    decoder.check_name(name, node.span, BAD_NAME);
                }
            }
            "format" => decoder.version(node, 2),
            "variant" => drop(decoder.variant(node, "a colour", &["Red", "Green"])),
            _ => {}
        }
    }
}

#[test]
fn every_code_is_pinned() {
    fixture::check(Path::new("tests/fixtures"), CODES, &run);
}

/// A folder that is removed in the end.
struct Folder(PathBuf);

impl Folder {
    fn new(name: &str) -> Self {
        let path = std::env::temp_dir().join(format!("tyndall-document-{}-{name}", std::process::id()));
        fs::create_dir_all(&path).unwrap();
        Self(path)
    }

    fn write(&self, name: &str, text: impl AsRef<[u8]>) {
        fs::write(self.0.join(name), text).unwrap();
    }

    fn problems(&self, codes: &[Code]) -> String {
        fixture::problems(&self.0, codes, &run, false).join("\n")
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        drop(fs::remove_dir_all(&self.0));
    }
}

#[test]
fn the_harness_fails_when_it_should() {
    let folder = Folder::new("harness");
    assert!(folder.problems(&[]).contains("holds no fixture"));
    folder.write("missing-comma.ron", "(version: 1 params: 2)");
    assert!(folder.problems(&[MISSING_COMMA]).contains("`missing-comma.txt` is missing"));
    assert!(fixture::problems(&folder.0, &[MISSING_COMMA], &run, true).is_empty());
    assert_eq!(folder.problems(&[MISSING_COMMA]), "");
    assert!(folder.problems(&[MISSING_COMMA, MISSING_VALUE]).contains("`missing-value` has no fixture"));
    assert!(folder.problems(&[MISSING_VALUE]).contains("`missing-comma.ron` is not named after a code"));
    // The same mistake elsewhere.
    folder.write("missing-comma.ron", "(version:  1 params: 2)");
    let differs = folder.problems(&[MISSING_COMMA]);
    assert!(differs.contains("--- pinned") && differs.contains(":1:13") && differs.contains(":1:14"), "{differs}");
    folder.write("missing-comma.ron", "(version: 1, params: 2)");
    assert!(folder.problems(&[MISSING_COMMA]).contains("does not report `missing-comma` first"));
    folder.write("missing-comma.ron", "(version: , 1 params: 2)");
    assert!(folder.problems(&[MISSING_COMMA]).contains("does not report `missing-comma` first"));
    folder.write("missing-comma.other.ron", "(version: 1 params: 2)");
    folder.write("missing-comma.ron", "(version: 1 params: 2)");
    assert!(folder.problems(&[MISSING_COMMA]).contains("`missing-comma.other.txt` is missing"));
    folder.write("stray.txt", "");
    assert!(folder.problems(&[MISSING_COMMA]).contains("`stray.txt` has no fixture"));
    let gone = fixture::problems(&folder.0.join("gone"), &[MISSING_COMMA], &run, false);
    assert!(gone[0].contains("cannot be read"));
}

#[test]
#[should_panic(expected = "has no fixture")]
fn check_panics_on_a_problem() {
    fixture::check(Path::new("tests/fixtures"), &[CODES, &[Code("no-such-code")]].concat(), &run);
}

#[test]
fn what_is_not_utf8_is_unreadable() {
    let folder = Folder::new("utf8");
    folder.write("latin.ron", b"(\n  name: \"gr\xfcn\")");
    let diagnostic = Source::read(&folder.0.join("latin.ron")).unwrap_err();
    assert_eq!(diagnostic.code, UNREADABLE_FILE);
    assert!(diagnostic.message.contains("byte 13, in line 2"), "{}", diagnostic.message);
    folder.write("mark.ron", "\u{feff}(a: 1)");
    assert_eq!(Source::read(&folder.0.join("mark.ron")).unwrap().text(), "(a: 1)");
}
