//! Nothing that stands in a file makes the program panic.

#![allow(clippy::unwrap_used, reason = "a test")]

mod support;

use proptest::prelude::*;
use support::{CONTRACT, catalogue, generated, random};
use tyndall_document::{Diagnostics, Source, render_json, render_text};
use tyndall_graph::{Graph, Order, Override, Overrides, PlanOptions, Roots, explain, plan, read, show, validate_with};

/// Everything that the program does with a text. Gives whether it was a graph.
fn through(text: &str, overrides: &Overrides) -> bool {
    let mut out = Diagnostics::default();
    let Some(file) = read(&Source::new("hostile.graph.ron", text), &mut out) else {
        assert!(out.has_errors());
        return false;
    };
    let graph = validate_with(&file, &catalogue(), overrides, &|_| true, &mut out);
    assert_eq!(graph.is_none(), out.has_errors());
    render_text(out.iter(), false);
    render_json(out.iter());
    graph.inspect(views).is_some()
}

fn views(graph: &std::sync::Arc<Graph>) {
    for (size, roots) in [(graph.size, Roots::Outputs), ((u32::MAX, u32::MAX), Roots::All), ((1, 1), Roots::All)] {
        let options = PlanOptions { roots, order: Order::Shuffled(1), ..PlanOptions::new(size) };
        let Ok(plan) = plan(graph, &options) else { continue };
        show::text(&plan);
        show::json(&plan);
        show::dot(&plan);
        show::svg(&plan);
        for (name, _) in &graph.outputs {
            explain(&plan, name).unwrap();
        }
    }
}

/// Pieces that make a text go wrong in places that matter.
const PIECES: &[&str] = &[
    "\"",
    "(",
    ")",
    "{",
    "}",
    ",",
    ":",
    "-1",
    "0",
    "1e999",
    "NaN",
    "$",
    "$frame",
    "$time",
    ".",
    "surfaces",
    "lit.radiance",
    "fogged.radiance",
    "display.color",
    "surfaces.depth",
    "core.add",
    "core.halve",
    "core.grade",
    "core.accumulate",
    "true",
    "enabled: false, ",
    "\u{0}",
    "\u{202e}",
    "é",
    "99999999999999999999",
    "inputs",
    "params",
    "size: (1, 1),",
    "version: 1,",
];

proptest! {
    #![proptest_config(ProptestConfig { cases: 2000, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn a_contract_with_changes(changes in prop::collection::vec((any::<prop::sample::Index>(), 0..12usize, any::<prop::sample::Index>()), 1..6)) {
        let mut text: Vec<char> = CONTRACT.chars().collect();
        for (at, length, piece) in changes {
            let at = at.index(text.len());
            let end = (at + length).min(text.len());
            text.splice(at..end, PIECES[piece.index(PIECES.len())].chars());
        }
        through(&text.into_iter().collect::<String>(), &Overrides::default());
    }

    #[test]
    fn references_in_any_way(swaps in prop::collection::vec((any::<prop::sample::Index>(), any::<prop::sample::Index>()), 1..8)) {
        let mut parts: Vec<&str> = CONTRACT.split('"').collect();
        for (a, b) in swaps {
            let (a, b) = (a.index(parts.len()), b.index(parts.len()));
            // Only what stands in quotes.
            if a % 2 == 1 && b % 2 == 1 {
                parts[a] = parts[b];
            }
        }
        through(&parts.join("\""), &Overrides::default());
    }

    #[test]
    fn any_argument(text in "[a-z.]{0,12}=?.{0,12}") {
        if let Ok(given) = Override::parse(&text, "--set x") {
            through(CONTRACT, &Overrides { params: vec![given], size: None, scene: None });
        }
    }

    #[test]
    fn random_graphs_with_loops(text in random::text(), links in prop::collection::vec((any::<prop::sample::Index>(), any::<prop::sample::Index>()), 1..20)) {
        let names: Vec<String> = text.split('"').filter(|part| part.contains(".x")).map(str::to_owned).collect();
        let mut text = text;
        for (from, to) in links {
            if names.is_empty() { break; }
            text = text.replacen(&names[from.index(names.len())], &names[to.index(names.len())], 1);
        }
        let mut out = Diagnostics::default();
        let file = read(&Source::new("loops.graph.ron", text), &mut out).unwrap();
        validate_with(&file, &random::catalogue(), &Overrides::default(), &|_| true, &mut out);
        render_text(out.iter(), false);
    }
}

#[test]
fn the_contract_itself_is_a_graph() {
    assert!(through(CONTRACT, &Overrides::default()));
}

#[test]
fn deep_chains_and_long_loops_do_not_overflow_the_stack() {
    let chain = |first: &str| {
        let mut text = String::from("(version: 1, passes: {\n\"tile\": (use: \"core.tile\"),\n");
        text += &format!("\"p0\": (use: \"core.add\", inputs: {{ \"a\": \"{first}\" }}),\n");
        for index in (1..20_000).rev() {
            text += &format!("\"p{index}\": (use: \"core.add\", inputs: {{ \"a\": \"p{}.sum\" }}),\n", index - 1);
        }
        text + "}, outputs: { \"image\": \"p19999.sum\" })"
    };
    let mut out = Diagnostics::default();
    let file = read(&Source::new("chain.graph.ron", chain("tile.tile")), &mut out).unwrap();
    let graph = validate_with(&file, &catalogue(), &Overrides::default(), &|_| true, &mut out).unwrap();
    let chained = plan(&graph, &PlanOptions::new(graph.size)).unwrap();
    assert_eq!(chained.bytes.classes.iter().next().unwrap().slots, 2);
    explain(&chained, "p0").unwrap();
    explain(&chained, "image").unwrap();
    show::text(&chained);
    let file = read(&Source::new("loop.graph.ron", chain("p19999.sum")), &mut out).unwrap();
    assert!(validate_with(&file, &catalogue(), &Overrides::default(), &|_| true, &mut out).is_none());
    assert_eq!(out.iter().next().unwrap().related.len(), 19_999);
}

#[test]
fn large_graphs_can_be_looked_at() {
    let mut out = Diagnostics::default();
    let file = read(&Source::new("large.graph.ron", generated(3000)), &mut out).unwrap();
    let graph = validate_with(&file, &catalogue(), &Overrides::default(), &|_| true, &mut out).unwrap();
    views(&graph);
}
