//! What the reader gives, what it reports of broken documents, and that nothing makes it panic or crawl.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking, its helpers too")]

use std::fmt::Write;
use std::sync::Arc;
use std::time::Instant;

use proptest::prelude::*;
use tyndall_document::{Diagnostics, Node, Place, Source, Value, parse, parse_value, render_json, render_text};

/// `code line:column` of everything that is reported.
fn reports(text: &str) -> Vec<String> {
    let source = Source::new("text.ron", text);
    let mut out = Diagnostics::new();
    let node = parse(&source, &mut out);
    assert!(node.is_some() || out.has_errors(), "neither a value nor an error: {text:?}");
    let place = |place: &Place| place.line_column().map_or("-".to_owned(), |(line, column)| format!("{line}:{column}"));
    out.iter().map(|diagnostic| format!("{} {}", diagnostic.code, place(&diagnostic.place))).collect()
}

fn read(text: &str) -> (Arc<Source>, Node) {
    let source = Source::new("text.ron", text);
    let mut out = Diagnostics::new();
    let node = parse(&source, &mut out);
    assert!(out.is_empty(), "{}", render_text(&out, false));
    (source, node.unwrap())
}

#[test]
fn spans_are_those_of_the_text() {
    let (source, node) = read("// c\n(passes: { \"ä\": Some( Use(1.5) ), }, 'x')".replace(", 'x'", "").as_str());
    assert_eq!(source.slice(node.span), "(passes: { \"ä\": Some( Use(1.5) ), })");
    let Value::Struct(fields) = &node.value else { panic!() };
    assert_eq!(source.slice(fields[0].name_span), "passes");
    assert_eq!(source.slice(fields[0].value.span), "{ \"ä\": Some( Use(1.5) ), }");
    let Value::Map(entries) = &fields[0].value.value else { panic!() };
    assert_eq!(source.slice(entries[0].0.span), "\"ä\"");
    let Value::Variant { name, name_span, content: Some(content) } = &entries[0].1.value else { panic!() };
    assert_eq!((name.as_str(), source.slice(*name_span)), ("Use", "Use"));
    assert_eq!((source.slice(entries[0].1.span), source.slice(content.span)), ("Use(1.5)", "(1.5)"));
    assert_eq!(source.line_column(entries[0].1.span.start), (2, 23));
}

/// One mistake, one report, at its place, whatever comes after it.
#[test]
fn one_mistake_is_one_report() {
    const GRAPH: &str = r#"(
    version: 1,
    about: "Fog.",
    size: (640, 480),
    params: { "exposure": 1.0 },
    passes: {
        "surfaces": (use: "core.gbuffer"),
        "air": (use: "airlight.homogeneous", inputs: { "depth": "surfaces.depth" }),
        "display": (use: "core.tonemap", inputs: { "radiance": "air.radiance" }, params: { "exposure": "$exposure" }),
    },
    outputs: { "image": "display.color" },
)
"#;
    assert!(reports(GRAPH).is_empty());
    let mut wrong = Vec::new();
    for (from, to, expected) in [
        ("\"Fog.\",", "\"Fog.\"", "missing-comma 3:17"),
        ("version: 1,", "version: 1", "missing-comma 2:14"),
        ("(640, 480)", "(640 480)", "missing-comma 4:16"),
        ("(640, 480),", "(640, 480,", "unclosed-bracket 4:11"),
        ("1.0 }", "1.0", "unclosed-bracket 5:13"),
        ("{ \"exposure\": 1.0 }", "{ \"exposure\": 1.0 ]", "unopened-bracket 5:31"),
        ("core.gbuffer\")", "core.gbuffer)", "unterminated-string 7:27"),
        ("\"core.gbuffer\")", "core.gbuffer\")", "unexpected-character 7:27"),
        ("core.gbuffer\")", "core.gbuffer\"", "unclosed-bracket 7:21"),
        ("surfaces.depth\" })", "surfaces.depth\" )", "unclosed-bracket 8:54"),
        ("surfaces.depth\" })", "surfaces.depth\" }", "unclosed-bracket 8:16"),
        ("\"$exposure\" }", "$exposure }", "unexpected-character 9:104"),
        ("    },\n    outputs", "    outputs", "unclosed-bracket 6:13"),
        ("\"display.color\" },", "\"display.color\",", "unclosed-bracket 11:14"),
        ("    },\n", "    };\n", "unexpected-character 10:6"),
        ("\"air\": (", "\"air\" (", "missing-colon 8:15"),
        ("size: (", "size (", "missing-colon 4:10"),
        ("size: (", "size = (", "missing-colon 4:10"),
        ("about: \"Fog.\"", "about: \"Fog.", "unterminated-string 3:12"),
        ("about: \"Fog.\"", "about: Fog.\"", "unexpected-character 3:12"),
        ("    version", "  # version", "unexpected-character 2:3"),
        (")\n", "", "unclosed-bracket 1:1"),
        ("use: \"airlight", "use \"airlight", "missing-colon 8:21"),
        ("1.0", "1.0.0", "bad-number 5:27"),
        ("1.0", "1,0", "misplaced-entry 5:29"),
        ("version: 1", "version 1", "missing-colon 2:13"),
        ("version: 1", "version:", "missing-value 2:13"),
        ("version: 1", "\"version\": 1", "misplaced-entry 2:5"),
    ] {
        assert!(GRAPH.contains(from), "{from}");
        let broken = GRAPH.replacen(from, to, 1);
        let found = reports(&broken);
        if found != [expected] {
            wrong.push(format!("{from} -> {to}: {found:?} instead of {expected}"));
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
fn several_mistakes_are_several_reports() {
    let text = "(\n a: 0x,\n b: [1 2],\n c: \"\\q\",\n d: { \"x\" 1 },\n e: %,\n f: 1,\n f: 2,\n)";
    assert_eq!(
        reports(text),
        [
            "bad-number 2:5",
            "missing-comma 3:8",
            "bad-escape 4:6",
            "missing-colon 5:11",
            "unexpected-character 6:5",
            "duplicate-name 8:2"
        ]
    );
}

#[test]
fn an_argument_is_its_own_place() {
    let mut out = Diagnostics::new();
    assert!(parse_value(&Source::argument("--set a=1.5", "1.5"), &mut out).is_some());
    assert!(parse_value(&Source::argument("--set a=[1", "[1"), &mut out).is_none());
    assert!(parse_value(&Source::new("--set a={", "{"), &mut out).is_none());
    assert_eq!(
        out.iter().map(|d| &d.place).collect::<Vec<_>>(),
        [&Place::Argument("--set a=[1".to_owned()), &Place::Argument("--set a={".to_owned())]
    );
    let text = render_text(&out, false);
    assert!(text.starts_with("error[unclosed-bracket]: this `[` is not closed\n--> --set a=[1\n"), "{text}");
    let json = render_json(&out);
    assert!(
        json.contains(r#""file": null, "line": null, "column": null, "text": "--set a=[1", "argument": "--set a=[1""#)
    );
}

#[test]
fn json_is_json() {
    let source = Source::new("a \"b\"\\\n.ron", "(a: \u{1}\"\u{2028}\"\t/)");
    let mut out = Diagnostics::new();
    parse(&source, &mut out);
    // JSON is RON but for its escapes of controls, so our own reader checks the shape.
    let json = render_json(&out).replace("\\u2028", "").replace("\\u0001", "").replace("\\\\u{1}", "");
    let (_, node) = read(&json);
    let Value::List(items) = node.value else { panic!("{json}") };
    assert_eq!(items.len(), out.len());
    assert_eq!(render_json(&Diagnostics::new()), "[]\n");
}

#[test]
fn color_is_only_color() {
    let source = Source::new("text.ron", format!("({} a: 1 b: 2)", "x: 1, ".repeat(100)));
    let mut out = Diagnostics::new();
    parse(&source, &mut out);
    let colored = render_text(&out, true);
    assert!(colored.contains("\u{1b}["));
    let mut plain = String::new();
    for (index, part) in colored.split('\u{1b}').enumerate() {
        plain.push_str(if index == 0 { part } else { part.split_once('m').map_or("", |(_, rest)| rest) });
    }
    assert_eq!(plain, render_text(&out, false));
}

#[test]
fn diagnostics_come_in_file_order() {
    let (a, b) = (Source::new("a.ron", "1 2 3"), Source::new("b.ron", "1 2 3"));
    let at = |source: &Arc<Source>, start: u32, message: &str| {
        let span = tyndall_document::Span::new(start, start + 1);
        tyndall_document::Diagnostic::error(tyndall_document::WRONG_TYPE, source.place(span), message)
    };
    let argument = Source::argument("--set x=1", "1");
    let mut all: Diagnostics = [
        at(&argument, 0, "argument"),
        at(&b, 4, "b4"),
        at(&a, 2, "a2"),
        at(&b, 0, "b0"),
        at(&a, 2, "a2 too"),
        at(&a, 2, "a2"),
    ]
    .into_iter()
    .collect();
    all.sort();
    all.dedup();
    let order: Vec<_> = all.iter().map(|d| d.message.as_str()).collect();
    assert_eq!(order, ["b0", "b4", "a2", "a2 too", "argument"]);
}

/// A graph of so many passes.
fn graph(passes: usize) -> String {
    let mut text = String::from("(\n    version: 1,\n    passes: {\n");
    for i in 0..passes {
        writeln!(
            text,
            "        \"pass_{i}\": (use: \"core.add\", inputs: {{ \"a\": \"pass_{}.sum\", \"b\": \"pass_{}.sum\" }}, params: {{ \"gain\": 0.{i} }}),",
            i / 2,
            i / 3
        )
        .unwrap();
    }
    text + "    },\n    outputs: { \"image\": \"pass_1.sum\" },\n)\n"
}

#[test]
fn a_large_graph_is_read_fast() {
    let text = graph(10_000);
    let source = Source::new("large.ron", text.as_str());
    let mut best = f64::INFINITY;
    for _ in 0..20 {
        let start = Instant::now();
        let mut out = Diagnostics::new();
        assert!(parse(&source, &mut out).is_some() && out.is_empty());
        best = best.min(start.elapsed().as_secs_f64());
    }
    let megabytes = text.len() as f64 / 1e6;
    println!("{megabytes:.2} MB in {:.2} ms: {:.0} MB/s", best * 1e3, megabytes / best);
    // Far below what it reaches, for machines under load.
    assert!(megabytes / best > 5.0, "{:.1} MB/s", megabytes / best);
}

/// Texts made to be slow: each must be done in a time that grows with its length alone.
#[test]
fn hostile_texts_are_cheap() {
    let size = 1 << 20;
    for unit in [
        "[", "(", "{", "\"", "\"\n", "\"\n\" ", "r#\"\n", "r##\"#\n", "/*", "'", "'\\", "%,", "a: ", "(a: ", "]", "1 ",
        "\\", "0x", "\u{200e}", "ä", "[[],", "\"\\\n", "Some(", ",",
    ] {
        let text = unit.repeat(size / unit.len());
        let source = Source::new("hostile.ron", text);
        let start = Instant::now();
        let mut out = Diagnostics::new();
        parse(&source, &mut out);
        let rendered = render_text(&out, false).len() + render_json(&out).len();
        assert!(rendered < 1 << 20, "{unit:?}: {rendered} bytes of reports");
        assert!(start.elapsed().as_secs_f64() < 5.0, "{unit:?}: {:?}", start.elapsed());
    }
}

/// Reads and renders; the places must lie in the text.
fn exercise(text: &str) {
    let source = Source::new("text.ron", text);
    let mut out = Diagnostics::new();
    let node = parse(&source, &mut out);
    assert!(node.is_some() || out.has_errors());
    for diagnostic in &out {
        for place in std::iter::once(&diagnostic.place).chain(diagnostic.related.iter().map(|(place, _)| place)) {
            let Place::Text { source, span } = place else { panic!("a text has places") };
            let text = source.text();
            assert!(span.start <= span.end && text.get(span.start as usize..span.end as usize).is_some(), "{span:?}");
        }
    }
    drop((render_text(&out, true), render_json(&out)));
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 3000, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn any_bytes_are_survived(bytes in prop::collection::vec(any::<u8>(), 0..200)) {
        exercise(&String::from_utf8_lossy(&bytes));
    }

    #[test]
    fn any_text_is_survived(text in "[()\\[\\]{},:;\"'\\\\/*#!rbx0-9a-fu_.+\\-e$ \näé\u{2028}\u{feff}]{0,80}") {
        exercise(&text);
    }

    #[test]
    fn mutated_graphs_are_survived(edits in prop::collection::vec((any::<prop::sample::Index>(), 0..3, any::<prop::sample::Index>()), 1..8)) {
        const PIECES: &[&str] = &["(", ")", "[", "]", "{", "}", "\"", "'", ",", ":", "\\", "/*", "*/", "//", "\n", "0x", "r#\"", "b\"", "ä", "\u{0}"];
        let mut text = graph(6);
        for (at, kind, piece) in edits {
            let at = text.floor_char_boundary(at.index(text.len()));
            match kind {
                0 if at < text.len() => drop(text.remove(at)),
                1 => text.insert_str(at, PIECES[piece.index(PIECES.len())]),
                _ => text.truncate(at),
            }
            if text.is_empty() { break }
        }
        exercise(&text);
    }
}
