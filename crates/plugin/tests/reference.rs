//! `docs/plugin.md` shows every key and form that the reader of manifests knows, and no other; and every example in it is
//! read.

#![allow(clippy::unwrap_used, reason = "a test may panic")]

use tyndall_document::render_text;
use tyndall_plugin::{Folder, Registry, keys};
use tyndall_shader::Library;

const PAGE: &str = include_str!("../../../docs/plugin.md");

/// The fenced block of a language.
fn block(language: &str) -> &'static str {
    let (_, rest) = PAGE.split_once(&format!("```{language}\n")).unwrap();
    rest.split_once("```").unwrap().0
}

/// The first two cells of the rows below a heading, where they are code.
fn rows(heading: &str) -> Vec<(&'static str, Option<&'static str>)> {
    let (_, section) = PAGE.split_once(&format!("\n## {heading}\n")).unwrap();
    let section = section.split("\n## ").next().unwrap();
    let code = |cell: &'static str| cell.trim().strip_prefix('`')?.strip_suffix('`');
    let cells = section.lines().filter_map(|line| line.strip_prefix('|')).map(|line| line.split('|'));
    let rows: Vec<_> =
        cells.filter_map(|mut cells| Some((code(cells.next()?)?, cells.next().and_then(code)))).collect();
    assert!(!rows.is_empty(), "{heading}");
    rows
}

/// Reads a manifest beside the page's shader.
fn assert_is_read(manifest: &str) {
    let folder = Folder::embedded("haze", &[("plugin.ron", manifest), ("mix.wgsl", block("wgsl"))]);
    let found = Registry::new(Vec::new(), vec![folder], &Library::default()).mistakes();
    assert!(found.is_empty(), "{manifest}\n{}", render_text(&found, false));
}

#[test]
fn every_key_is_shown_with_a_part_of_the_example() {
    let manifest = block("ron");
    assert_is_read(manifest);
    let groups = [
        ("A plugin", keys::PLUGIN),
        ("A pass", keys::PASS),
        ("A port", keys::PORT),
        ("A parameter", keys::PARAM),
        ("A preset", keys::PRESET),
    ];
    for (heading, known) in groups {
        let rows = rows(heading);
        let shown: Vec<&str> = rows.iter().map(|(key, _)| *key).collect();
        assert_eq!(shown, known, "{heading}");
        for (key, example) in rows {
            let example = example.unwrap_or(key);
            assert!(example.starts_with(key) && manifest.contains(example), "{example}");
        }
    }
}

/// Each form takes the place of another one in the example.
#[test]
fn every_form_is_shown_and_read() {
    let features = tyndall_scene::Extensions::default().features("haze");
    let features: Vec<&str> = features.iter().map(|feature| feature.name).collect();
    let forms = [
        ("Limits", "Spot(\"spots are drawn as point lights\")", features.as_slice()),
        ("Classes", "class: Color", keys::CLASS),
        ("Sizes", "size: FramePixels(1.0)", keys::SIZE),
        ("While a pass is off", "disabled: Constant(0.0, 0.0, 0.0, 1.0)", keys::DISABLED),
        ("Dispatch", "dispatch: \"mixed\"", &[]),
    ];
    for (heading, example, known) in forms {
        let key = example.split_once(": ").map_or(String::new(), |(key, _)| format!("{key}: "));
        let rows = rows(heading);
        let shown: Vec<&str> = rows.iter().map(|(form, _)| form.split('(').next().unwrap()).collect();
        assert!(known.is_empty() || shown == known, "{heading}: {shown:?}");
        for (form, _) in rows {
            let manifest = block("ron");
            assert_eq!(manifest.matches(example).count(), 1, "{example}");
            assert_is_read(&manifest.replace(example, &format!("{key}{form}")));
        }
    }
}
