//! A plan as a graph for Graphviz.

use std::fmt::Write;

use super::names::culled_words;
use crate::graph::{Connection, PortRef};
use crate::plan::Plan;

/// A plan as a graph for Graphviz: passes with their position, connections with their ports; what does not run is grey.
pub fn dot(plan: &Plan) -> String {
    let graph = &plan.graph;
    let mut text = String::from("digraph plan {\n  rankdir = LR;\n  node [shape = box, fontname = \"sans-serif\"];\n");
    // Writing to a string cannot fail.
    for (index, pass) in graph.passes.entries() {
        let kind = &pass.descriptor().name;
        let _ = match plan.position(index) {
            Some(position) => {
                writeln!(
                    text,
                    "  {} [label = \"{}  {}\\n{kind}\"];",
                    quoted(&pass.name),
                    position.index() + 1,
                    pass.name
                )
            }
            None => {
                let culled = plan
                    .culled
                    .binary_search_by_key(&index, |culled| culled.pass)
                    .ok()
                    .map(|index| &plan.culled[index]);
                let why = culled.map(|culled| culled_words(plan, culled)).unwrap_or_default();
                let style = "color = grey, fontcolor = grey, style = dashed";
                let (name, label) = (quoted(&pass.name), format!("{}\\n{kind}", pass.name));
                writeln!(text, "  {name} [label = \"{label}\", tooltip = {}, {style}];", quoted(&why))
            }
        };
    }
    for Connection { from, to, history, .. } in &graph.connections {
        let runs = |port: &PortRef| plan.position(port.pass).is_some();
        let style = match (runs(from) && runs(to), history) {
            (false, _) => ", color = grey, fontcolor = grey",
            (true, true) => ", style = dashed, constraint = false",
            (true, false) => "",
        };
        let (writer, reader) = (quoted(&graph.pass(from.pass).name), quoted(&graph.pass(to.pass).name));
        let (from, to) = (&graph.port(*from).name, &graph.port(*to).name);
        let _ = writeln!(text, "  {writer} -> {reader} [label = \"{from} → {to}\"{style}];");
    }
    for (name, port) in &graph.outputs {
        let node = quoted(&format!("output {name}"));
        let _ = writeln!(text, "  {node} [label = \"{name}\", shape = plain];");
        let (pass, port) = (quoted(&graph.pass(port.pass).name), &graph.port(*port).name);
        let _ = writeln!(text, "  {pass} -> {node} [label = \"{port}\"];");
    }
    text.push_str("}\n");
    text
}

fn quoted(text: &str) -> String {
    format!("\"{}\"", text.replace('\\', "\\\\").replace('"', "\\\""))
}
