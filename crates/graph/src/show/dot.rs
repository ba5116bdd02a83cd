//! A plan as a graph for Graphviz.

use std::fmt::Write;

use petgraph::visit::EdgeRef;

use super::names::culled_words;
use crate::plan::Plan;

/// A plan as a graph for Graphviz: passes with their position, connections with their ports; what does not run is grey.
pub fn dot(plan: &Plan) -> String {
    let graph = &plan.graph;
    let mut text = String::from("digraph plan {\n  rankdir = LR;\n  node [shape = box, fontname = \"sans-serif\"];\n");
    // Writing to a string cannot fail.
    for index in 0..graph.passes.node_count() as u32 {
        let pass = graph.pass(index);
        let kind = &pass.descriptor().name;
        let _ = match plan.position(index) {
            Some(position) => {
                writeln!(text, "  {} [label = \"{}  {}\\n{kind}\"];", quoted(&pass.name), position + 1, pass.name)
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
    let mut edges: Vec<_> = graph.passes.edge_references().collect();
    edges.sort_by_key(|edge| edge.weight().span.start);
    for edge in edges {
        let (writer, reader) = (&graph.passes[edge.source()], &graph.passes[edge.target()]);
        let from = &writer.descriptor().ports[edge.weight().from as usize].name;
        let to = &reader.descriptor().ports[edge.weight().to as usize].name;
        let runs = |pass: petgraph::graph::NodeIndex| plan.position(pass.index() as u32).is_some();
        let style = match (runs(edge.source()) && runs(edge.target()), edge.weight().history) {
            (false, _) => ", color = grey, fontcolor = grey",
            (true, true) => ", style = dashed, constraint = false",
            (true, false) => "",
        };
        let (writer, reader) = (quoted(&writer.name), quoted(&reader.name));
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
