//! A catalogue describes a pass when a graph first uses it, and its mistakes are that graph's alone.

#![allow(clippy::unwrap_used, reason = "a test")]

mod support;

use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};

use support::{output, pass};
use tyndall_document::{Code, Diagnostic, Diagnostics, Place, Source, render_text};
use tyndall_graph::descriptor::{Class, Format};
use tyndall_graph::{Catalogue, Kind, Overrides, read, validate};

fn sound(name: &str) -> Arc<Kind> {
    Arc::new(Kind::new(Arc::new(pass(name, vec![output("color", Class::Color, Format::Rgba32Float)], vec![]))).unwrap())
}

fn broken(file: &str) -> Diagnostics {
    Diagnostic::error(Code("broken"), Place::File(file.to_owned()), format!("{file} is broken")).into()
}

/// The text of every mistake of a graph with these passes; the last one is its output.
fn mistakes(catalogue: &Catalogue, passes: &[&str]) -> String {
    let lines = passes.iter().enumerate().map(|(index, kind)| format!("\"p{index}\": (use: \"{kind}\"),\n"));
    let (lines, last) = (lines.collect::<String>(), passes.len() - 1);
    let text = format!("(version: 1, passes: {{\n{lines}}}, outputs: {{ \"color\": \"p{last}.color\" }})");
    let mut out = Diagnostics::default();
    let file = read(&Source::new("test.graph.ron", text), &mut out).unwrap();
    let graph = validate(&file, catalogue, &Overrides::default(), &mut out);
    assert_eq!(graph.is_none(), out.has_errors());
    render_text(&out, false)
}

#[test]
fn a_pass_is_described_when_it_is_used_and_once() {
    let described = Arc::new(AtomicUsize::new(0));
    let mut catalogue = Catalogue::new();
    let count = described.clone();
    catalogue.insert_lazy("test.used", move || {
        count.fetch_add(1, Ordering::Relaxed);
        Ok(sound("test.used"))
    });
    catalogue.insert_lazy("test.unused", || panic!("nobody uses it"));
    assert_eq!(catalogue.names(), ["test.unused", "test.used"]);
    let text = mistakes(&catalogue, &["test.unsued"]);
    assert!(text.contains("there is no pass `test.unsued`") && text.contains("did you mean `test."), "{text}");
    assert_eq!(described.load(Ordering::Relaxed), 0);
    std::thread::scope(|scope| {
        for catalogue in [catalogue.clone(), catalogue.clone(), catalogue] {
            scope.spawn(move || assert_eq!(mistakes(&catalogue, &["test.used", "test.used"]), ""));
        }
    });
    assert_eq!(described.load(Ordering::Relaxed), 1);
}

#[test]
fn what_is_wrong_with_a_pass_is_told_where_it_is_used() {
    let mut catalogue = Catalogue::new();
    catalogue.insert_lazy("test.sound", || Ok(sound("test.sound")));
    catalogue.insert_lazy("test.broken", || Err(broken("broken.wgsl")));
    assert_eq!(mistakes(&catalogue, &["test.sound"]), "");
    let text = mistakes(&catalogue, &["test.broken", "test.broken", "test.sound"]);
    assert_eq!(text.matches("broken.wgsl is broken").count(), 1, "{text}");
    assert!(text.contains("`test.broken` is used here") && text.contains("test.graph.ron:2:13"), "{text}");
    assert!(!text.contains("there is no pass"), "{text}");
}

#[test]
fn a_broken_manifest_is_told_of_passes_that_it_should_declare() {
    let mut catalogue = Catalogue::new();
    catalogue.insert_lazy("test.sound", || Ok(sound("test.sound")));
    catalogue.insert_plugin("test", Some("test/plugin.ron".to_owned()), Diagnostics::default());
    catalogue.insert_plugin("other", Some("other/plugin.ron".to_owned()), broken("other/plugin.ron"));
    assert_eq!(mistakes(&catalogue, &["test.sound"]), "");
    let text = mistakes(&catalogue, &["other.pass", "test.sound"]);
    assert!(text.contains("other/plugin.ron is broken") && !text.contains("there is no pass"), "{text}");
    let text = mistakes(&catalogue, &["test.pass"]);
    assert!(text.contains("there is no pass `test.pass` in test/plugin.ron"), "{text}");
    assert!(!text.contains("other/plugin.ron"), "{text}");
}

/// Which plugin it declares is not known: it may be any.
#[test]
fn a_manifest_without_a_name_is_told_of_every_pass_that_is_not_found() {
    let mut catalogue = Catalogue::new();
    catalogue.insert_lazy("test.sound", || Ok(sound("test.sound")));
    catalogue.insert_unread(broken("nameless/plugin.ron"));
    assert_eq!(mistakes(&catalogue, &["test.sound"]), "");
    for unknown in ["any.pass", "test.pass", "pass"] {
        let text = mistakes(&catalogue, &[unknown, unknown]);
        assert_eq!(text.matches("there is no pass").count(), 2, "{text}");
        assert_eq!(text.matches("nameless/plugin.ron is broken").count(), 1, "{text}");
    }
}
