//! A plan as text: what runs, what does not and why, and what shares memory when.

use std::fmt::{self, Write};

use super::names::{asked_for, byte_words, culled_words, kind_words, readers};
use crate::descriptor::PortDescriptor;
use crate::handle::Handle;
use crate::plan::{Plan, PlannedPass, PlannedPort, SlotKind, Until};
use crate::signature::RoleKind;

/// Widest chart of lifetimes, in passes; beyond it they are given as numbers.
const WIDEST_CHART: usize = 120;

/// A plan as text, to be read and to be pinned in tests: equal plans give equal text.
pub fn text(plan: &Plan) -> String {
    let mut text = String::new();
    // Writing to a string cannot fail.
    let _ = write_plan(&mut text, plan);
    text
}

fn write_plan(text: &mut String, plan: &Plan) -> fmt::Result {
    let (runs, all) = (plan.passes.len(), plan.graph.passes.len());
    writeln!(text, "frame {}×{}, {runs} of {all} passes run", plan.size.0, plan.size.1)?;
    write_order(text, plan)?;
    write_culled(text, plan)?;
    write_memory(text, plan)?;
    write_standing(text, plan)?;
    write_bytes(text, plan)?;
    write_outputs(text, plan)
}

fn write_order(text: &mut String, plan: &Plan) -> fmt::Result {
    writeln!(text, "\norder")?;
    let name_width = widest(plan.passes.handles().map(|position| plan.pass_name(position)));
    let kind_width = widest(plan.passes.handles().map(|position| plan.descriptor(position).name.as_str()));
    let keeps = plan.passes.iter().any(|pass| !pass.volatile);
    for position in plan.passes.handles() {
        let (name, kind) = (plan.pass_name(position), &plan.descriptor(position).name);
        let once = if keeps && !plan.passes[position].volatile { "  (once)" } else { "" };
        let line = format!(
            "{:>4}  {name:name_width$}  {kind:kind_width$}  {}{once}",
            position.index() + 1,
            reads(plan, position)
        );
        writeln!(text, "{}", line.trim_end())?;
    }
    Ok(())
}

/// What a pass reads: ports, constants, history, copies.
fn reads(plan: &Plan, position: Handle<PlannedPass>) -> String {
    let descriptor = plan.descriptor(position);
    let signature = &plan.graph.wiring.passes.kind(plan.passes[position].pass).signature;
    let mut words = Vec::new();
    for (index, port) in descriptor.ports.entries() {
        let role = signature.ports[index].role;
        let source = plan.sources(position)[index].map(|source| plan.port_name(source));
        let slot = plan.bindings(position)[index].map(|slot| plan.slots[slot].kind);
        words.push(match (role, source, slot) {
            (RoleKind::Output, ..) => continue,
            (RoleKind::InOut, source, _) => {
                let source = source.unwrap_or_else(|| "a constant".to_owned());
                format!(
                    "{} {source} {}",
                    port.name,
                    if in_place(plan, position, index) { "in place" } else { "in a copy" }
                )
            }
            (RoleKind::History, _, Some(SlotKind::History { of, .. })) => {
                format!("{} ← {} of the frame before", port.name, plan.port_name(of))
            }
            (_, Some(source), _) => format!("{} ← {source}", port.name),
            (_, None, Some(kind)) => format!("{} = {}", port.name, kind_words(plan, kind)),
            (_, None, None) => continue,
        });
    }
    words.join(", ")
}

fn in_place(plan: &Plan, position: Handle<PlannedPass>, index: Handle<PortDescriptor>) -> bool {
    let mut written = plan.outputs_of(position).map(|port| &plan.ports[port]);
    written.any(|port| port.port.port == index && port.in_place)
}

fn write_culled(text: &mut String, plan: &Plan) -> fmt::Result {
    if plan.culled.is_empty() {
        return Ok(());
    }
    writeln!(text, "\nculled")?;
    let width = widest(plan.culled.iter().map(|culled| plan.graph.pass(culled.pass).name.as_str()));
    for culled in &plan.culled {
        writeln!(text, "      {:width$}  {}", plan.graph.pass(culled.pass).name, culled_words(plan, culled))?;
    }
    Ok(())
}

/// Slots that ports pass through, with a chart of who is where when.
fn write_memory(text: &mut String, plan: &Plan) -> fmt::Result {
    let readers = readers(plan);
    let shown = |kind: SlotKind| matches!(kind, SlotKind::Transient | SlotKind::Kept);
    let ports = plan.ports.iter().filter(|port| shown(plan.slots[port.slot].kind));
    let names: Vec<String> = ports.map(|port| plan.graph.port_name(port.port)).collect();
    let width = widest(names.iter().map(String::as_str));
    writeln!(text, "\nmemory  (● written, ○ read, ▶ to the end of the frame)")?;
    for (index, slot) in plan.slots.entries().filter(|(_, slot)| shown(slot.kind)) {
        let kept = if slot.kind == SlotKind::Kept { ", kept across frames" } else { "" };
        writeln!(text, "  slot {index}: {}, {}{kept}", slot.resource, byte_words(slot.resource.bytes()))?;
        for port in plan.ports_in(index) {
            let chart = chart(plan, &plan.ports[port], &readers[port]);
            writeln!(text, "      {:width$}  {chart}", plan.port_name(port))?;
        }
    }
    Ok(())
}

fn chart(plan: &Plan, port: &PlannedPort, readers: &[Handle<PlannedPass>]) -> String {
    if plan.passes.len() > WIDEST_CHART {
        let last = match port.until {
            Until::Pass(last) => (last.index() + 1).to_string(),
            Until::End => "end".to_owned(),
        };
        return format!("{} to {last}", port.pass.map_or(0, Handle::index) + 1);
    }
    let mark = |position| match position {
        _ if port.pass == Some(position) => '●',
        _ if readers.contains(&position) => '○',
        _ if port.pass < Some(position) && Until::Pass(position) <= port.until => '━',
        _ => '·',
    };
    let end = if port.until == Until::End { '▶' } else { ' ' };
    plan.passes.handles().map(mark).chain([end]).collect::<String>().trim_end().to_owned()
}

/// Constants and history.
fn write_standing(text: &mut String, plan: &Plan) -> fmt::Result {
    let standing = |kind: SlotKind| matches!(kind, SlotKind::Constant(_) | SlotKind::History { .. });
    if !plan.slots.iter().any(|slot| standing(slot.kind)) {
        return Ok(());
    }
    writeln!(text, "\nstanding")?;
    for (index, slot) in plan.slots.entries().filter(|(_, slot)| standing(slot.kind)) {
        let (kind, bytes) = (kind_words(plan, slot.kind), byte_words(slot.resource.bytes()));
        writeln!(text, "  slot {index}: {}, {bytes}: {kind}", slot.resource)?;
    }
    Ok(())
}

fn write_bytes(text: &mut String, plan: &Plan) -> fmt::Result {
    let bytes = &plan.bytes;
    writeln!(text, "\nbytes")?;
    writeln!(text, "  transient, shared    {:>12}  {}", bytes.shared, byte_words(bytes.shared))?;
    writeln!(text, "  transient, unshared  {:>12}  {}", bytes.unshared, byte_words(bytes.unshared))?;
    writeln!(text, "  this plan            {:>12}  {}", bytes.allocated, byte_words(bytes.allocated))?;
    let width = widest(
        bytes.classes.iter().map(|class| class.resource.to_string()).collect::<Vec<_>>().iter().map(String::as_str),
    );
    for class in &bytes.classes {
        let resource = class.resource.to_string();
        writeln!(text, "    {resource:width$}  {} for {}", counted(class.slots, "slot"), counted(class.ports, "port"))?;
    }
    Ok(())
}

fn write_outputs(text: &mut String, plan: &Plan) -> fmt::Result {
    writeln!(text, "\nasked for: {}", asked_for(plan))?;
    let width = widest(plan.outputs.iter().map(|(name, _)| name.as_str()));
    for (name, port) in &plan.outputs {
        writeln!(text, "  {name:width$}  {}  {}", plan.port_name(*port), plan.resource(*port))?;
    }
    Ok(())
}

pub(crate) fn counted(number: u32, what: &str) -> String {
    if number == 1 { format!("1 {what}") } else { format!("{number} {what}s") }
}

fn widest<'a>(names: impl Iterator<Item = &'a str>) -> usize {
    names.map(|name| name.chars().count()).max().unwrap_or(0)
}
