//! A plan as data.

use serde_json::{Value, json};

use super::names::culled_words;
use crate::handle::Handle;
use crate::plan::{CullReason, Plan, PlannedPass, PlannedPort, Resource, Slot, SlotKind, Step, Until};

/// A plan as JSON: everything in the text, with the plan's indices.
pub fn json(plan: &Plan) -> String {
    let value = json!({
        "size": [plan.size.0, plan.size.1],
        "passes": plan.passes.handles().map(|position| pass(plan, position)).collect::<Vec<_>>(),
        "ports": plan.ports.handles().map(|index| port(plan, index)).collect::<Vec<_>>(),
        "slots": plan.slots.handles().map(|index| slot(plan, index)).collect::<Vec<_>>(),
        "steps": plan.steps.iter().map(|step| self::step(*step)).collect::<Vec<_>>(),
        "outputs": plan.outputs.iter().map(|(name, port)| json!({ "name": name, "port": plan.port_name(*port) })).collect::<Vec<_>>(),
        "culled": plan.culled.iter().map(|culled| json!({
            "pass": plan.graph.pass(culled.pass).name,
            "reason": if culled.reason == CullReason::Off { "off" } else { "unread" },
            "why": culled_words(plan, culled),
        })).collect::<Vec<_>>(),
        "bytes": bytes(plan),
    });
    format!("{value:#}\n")
}

fn pass(plan: &Plan, position: Handle<PlannedPass>) -> Value {
    let descriptor = plan.descriptor(position);
    let names = descriptor.ports.iter().map(|port| &port.name);
    let bindings: Vec<Value> = names
        .zip(plan.bindings(position).iter().zip(plan.sources(position)))
        .map(|(name, (slot, source))| json!({ "port": name, "slot": slot.map(Handle::index), "source": source.map(|port| plan.port_name(port)) }))
        .collect();
    let volatile = plan.passes[position].volatile;
    json!({ "name": plan.pass_name(position), "use": descriptor.name, "volatile": volatile, "bindings": bindings })
}

fn port(plan: &Plan, index: Handle<PlannedPort>) -> Value {
    let port: PlannedPort = plan.ports[index];
    let last = match port.until {
        Until::Pass(position) => position.index(),
        Until::End => plan.passes.len(),
    };
    json!({
        "name": plan.port_name(index),
        "pass": port.pass.map(Handle::index),
        "slot": port.slot.index(),
        "class": port.class.to_string(),
        "lifetime": [port.pass.map_or(0, Handle::index), last],
        "root": port.root,
        "kept": port.kept,
        "in_place": port.in_place,
    })
}

fn slot(plan: &Plan, index: Handle<Slot>) -> Value {
    let slot = &plan.slots[index];
    let kind = match slot.kind {
        SlotKind::Transient => json!({ "kind": "transient" }),
        SlotKind::Kept => json!({ "kind": "kept" }),
        SlotKind::Constant(value) => json!({ "kind": "constant", "value": value }),
        SlotKind::History { of, first } => json!({ "kind": "history", "of": plan.port_name(of), "first": first }),
    };
    let ports: Vec<String> = plan.ports_in(index).map(|port| plan.port_name(port)).collect();
    json!({
        "resource": resource(slot.resource),
        "holds": kind,
        "bytes": slot.resource.bytes(),
        "ports": ports,
    })
}

fn resource(resource: Resource) -> Value {
    match resource {
        Resource::Texture { dimension, format, width, height, depth_or_layers } => json!({
            "dimension": dimension.to_string(), "format": format.wgsl(), "size": [width, height, depth_or_layers],
        }),
        Resource::Buffer { bytes, stride } => json!({ "bytes": bytes, "stride": stride }),
    }
}

fn step(step: Step) -> Value {
    match step {
        Step::Run { pass } => json!({ "run": pass.index() }),
        Step::Copy { pass, from, to } => json!({ "copy": [from.index(), to.index()], "for": pass.index() }),
        Step::Carry { from, to } => json!({ "carry": [from.index(), to.index()] }),
    }
}

fn bytes(plan: &Plan) -> Value {
    let bytes = &plan.bytes;
    let class = |class: &crate::plan::ClassBytes| json!({ "resource": resource(class.resource), "ports": class.ports, "slots": class.slots });
    json!({
        "shared": bytes.shared,
        "unshared": bytes.unshared,
        "allocated": bytes.allocated,
        "kept": bytes.kept,
        "constant": bytes.constant,
        "classes": bytes.classes.iter().map(class).collect::<Vec<_>>(),
    })
}
