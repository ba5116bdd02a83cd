//! Ports that a test does not look at: a report shows them all the same.

use tyndall_graph::{Plan, PortRef};

use crate::file::Tapped;
use crate::options::Options;
use crate::outcome::UncheckedPort;
use crate::run::Ready;
use crate::session::Rendered;

/// Every port that a plan's passes write.
pub(crate) fn written(plan: &Plan) -> Vec<PortRef> {
    plan.ports.iter().filter(|port| port.pass.is_some()).map(|port| port.port).collect()
}

/// Takes what the test says nothing of out of what was rendered, so that all that follows is as without a report; gives
/// pictures of the ports that nobody wants to know of.
pub(crate) fn take(ready: &Ready, options: &Options, rendered: &mut Rendered) -> Vec<UncheckedPort> {
    let graph = &ready.loaded.graph;
    let is_wanted = |port: &PortRef| {
        let is_it = |tapped: &Tapped| tapped.port == *port && ready.chosen.contains(&tapped.name);
        options.looks_at(rendered.frame) && ready.tapped.iter().any(is_it)
    };
    let ports = rendered.ports.keys().filter(|port| !is_wanted(port));
    let unchecked = ports.filter_map(|port| {
        Some(UncheckedPort {
            name: graph.port_name(*port),
            pass: graph.pass(port.pass).name.clone(),
            frame: rendered.frame,
            picture: rendered.picture(&ready.plan, *port)?.thinned(),
        })
    });
    let unchecked = unchecked.collect();
    let needed = ready.ports();
    rendered.ports.retain(|port, _| needed.contains(port));
    unchecked
}
