//! The lifetime of each port, and which results outlive a frame.

use super::{Keep, PlannedPass, PlannedPort, Until};
use crate::descriptor::Class;
use crate::graph::{Graph, ParamSetting, Pass, PortRef};
use crate::handle::{Handle, Table};
use crate::wiring::{GraphPort, Wiring};

/// Passes at their positions and their ports with lifetimes, before any of them has a slot.
pub(super) struct Draft {
    pub passes: Table<PlannedPass>,
    pub ports: Table<PlannedPort, DraftPort>,
    pub planned: Table<GraphPort, Option<Handle<PlannedPort>>>,
    pub positions: Table<Pass, Option<Handle<PlannedPass>>>,
    /// The ports that were requested, sorted.
    pub roots: Vec<Handle<PlannedPort>>,
}

/// A [`PlannedPort`] without a slot.
#[derive(Debug, Clone, Copy)]
pub(super) struct DraftPort {
    pub pass: Option<Handle<PlannedPass>>,
    pub port: PortRef,
    pub class: Class,
    pub until: Until,
    pub root: bool,
    pub kept: bool,
    pub carried: bool,
}

impl Draft {
    /// Numbers the ports of the passes of an order, and finds who reads each last.
    pub fn new(wiring: &Wiring, order: &[Handle<Pass>], needed: &Table<Pass, bool>, roots: &[PortRef]) -> Self {
        let mut draft = Self {
            passes: Table::with_capacity(order.len()),
            ports: Table::with_capacity(2 * order.len()),
            planned: wiring.passes.pass_of.column(None),
            positions: wiring.passes.kind_of.column(None),
            roots: Vec::with_capacity(roots.len()),
        };
        for pass in order {
            draft.pass(wiring, *pass);
        }
        for port in wiring.history.iter().filter(|port| needed[wiring.passes.pass_of[**port]]) {
            if let Some(source) = draft.source(wiring, *port) {
                let source = &mut draft.ports[source];
                source.until = Until::End;
                source.carried = true;
            }
        }
        for root in roots {
            draft.root(wiring, *root);
        }
        draft.roots.sort_unstable();
        draft.roots.dedup();
        draft
    }

    /// Adds a pass at the next position.
    fn pass(&mut self, wiring: &Wiring, pass: Handle<Pass>) {
        let (position, first) = (self.passes.next_handle(), self.ports.next_handle());
        let ports = wiring.passes.ports[pass];
        for (port, signature) in wiring.passes.kind(pass).signature.ports.entries() {
            let number = ports.at(port);
            if signature.role.reads_this_frame()
                && let Some(source) = self.source(wiring, number)
            {
                self.ports[source].until = Until::Pass(position);
            }
            if signature.role.is_output() {
                let written = DraftPort::new(Some(position), PortRef { pass, port }, wiring.flows[number].class);
                self.planned[number] = Some(self.ports.push(written));
            }
        }
        self.positions[pass] = Some(position);
        self.passes.push(PlannedPass { pass, volatile: true, outputs: self.ports.since(first) });
    }

    fn root(&mut self, wiring: &Wiring, root: PortRef) {
        let number = wiring.passes.port(root);
        let flowing = wiring.out_of(number).as_port().unwrap_or(number);
        let constant = || self.ports.push(DraftPort::new(None, root, wiring.flows[number].class));
        let planned = *self.planned[flowing].get_or_insert_with(constant);
        let port = &mut self.ports[planned];
        port.root = true;
        port.until = Until::End;
        self.roots.push(planned);
    }

    /// Finds the passes that change from frame to frame, and keeps what they, and the caller, read of the others.
    pub fn keep(&mut self, graph: &Graph, keep: &Keep) {
        let Keep::Edges { live, animated } = keep else { return };
        let wiring = &graph.wiring;
        let mut changing = wiring.passes.kind_of.column(false);
        for param in live.iter().flat_map(|name| graph.find_params(name)) {
            changing[param.pass] = true;
        }
        let kind_changes: Table<_, bool> = wiring
            .passes
            .kinds
            .iter()
            .map(|kind| {
                let descriptor = &kind.descriptor;
                let is_animated = descriptor.scene.iter().any(|data| animated.contains(data));
                is_animated || descriptor.side_effect || descriptor.remembers()
            })
            .collect();
        for position in self.passes.handles() {
            let pass = self.passes[position].pass;
            let mut params = graph.pass(pass).params.iter();
            self.passes[position].volatile = changing[pass]
                || kind_changes[wiring.passes.kind_of[pass]]
                || params.any(|setting| !matches!(setting, ParamSetting::Value(_)))
                || self.sources(wiring, pass).any(|source| self.is_volatile(source));
        }
        for port in self.ports.handles() {
            let DraftPort { pass, root, carried, .. } = self.ports[port];
            self.ports[port].kept = (root || carried) && pass.is_some() && !self.is_volatile(port);
        }
        for position in self.passes.handles().filter(|position| self.passes[*position].volatile).collect::<Vec<_>>() {
            for source in self.sources(wiring, self.passes[position].pass).collect::<Vec<_>>() {
                self.ports[source].kept = !self.is_volatile(source);
            }
        }
    }

    fn is_volatile(&self, port: Handle<PlannedPort>) -> bool {
        self.ports[port].pass.is_some_and(|position| self.passes[position].volatile)
    }

    /// The planned port that feeds an input.
    pub fn source(&self, wiring: &Wiring, input: Handle<GraphPort>) -> Option<Handle<PlannedPort>> {
        self.planned[wiring.feeds[input].as_port()?]
    }

    /// The planned ports that a pass reads of this frame.
    fn sources(&self, wiring: &Wiring, pass: Handle<Pass>) -> impl Iterator<Item = Handle<PlannedPort>> {
        wiring.sources(pass).filter_map(|port| self.planned[port])
    }
}

impl DraftPort {
    fn new(pass: Option<Handle<PlannedPass>>, port: PortRef, class: Class) -> Self {
        let until = pass.map_or(Until::End, Until::Pass);
        Self { pass, port, class, until, root: false, kept: false, carried: false }
    }
}
