//! What flows through a port, why, and where it is held.

use super::Report;
use super::sizes::size_lines;
use crate::descriptor::{PortDescriptor, PortKind};
use crate::graph::PortRef;
use crate::handle::Handle;
use crate::plan::{Plan, PlannedPass, PlannedPort, Resource, SlotKind, Until};
use crate::show::{byte_words, culled_words, readers, value_words};
use crate::signature::RoleKind;
use crate::wiring::Feed;

/// Explains a port of any pass, inputs too.
pub(super) fn explain(plan: &Plan, port: PortRef) -> String {
    let graph = &plan.graph;
    let descriptor = graph.port(port);
    let role = graph.signature(port).role;
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
        && let Some(slot) = plan.bindings(position)[port.port]
    {
        let of_slot = &plan.slots[slot];
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
    let wiring = &plan.graph.wiring;
    if wiring.enabled[port.pass] || !plan.graph.port(port).role.is_output() {
        return;
    }
    match wiring.feeds[wiring.passes.port(port)] {
        Feed::Port(source) => {
            report.line("instead", &format!("{} is passed on", plan.graph.port_name(wiring.passes.port_ref(source))));
        }
        Feed::Constant(constant) => {
            let value = wiring.passes.signature(constant).constant;
            report.line("instead", &format!("{} is its output", value_words(value)));
        }
        Feed::Nothing => {}
    }
}

fn fed_by(plan: &Plan, position: Handle<PlannedPass>, port: PortRef, role: RoleKind) -> String {
    let source = plan.sources(position)[port.port];
    let slot = plan.bindings(position)[port.port].map(|slot| plan.slots[slot].kind);
    match (source, slot) {
        (Some(source), _) if role == RoleKind::InOut => {
            format!("{}, changed {}", plan.port_name(source), in_place_words(plan, port, source))
        }
        (Some(source), _) => plan.port_name(source),
        (None, Some(SlotKind::History { of, first })) => {
            format!("what {} held in the frame before, {} in the first", plan.port_name(of), value_words(first))
        }
        (None, Some(SlotKind::Constant(value))) => {
            let number = plan.graph.wiring.passes.port(port);
            let own = plan.graph.wiring.feeds[number] == Feed::Constant(number);
            let why = if own { "nothing is connected" } else { "the pass that would feed it is switched off" };
            format!("the constant {}: {why}", value_words(value))
        }
        (None, _) => "nothing".to_owned(),
    }
}

/// In place, or in a copy and why.
fn in_place_words(plan: &Plan, port: PortRef, source: Handle<PlannedPort>) -> String {
    let Some(planned) = plan.planned(port).map(|planned| &plan.ports[planned]) else { return String::new() };
    if planned.in_place {
        return "in place: nothing reads the old version any more".to_owned();
    }
    let old = &plan.ports[source];
    let later: Vec<&str> = readers(plan)[source]
        .iter()
        .filter(|reader| Some(**reader) > planned.pass)
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
    let of_port = plan.graph.signature(port);
    let kind = &plan.graph.pass(port.pass).descriptor().name;
    let resource = resource(plan, port);
    let like = of_port.like.map(|like| &plan.graph.port(PortRef { port: like, ..port }).name);
    let why = match (of_port.role, like) {
        (RoleKind::Output, Some(like)) => format!("that of `{like}`, because {kind} writes what it reads"),
        (RoleKind::Output, None) => format!("declared by {kind}"),
        _ => "that of its input".to_owned(),
    };
    match resource {
        Some(Resource::Texture { format, .. }) => format!("{format}, {why}"),
        Some(Resource::Buffer { stride, .. }) => format!("elements of {stride} bytes, {why}"),
        None => why,
    }
}

fn resource(plan: &Plan, port: PortRef) -> Option<Resource> {
    if let Some(position) = plan.position(port.pass) {
        let slot = plan.bindings(position)[port.port]?;
        return Some(plan.slots[slot].resource);
    }
    plan.planned(port).map(|planned| *plan.resource(planned))
}

/// The slot of a port, the others in it, and the port's lifetime.
fn storage(plan: &Plan, planned: Handle<PlannedPort>, report: &mut Report) {
    let port = &plan.ports[planned];
    let slot = &plan.slots[port.slot];
    let bytes = byte_words(slot.resource.bytes());
    report.line("storage", &format!("slot {}: {}, {bytes}", port.slot, slot.resource));
    report.line("lifetime", &lifetime(plan, planned));
    report.line("sharing", &sharing(plan, planned));
}

fn lifetime(plan: &Plan, planned: Handle<PlannedPort>) -> String {
    let port = &plan.ports[planned];
    let Some(writer) = port.pass else { return "always: it is a constant".to_owned() };
    let readers = &readers(plan)[planned];
    let names: Vec<String> =
        readers.iter().map(|reader| format!("{} at {}", plan.pass_name(*reader), reader.index() + 1)).collect();
    let read = if names.is_empty() { "read by no pass".to_owned() } else { format!("read by {}", names.join(", ")) };
    let end = match port {
        PlannedPort { root: true, .. } => "; it stays to the end of the frame, because it was asked for",
        PlannedPort { carried: true, .. } => "; it stays to the end of the frame, to be carried to the next",
        _ => "",
    };
    format!("written at {}, {read}{end}", writer.index() + 1)
}

fn sharing(plan: &Plan, planned: Handle<PlannedPort>) -> String {
    let port = &plan.ports[planned];
    let others: Vec<Handle<PlannedPort>> = plan.ports_in(port.slot).filter(|other| *other != planned).collect();
    if others.is_empty() {
        return alone(plan, port);
    }
    let words = others.iter().map(|other| {
        let PlannedPort { pass, until, .. } = &plan.ports[*other];
        let last = match until {
            Until::Pass(last) => (last.index() + 1).to_string(),
            Until::End => "the end".to_owned(),
        };
        let first = pass.map_or(0, Handle::index) + 1;
        format!("{} ({first} to {last})", plan.port_name(*other))
    });
    format!("the slot holds at other times {}", words.collect::<Vec<_>>().join(", "))
}

/// Why a port has its slot for itself.
fn alone(plan: &Plan, port: &PlannedPort) -> String {
    let slot = &plan.slots[port.slot];
    if slot.kind == SlotKind::Kept {
        return "none: its content is kept across frames".to_owned();
    }
    let equal = |other: &&PlannedPort| plan.slots[other.slot].resource == slot.resource && other.port != port.port;
    let equals = plan.ports.iter().filter(equal).count();
    match equals {
        0 => format!("none: no other port is {}", slot.resource),
        _ => {
            let overlap = plan
                .ports
                .iter()
                .filter(equal)
                .all(|other| other.is_written_before_the_end_of(port) && port.is_written_before_the_end_of(other));
            match overlap {
                true => format!("none: all {equals} other ports of the same resource are alive at the same time"),
                false => format!("none: the other ports of the same resource ({equals}) found room in other slots"),
            }
        }
    }
}
