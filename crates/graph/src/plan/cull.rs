//! Which passes run: those that something asked for depends on.

use crate::graph::{Graph, PortRef};
use crate::table::{Feed, Table};

use super::{CullReason, Culled, PlanOptions, Roots};

/// The ports that were asked for, as the file names them.
pub(super) fn roots(graph: &Graph, options: &PlanOptions) -> Vec<PortRef> {
    let outputs = graph.outputs.iter().map(|(_, port)| *port);
    let mut roots: Vec<PortRef> = match &options.roots {
        Roots::Outputs => outputs.collect(),
        Roots::All => every_port(&graph.table).chain(outputs).collect(),
        Roots::Ports(ports) => ports.clone(),
    };
    roots.extend_from_slice(&options.taps);
    roots
}

/// Every port that a pass writes which is switched on.
fn every_port(table: &Table) -> impl Iterator<Item = PortRef> + '_ {
    let enabled = (0..table.passes()).filter(|pass| table.enabled[*pass as usize]);
    enabled.flat_map(|pass| {
        let ports = table.kind(pass).signature.ports.iter().enumerate();
        let written = ports.filter(|(_, port)| port.role.is_output());
        written.map(move |(port, _)| PortRef { pass, port: port as u32 })
    })
}

/// By pass: whether it runs.
pub(super) fn needed(table: &Table, roots: &[PortRef]) -> Vec<bool> {
    let mut needed = vec![false; table.passes() as usize];
    let mut stack: Vec<u32> = Vec::new();
    let mut want = |pass: u32, stack: &mut Vec<u32>| {
        if !std::mem::replace(&mut needed[pass as usize], true) {
            stack.push(pass);
        }
    };
    let source = |feed: Feed| feed.as_port().map(|port| table.pass_of[port as usize]);
    let asked = roots.iter().filter_map(|root| source(table.out_of(table.port(root.pass, root.port))));
    let effects: Vec<bool> = table.kinds.iter().map(|kind| kind.descriptor.side_effect).collect();
    let acting = (0..table.passes())
        .filter(|pass| effects[table.kind_of[*pass as usize] as usize] && table.enabled[*pass as usize]);
    for pass in asked.chain(acting) {
        want(pass, &mut stack);
    }
    while let Some(pass) = stack.pop() {
        for port in table.ports(pass) {
            if let Some(pass) = source(table.feeds[port as usize]) {
                want(pass, &mut stack);
            }
        }
    }
    needed
}

/// The passes that do not run, and why.
pub(super) fn culled(table: &Table, needed: &[bool]) -> Vec<Culled> {
    let not_needed = (0..table.passes()).filter(|pass| !needed[*pass as usize]);
    let reason = |pass: u32| if table.enabled[pass as usize] { CullReason::Unread } else { CullReason::Off };
    not_needed.map(|pass| Culled { pass, reason: reason(pass) }).collect()
}
