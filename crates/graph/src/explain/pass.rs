//! Why a pass runs, and when.

use petgraph::Direction;
use petgraph::graph::NodeIndex;
use petgraph::visit::EdgeRef;
use rustc_hash::FxHashMap;

use super::{Report, ordinal};
use crate::graph::{Graph, ParamSetting};
use crate::plan::{CullReason, Plan};
use crate::show::culled_words;

/// Explains a pass.
pub(super) fn explain(plan: &Plan, pass: u32) -> String {
    let graph = &plan.graph;
    let of_pass = graph.pass(pass);
    let name = &of_pass.name;
    let mut report = match plan.position(pass) {
        Some(position) => {
            let (at, of) = (ordinal(position + 1), plan.passes.len());
            Report::new(format!("`{name}` is {}, and runs as the {at} of {of} passes.", of_pass.descriptor().name))
        }
        None => Report::new(format!("`{name}` is {}, and does not run.", of_pass.descriptor().name)),
    };
    match plan.position(pass) {
        Some(position) => {
            report.line("needed by", &needed_by(plan, pass));
            report.lines("runs after", &runs_after(plan, position));
            report.line("placed", &placed(plan, position));
            report.lines("changes", &changes(plan, position));
        }
        None => {
            let culled = plan.culled.iter().find(|culled| culled.pass == pass);
            let why = culled.map(|culled| culled_words(plan, culled)).unwrap_or_default();
            report.line("culled", &why);
            if culled.is_some_and(|culled| culled.reason == CullReason::Unread) {
                report.lines("read by", &dead_readers(plan, pass));
            }
        }
    }
    report.lines("parameters", &parameters(graph, pass));
    let scene = &of_pass.descriptor().scene;
    if !scene.is_empty() {
        report.line("scene data", &scene.join(", "));
    }
    report.text
}

/// The shortest way from the pass to something that was asked for.
fn needed_by(plan: &Plan, pass: u32) -> String {
    if plan.graph.pass(pass).descriptor().side_effect {
        return "it has a side effect, so it always runs".to_owned();
    }
    let readers = readers(plan);
    let mut came_from: FxHashMap<u32, Option<(u32, String)>> = FxHashMap::from_iter([(pass, None)]);
    let mut queue = std::collections::VecDeque::from([pass]);
    while let Some(next) = queue.pop_front() {
        if let Some(end) = end_of(plan, next) {
            return way(plan, next, &end, &came_from);
        }
        for (reader, words) in readers.get(&next).into_iter().flatten() {
            came_from.entry(*reader).or_insert_with(|| {
                queue.push_back(*reader);
                Some((next, words.clone()))
            });
        }
    }
    "nothing that was asked for".to_owned()
}

/// By pass: the running passes that read it, and through which port.
fn readers(plan: &Plan) -> FxHashMap<u32, Vec<(u32, String)>> {
    let graph = &plan.graph;
    let mut readers: FxHashMap<u32, Vec<(u32, String)>> = FxHashMap::default();
    for position in 0..plan.passes.len() as u32 {
        let reader = plan.passes[position as usize].index;
        for number in graph.table.ports(reader) {
            if let Some(source) = graph.table.feeds[number as usize].as_port() {
                let port = &plan.descriptor(position).ports[(number - graph.table.port(reader, 0)) as usize].name;
                let words = format!("{}.{port}", plan.pass_name(position));
                readers.entry(graph.table.pass_of[source as usize]).or_default().push((reader, words));
            }
        }
    }
    readers
}

/// What of a pass was asked for.
fn end_of(plan: &Plan, pass: u32) -> Option<String> {
    let position = plan.position(pass)?;
    let root = plan.outputs_of(position).find(|port| plan.ports[*port as usize].root)?;
    Some(match plan.outputs.iter().find(|(_, port)| *port == root) {
        Some((name, _)) => format!("the output `{name}`"),
        None => format!("{}, which was asked for", plan.port_name(root)),
    })
}

fn way(plan: &Plan, last: u32, end: &str, came_from: &FxHashMap<u32, Option<(u32, String)>>) -> String {
    let mut steps = vec![end.to_owned()];
    let mut pass = last;
    while let Some(Some((before, words))) = came_from.get(&pass) {
        steps.push(words.clone());
        pass = *before;
    }
    steps.push(plan.graph.pass(pass).name.clone());
    steps.reverse();
    steps.join(" → ")
}

fn runs_after(plan: &Plan, position: u32) -> Vec<String> {
    let sources = plan.sources(position).iter().zip(&plan.descriptor(position).ports);
    let mut lines: Vec<String> = sources
        .filter_map(|(source, port)| {
            let source = (*source)?;
            let writer = plan.ports[source as usize].pass? + 1;
            Some(format!("{}, the {}, for `{}`", plan.port_name(source), ordinal(writer), port.name))
        })
        .collect();
    if lines.is_empty() {
        lines.push("nothing: it reads no port of this frame".to_owned());
    }
    lines
}

/// Whether the file's order or a wait put the pass at its position.
fn placed(plan: &Plan, position: u32) -> String {
    let pass = plan.passes[position as usize].index;
    let Some(before) = position.checked_sub(1).map(|before| plan.passes[before as usize].index) else {
        return "first".to_owned();
    };
    let name = |pass: u32| &plan.graph.pass(pass).name;
    if before < pass {
        return format!("behind `{}`, as in the file", name(before));
    }
    let after = plan.passes[position as usize + 1..].iter().find(|after| after.index < pass);
    match after {
        Some(after) => format!("before `{}`, which stands first in the file but depends on it", name(after.index)),
        None => format!("behind `{}`, which had to run earlier than the file has it", name(before)),
    }
}

/// Why a pass runs in every frame, or does not.
fn changes(plan: &Plan, position: u32) -> Vec<String> {
    if plan.passes.iter().all(|pass| pass.volatile) {
        return vec!["it runs in every frame".to_owned()];
    }
    if !plan.passes[position as usize].volatile {
        return vec!["nothing that it depends on changes from frame to frame, so it runs once".to_owned()];
    }
    let sources = plan.sources(position).iter().flatten();
    let changing = sources.filter(|source| {
        let writer = plan.ports[**source as usize].pass;
        writer.is_some_and(|writer| plan.passes[writer as usize].volatile)
    });
    let mut names: Vec<String> =
        changing.map(|source| format!("it reads {}, which changes", plan.port_name(*source))).collect();
    names.dedup();
    if names.is_empty() {
        names.push(
            "its parameters, its scene data, its history or its side effect change from frame to frame".to_owned(),
        );
    }
    names
}

/// The passes that read one which does not run: they do not run either.
fn dead_readers(plan: &Plan, pass: u32) -> Vec<String> {
    let graph = &plan.graph;
    let mut edges: Vec<_> = graph.passes.edges_directed(NodeIndex::new(pass as usize), Direction::Outgoing).collect();
    edges.sort_by_key(|edge| edge.weight().span.start);
    let words = edges.iter().map(|edge| {
        let reader = graph.pass(edge.target().index() as u32);
        let port = &reader.descriptor().ports[edge.weight().to as usize].name;
        let why = if reader.enabled { "does not run either" } else { "is switched off" };
        format!("{}.{port}, which {why}", reader.name)
    });
    let mut lines: Vec<String> = words.collect();
    if lines.is_empty() {
        lines.push("no pass".to_owned());
    }
    lines
}

fn parameters(graph: &Graph, pass: u32) -> Vec<String> {
    let of_pass = graph.pass(pass);
    let settings = of_pass.params.iter().zip(&of_pass.descriptor().params).enumerate();
    settings
        .map(|(index, (setting, param))| {
            let unit = if param.unit.is_empty() { String::new() } else { format!(" {}", param.unit) };
            let uses = |used: &&crate::graph::GraphParam| {
                used.uses.iter().any(|used| (used.pass, used.param as usize) == (pass, index))
            };
            match (setting, graph.params.iter().find(uses)) {
                (ParamSetting::Frame, _) => format!("{} = $frame", param.name),
                (ParamSetting::Time, _) => format!("{} = $time", param.name),
                (ParamSetting::Value(value), Some(given)) => {
                    format!("{} = {value}{unit}, from ${}", param.name, given.name)
                }
                (ParamSetting::Value(value), None) if *value == param.default => {
                    format!("{} = {value}{unit}, the default", param.name)
                }
                (ParamSetting::Value(value), None) => format!("{} = {value}{unit}", param.name),
            }
        })
        .collect()
}
