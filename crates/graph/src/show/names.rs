//! Words that several views of a plan share.

use crate::handle::{Handle, Table};
use crate::plan::{CullReason, Culled, Plan, PlannedPass, PlannedPort, SlotKind};

/// `1.5 MiB`, exact below 1 KiB.
pub fn byte_words(bytes: u64) -> String {
    let units = ["KiB", "MiB", "GiB", "TiB", "PiB", "EiB"];
    if bytes < 1024 {
        return format!("{bytes} B");
    }
    let mut value = bytes as f64 / 1024.0;
    let mut unit = 0;
    while value >= 1023.95 && unit + 1 < units.len() {
        value /= 1024.0;
        unit += 1;
    }
    format!("{value:.1} {}", units[unit])
}

/// Why a pass does not run: a sentence without its name.
pub fn culled_words(plan: &Plan, culled: &Culled) -> String {
    let pass = plan.graph.pass(culled.pass);
    match (culled.reason, &pass.switch) {
        (CullReason::Off, Some(param)) => format!("switched off by ${param}"),
        (CullReason::Off, None) => "switched off".to_owned(),
        (CullReason::Unread, _) => {
            let ports: Vec<&str> = pass.descriptor().outputs().map(|port| port.name.as_str()).collect();
            match ports.is_empty() {
                true => "it writes nothing".to_owned(),
                false => format!(
                    "nothing that was asked for ({}) reads any of its ports: {}",
                    asked_for(plan),
                    ports.join(", ")
                ),
            }
        }
    }
}

/// The roots by name: outputs as the graph names them, other ports as `pass.port`.
pub(crate) fn asked_for(plan: &Plan) -> String {
    const MOST: usize = 8;
    let mut names: Vec<String> = plan.outputs.iter().map(|(name, _)| name.clone()).collect();
    let is_output = |root: &&Handle<PlannedPort>| plan.outputs.iter().any(|(_, port)| port == *root);
    names.extend(plan.roots.iter().filter(|root| !is_output(root)).take(MOST).map(|root| plan.port_name(*root)));
    let left = names.len().saturating_sub(MOST);
    names.truncate(MOST);
    match (names.is_empty(), left) {
        (true, _) => "nothing".to_owned(),
        (_, 0) => names.join(", "),
        _ => format!("{}, and {left} more", names.join(", ")),
    }
}

/// What a slot is for.
pub(crate) fn kind_words(plan: &Plan, kind: SlotKind) -> String {
    match kind {
        SlotKind::Transient => "transient".to_owned(),
        SlotKind::Kept => "kept across frames".to_owned(),
        SlotKind::Constant(value) => format!("constant {}", value_words(value)),
        SlotKind::History { of, first } => {
            format!("{} of the frame before, {} in the first", plan.port_name(of), value_words(first))
        }
    }
}

/// `0` where all four are equal, else `(0, 0, 0, 1)`.
pub(crate) fn value_words(value: [f32; 4]) -> String {
    if value.iter().all(|part| part.to_bits() == value[0].to_bits()) {
        return value[0].to_string();
    }
    let parts: Vec<String> = value.iter().map(ToString::to_string).collect();
    format!("({})", parts.join(", "))
}

/// Positions of the passes that read each port in this frame, in order, each once.
pub(crate) fn readers(plan: &Plan) -> Table<PlannedPort, Vec<Handle<PlannedPass>>> {
    let mut readers = plan.ports.column(Vec::new());
    for position in plan.passes.handles() {
        for source in plan.sources(position).iter().flatten() {
            let readers: &mut Vec<Handle<PlannedPass>> = &mut readers[*source];
            if readers.last() != Some(&position) {
                readers.push(position);
            }
        }
    }
    readers
}
