//! What flows through a port, why, and where it is held.

use super::Report;
use super::sizes::size_lines;
use crate::descriptor::{PortDescriptor, PortKind};
use crate::graph::PortRef;
use crate::plan::{Plan, PlannedPort, Resource, SlotKind};
use crate::show::{byte_words, culled_words, readers, value_words};
use crate::signature::RoleKind;

/// Explains a port of any pass, inputs too.
pub(super) fn explain(plan: &Plan, port: PortRef) -> String {
    let graph = &plan.graph;
    let descriptor = graph.port(port);
    let role = graph.table.kind(port.pass).signature.ports[port.port as usize].role;
    let mut report = Report::new(format!("`{}`: {}", graph.port_name(port), about(descriptor)));
    match plan.position(port.pass) {
        None => not_running(plan, port, &mut report),
        Some(position) if role.is_input() => {
            report.line("fed by", &fed_by(plan, position, port, role));
        }
        Some(_) => {}
    }
    report.lines("size", &size_lines(plan, port));
    report.line("format", &format(plan, port));
    if let Some(planned) = plan.planned(port).filter(|_| role.is_output()) {
        storage(plan, planned, &mut report);
    } else if let Some(position) = plan.position(port.pass)
        && let Some(slot) = plan.bindings(position)[port.port as usize]
    {
        let of_slot = &plan.slots[slot as usize];
        report.line("storage", &format!("slot {slot}: {}, {}", of_slot.resource, byte_words(of_slot.resource.bytes())));
    }
    report.text
}

fn about(descriptor: &PortDescriptor) -> String {
    let kind = match &descriptor.kind {
        PortKind::Texture { dimension, class, .. } => format!("a {dimension} texture of class {class}"),
        PortKind::Buffer { element, stride } => format!("a buffer of `{element}`, {stride} bytes each"),
        PortKind::Value { element, bytes } => format!("a value `{element}` of {bytes} bytes"),
    };
    let unit = if descriptor.unit.is_empty() { String::new() } else { format!(" in {}", descriptor.unit) };
    let about = if descriptor.about.is_empty() { String::new() } else { format!(". {}", descriptor.about) };
    format!("{kind}{unit}{about}")
}

fn not_running(plan: &Plan, port: PortRef, report: &mut Report) {
    let culled = plan.culled.iter().find(|culled| culled.pass == port.pass);
    report.line("culled", &culled.map(|culled| culled_words(plan, culled)).unwrap_or_default());
    let table = &plan.graph.table;
    let number = table.port(port.pass, port.port);
    if table.enabled[port.pass as usize] || !plan.graph.port(port).role.is_output() {
        return;
    }
    let feed = table.feeds[number as usize];
    if let Some(source) = feed.as_port() {
        let source = port_of(plan, source);
        report.line("instead", &format!("{} flows on", plan.graph.port_name(source)));
    } else if let Some(constant) = feed.as_constant() {
        let PortRef { pass, port } = port_of(plan, constant);
        let value = table.kind(pass).signature.ports[port as usize].constant;
        report.line("instead", &format!("{} flows out of it", value_words(value)));
    }
}

/// A port by its number.
pub(super) fn port_of(plan: &Plan, number: u32) -> PortRef {
    let table = &plan.graph.table;
    let pass = table.pass_of[number as usize];
    PortRef { pass, port: number - table.first_port[pass as usize] }
}

fn fed_by(plan: &Plan, position: u32, port: PortRef, role: RoleKind) -> String {
    let source = plan.sources(position)[port.port as usize];
    let slot = plan.bindings(position)[port.port as usize].map(|slot| plan.slots[slot as usize].kind);
    match (source, slot) {
        (Some(source), _) if role == RoleKind::InOut => {
            format!("{}, changed {}", plan.port_name(source), in_place_words(plan, port, source))
        }
        (Some(source), _) => plan.port_name(source),
        (None, Some(SlotKind::History { of, first })) => {
            format!("what {} held in the frame before, {} in the first", plan.port_name(of), value_words(first))
        }
        (None, Some(SlotKind::Constant(value))) => {
            let fed = plan.graph.table.feeds[plan.graph.table.port(port.pass, port.port) as usize].as_constant();
            let own = fed == Some(plan.graph.table.port(port.pass, port.port));
            let why = if own { "nothing is connected" } else { "the pass that would feed it is switched off" };
            format!("the constant {}: {why}", value_words(value))
        }
        (None, _) => "nothing".to_owned(),
    }
}

/// In place, or in a copy and why.
fn in_place_words(plan: &Plan, port: PortRef, source: u32) -> String {
    let Some(planned) = plan.planned(port).map(|planned| &plan.ports[planned as usize]) else { return String::new() };
    if planned.in_place {
        return "in place: nothing reads the old version any more".to_owned();
    }
    let old = &plan.ports[source as usize];
    let position = planned.pass.unwrap_or(0);
    let later: Vec<&str> = readers(plan)[source as usize]
        .iter()
        .filter(|reader| **reader > position)
        .map(|reader| plan.pass_name(*reader))
        .collect();
    let why = match old {
        PlannedPort { root: true, .. } => "the old version was asked for".to_owned(),
        PlannedPort { carried: true, .. } => "the old version is carried to the next frame".to_owned(),
        PlannedPort { kept: true, .. } => "the old version is kept".to_owned(),
        _ if !later.is_empty() => format!("the old version is still read by {}", later.join(", ")),
        _ => "sharing is off, or the pass reads the old version as well".to_owned(),
    };
    format!("in a copy: {why}")
}

fn format(plan: &Plan, port: PortRef) -> String {
    let table = &plan.graph.table;
    let of_port = &table.kind(port.pass).signature.ports[port.port as usize];
    let kind = &plan.graph.pass(port.pass).descriptor().name;
    let resource = resource(plan, port);
    let like = of_port.like.map(|like| &plan.graph.pass(port.pass).descriptor().ports[like as usize].name);
    let why = match (of_port.role, like) {
        (RoleKind::Output, Some(like)) => format!("that of `{like}`, for {kind} writes what it reads"),
        (RoleKind::Output, None) => format!("declared by {kind}"),
        _ => "that of what flows in".to_owned(),
    };
    match resource {
        Some(Resource::Texture { format, .. }) => format!("{format}, {why}"),
        Some(Resource::Buffer { stride, .. }) => format!("elements of {stride} bytes, {why}"),
        None => why,
    }
}

fn resource(plan: &Plan, port: PortRef) -> Option<Resource> {
    if let Some(position) = plan.position(port.pass) {
        let slot = plan.bindings(position)[port.port as usize]?;
        return Some(plan.slots[slot as usize].resource);
    }
    plan.planned(port).map(|planned| *plan.resource(planned))
}

/// The slot of a port, who else is in it, and for how long the port is.
fn storage(plan: &Plan, planned: u32, report: &mut Report) {
    let port = &plan.ports[planned as usize];
    let slot = &plan.slots[port.slot as usize];
    let bytes = byte_words(slot.resource.bytes());
    report.line("storage", &format!("slot {}: {}, {bytes}, {}", port.slot, slot.resource, slot.usages));
    report.line("lifetime", &lifetime(plan, planned));
    report.line("sharing", &sharing(plan, planned));
}

fn lifetime(plan: &Plan, planned: u32) -> String {
    let port = &plan.ports[planned as usize];
    let Some(writer) = port.pass else { return "always: it is a constant".to_owned() };
    let readers = &readers(plan)[planned as usize];
    let names: Vec<String> =
        readers.iter().map(|reader| format!("{} at {}", plan.pass_name(*reader), reader + 1)).collect();
    let read = if names.is_empty() { "read by no pass".to_owned() } else { format!("read by {}", names.join(", ")) };
    let end = match port {
        PlannedPort { root: true, .. } => "; it stays to the end of the frame, because it was asked for",
        PlannedPort { carried: true, .. } => "; it stays to the end of the frame, to be carried to the next",
        _ => "",
    };
    format!("written at {}, {read}{end}", writer + 1)
}

fn sharing(plan: &Plan, planned: u32) -> String {
    let port = &plan.ports[planned as usize];
    let others: Vec<u32> = plan.ports_in(port.slot).filter(|other| *other != planned).collect();
    if others.is_empty() {
        return alone(plan, port);
    }
    let words = others.iter().map(|other| {
        let (first, last) = plan.ports[*other as usize].lifetime;
        let last = if last as usize == plan.passes.len() { "the end".to_owned() } else { (last + 1).to_string() };
        format!("{} ({} to {last})", plan.port_name(*other), first + 1)
    });
    format!("the slot holds at other times {}", words.collect::<Vec<_>>().join(", "))
}

/// Why a port has its slot for itself.
fn alone(plan: &Plan, port: &PlannedPort) -> String {
    let slot = &plan.slots[port.slot as usize];
    if slot.kind == SlotKind::Kept {
        return "none: its content is kept across frames".to_owned();
    }
    let equal =
        |other: &&PlannedPort| plan.slots[other.slot as usize].resource == slot.resource && other.port != port.port;
    let equals = plan.ports.iter().filter(equal).count();
    match equals {
        0 => format!("none: no other port is {}", slot.resource),
        _ => {
            let overlap = plan
                .ports
                .iter()
                .filter(equal)
                .all(|other| other.lifetime.0 <= port.lifetime.1 && port.lifetime.0 <= other.lifetime.1);
            match overlap {
                true => format!("none: all {equals} other ports of the same resource are alive at the same time"),
                false => format!("none: the other ports of the same resource ({equals}) found room in other slots"),
            }
        }
    }
}
