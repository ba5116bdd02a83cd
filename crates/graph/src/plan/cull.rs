//! Which passes run: those on which something requested depends.

use crate::graph::{Graph, Pass, PortRef};
use crate::handle::{Handle, Table};
use crate::wiring::{Feed, Wiring};

use super::{CullReason, Culled, PlanOptions, Roots};

/// The ports that were requested, as the file names them.
pub(super) fn roots(graph: &Graph, options: &PlanOptions) -> Vec<PortRef> {
    let outputs = graph.outputs.iter().map(|(_, port)| *port);
    let is_on = |port: &PortRef| graph.wiring.enabled[port.pass];
    let mut roots: Vec<PortRef> = match &options.roots {
        Roots::Outputs => outputs.collect(),
        Roots::All => graph.written_ports().filter(is_on).chain(outputs).collect(),
        Roots::Ports(ports) => ports.clone(),
    };
    roots.extend_from_slice(&options.taps);
    roots
}

/// Whether each pass runs.
pub(super) fn needed(wiring: &Wiring, roots: &[PortRef]) -> Table<Pass, bool> {
    let mut needed = wiring.enabled.column(false);
    let mut stack: Vec<Handle<Pass>> = Vec::new();
    let mut want = |pass: Handle<Pass>, stack: &mut Vec<Handle<Pass>>| {
        if !std::mem::replace(&mut needed[pass], true) {
            stack.push(pass);
        }
    };
    let writer = |feed: Feed| feed.as_port().map(|port| wiring.passes.pass_of[port]);
    let asked = roots.iter().filter_map(|root| writer(wiring.out_of(wiring.passes.port(*root))));
    let acts: Table<_, bool> = wiring.passes.kinds.iter().map(|kind| kind.descriptor.side_effect).collect();
    let acting = wiring.passes.kind_of.entries().filter(|(pass, kind)| acts[**kind] && wiring.enabled[*pass]);
    for pass in asked.chain(acting.map(|(pass, _)| pass)) {
        want(pass, &mut stack);
    }
    while let Some(pass) = stack.pop() {
        for port in wiring.passes.ports[pass].handles() {
            if let Some(pass) = writer(wiring.feeds[port]) {
                want(pass, &mut stack);
            }
        }
    }
    needed
}

/// The passes that do not run, and why.
pub(super) fn culled(wiring: &Wiring, needed: &Table<Pass, bool>) -> Vec<Culled> {
    let not_needed = needed.entries().filter(|(_, needed)| !**needed).map(|(pass, _)| pass);
    let reason = |pass| if wiring.enabled[pass] { CullReason::Unread } else { CullReason::Off };
    not_needed.map(|pass| Culled { pass, reason: reason(pass) }).collect()
}
