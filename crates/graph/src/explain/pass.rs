//! Why a pass runs, and when.

use rustc_hash::FxHashMap;

use super::{Report, ordinal};
use crate::graph::{Graph, GraphParam, ParamRef, ParamSetting, Pass};
use crate::handle::Handle;
use crate::plan::{CullReason, Plan, PlannedPass};
use crate::show::culled_words;

/// Explains a pass.
pub(super) fn explain(plan: &Plan, pass: Handle<Pass>) -> String {
    let graph = &plan.graph;
    let of_pass = graph.pass(pass);
    let name = &of_pass.name;
    let mut report = match plan.position(pass) {
        Some(position) => {
            let (at, of) = (ordinal(position.index() + 1), plan.passes.len());
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

/// The shortest path from the pass to something that was requested.
fn needed_by(plan: &Plan, pass: Handle<Pass>) -> String {
    if plan.graph.pass(pass).descriptor().side_effect {
        return "it has a side effect, so it always runs".to_owned();
    }
    let readers = readers(plan);
    let mut came_from: CameFrom = FxHashMap::from_iter([(pass, None)]);
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

/// By pass, the one that it was reached from, and through which port.
type CameFrom = FxHashMap<Handle<Pass>, Option<(Handle<Pass>, String)>>;

/// By pass: the running passes that read it, and through which port.
fn readers(plan: &Plan) -> FxHashMap<Handle<Pass>, Vec<(Handle<Pass>, String)>> {
    let (graph, wiring) = (&plan.graph, &plan.graph.wiring);
    let mut readers: FxHashMap<_, Vec<_>> = FxHashMap::default();
    for reader in plan.passes.iter().map(|planned| planned.pass) {
        for number in wiring.passes.ports[reader].handles() {
            if let Some(source) = wiring.feeds[number].as_port() {
                let words = graph.port_name(wiring.passes.port_ref(number));
                readers.entry(wiring.passes.pass_of[source]).or_default().push((reader, words));
            }
        }
    }
    readers
}

/// The ports of a pass that were requested.
fn end_of(plan: &Plan, pass: Handle<Pass>) -> Option<String> {
    let position = plan.position(pass)?;
    let root = plan.outputs_of(position).find(|port| plan.ports[*port].root)?;
    Some(match plan.outputs.iter().find(|(_, port)| *port == root) {
        Some((name, _)) => format!("the output `{name}`"),
        None => format!("{}, which was asked for", plan.port_name(root)),
    })
}

fn way(plan: &Plan, last: Handle<Pass>, end: &str, came_from: &CameFrom) -> String {
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

fn runs_after(plan: &Plan, position: Handle<PlannedPass>) -> Vec<String> {
    let sources = plan.sources(position).iter().zip(&plan.descriptor(position).ports);
    let mut lines: Vec<String> = sources
        .filter_map(|(source, port)| {
            let source = (*source)?;
            let writer = plan.ports[source].pass?.index() + 1;
            Some(format!("{}, the {}, for `{}`", plan.port_name(source), ordinal(writer), port.name))
        })
        .collect();
    if lines.is_empty() {
        lines.push("nothing: it reads no port of this frame".to_owned());
    }
    lines
}

/// Whether the file's order or a wait put the pass at its position.
fn placed(plan: &Plan, position: Handle<PlannedPass>) -> String {
    let pass = plan.passes[position].pass;
    let Some(before) = position.before().map(|before| plan.passes[before].pass) else {
        return "first".to_owned();
    };
    let name = |pass: Handle<Pass>| &plan.graph.pass(pass).name;
    if before < pass {
        return format!("after `{}`, as in the file", name(before));
    }
    let after = plan.passes.iter().skip(position.index() + 1).find(|after| after.pass < pass);
    match after {
        Some(after) => format!("before `{}`, which comes first in the file but depends on it", name(after.pass)),
        None => format!("after `{}`, which had to run earlier than its place in the file", name(before)),
    }
}

/// Why a pass runs in every frame, or does not.
fn changes(plan: &Plan, position: Handle<PlannedPass>) -> Vec<String> {
    if plan.passes.iter().all(|pass| pass.volatile) {
        return vec!["this plan keeps nothing: it runs, unless what it wrote happens to be there still".to_owned()];
    }
    if !plan.passes[position].volatile {
        return vec!["nothing that it depends on changes from frame to frame, so it runs once".to_owned()];
    }
    let sources = plan.sources(position).iter().flatten();
    let changing = sources.filter(|source| {
        let writer = plan.ports[**source].pass;
        writer.is_some_and(|writer| plan.passes[writer].volatile)
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

/// The passes that read one that does not run: they do not run either.
fn dead_readers(plan: &Plan, pass: Handle<Pass>) -> Vec<String> {
    let graph = &plan.graph;
    let read = graph.connections.iter().filter(|connection| connection.from.pass == pass);
    let words = read.map(|connection| {
        let is_on = graph.pass(connection.to.pass).enabled;
        let why = if is_on { "does not run either" } else { "is switched off" };
        format!("{}, which {why}", graph.port_name(connection.to))
    });
    let mut lines: Vec<String> = words.collect();
    if lines.is_empty() {
        lines.push("no pass".to_owned());
    }
    lines
}

fn parameters(graph: &Graph, pass: Handle<Pass>) -> Vec<String> {
    let of_pass = graph.pass(pass);
    let settings = of_pass.params.entries().zip(&of_pass.descriptor().params);
    settings
        .map(|((index, setting), param)| {
            let unit = if param.unit.is_empty() { String::new() } else { format!(" {}", param.unit) };
            let uses = |given: &&GraphParam| given.uses.contains(&ParamRef { pass, param: index });
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
