//! From a graph to its plan, by handles alone, in time linear in ports and connections.

use std::sync::Arc;

use tyndall_document::Diagnostic;

use super::cull::{culled, needed, roots};
use super::lifetimes::Draft;
use super::order::order;
use super::sizes::sizes;
use super::slots::{Assignment, Policy, assign};
use super::{Bytes, Keep, Plan, PlanOptions, SlotKind};
use crate::graph::Graph;
use crate::validate::size_mistakes;

/// Plans a graph.
///
/// # Errors
/// Mistakes that depend on the size of the frame: an input demands another size than that of its port (`wrong-size`).
pub fn plan(graph: &Arc<Graph>, options: &PlanOptions) -> Result<Plan, Vec<Diagnostic>> {
    let wiring = &graph.wiring;
    let (sizes, problems) = sizes(graph, &wiring.feeds, options.size);
    if !problems.is_empty() {
        return Err(size_mistakes(graph, &problems));
    }
    let roots = roots(graph, options);
    let needed = needed(wiring, &roots);
    let order = order(wiring, &needed, options.order);
    let mut draft = Draft::new(wiring, &order, &needed, &roots);
    draft.keep(graph, &options.keep);
    let keep = matches!(options.keep, Keep::Edges { .. });
    let plain = (!options.share || keep).then(|| assign(wiring, &sizes, &draft, Policy { share: true, keep: false }));
    let chosen = assign(wiring, &sizes, &draft, Policy { share: options.share, keep });
    let bytes = bytes(&chosen, plain.as_ref().unwrap_or(&chosen));
    let mut plan = Plan {
        graph: graph.clone(),
        size: options.size,
        passes: draft.passes,
        ports: chosen.ports,
        slots: chosen.slots,
        steps: chosen.steps,
        outputs: Vec::new(),
        roots: draft.roots,
        culled: culled(wiring, &needed),
        bytes,
        bindings: chosen.bindings,
        planned: draft.planned,
        positions: draft.positions,
    };
    let asked_for = |port| plan.planned(port).filter(|port| plan.ports[*port].root);
    let outputs = graph.outputs.iter();
    plan.outputs = outputs.filter_map(|(name, port)| Some((name.clone(), asked_for(*port)?))).collect();
    Ok(plan)
}

fn bytes(chosen: &Assignment, plain: &Assignment) -> Bytes {
    let mut bytes = Bytes { classes: plain.classes.clone(), ..Bytes::default() };
    for class in &bytes.classes {
        let each = class.resource.bytes();
        bytes.shared = bytes.shared.saturating_add(each.saturating_mul(u64::from(class.slots)));
        bytes.unshared = bytes.unshared.saturating_add(each.saturating_mul(u64::from(class.ports)));
    }
    for slot in &chosen.slots {
        let each = slot.resource.bytes();
        bytes.allocated = bytes.allocated.saturating_add(each);
        match slot.kind {
            SlotKind::Transient => {}
            SlotKind::Kept | SlotKind::History { .. } => bytes.kept = bytes.kept.saturating_add(each),
            SlotKind::Constant(_) => bytes.constant = bytes.constant.saturating_add(each),
        }
    }
    bytes
}
