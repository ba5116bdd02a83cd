//! From when to when each port is alive, and which results outlive a frame.

use super::{Keep, PlannedPass, PlannedPort};
use crate::graph::{Graph, ParamSetting, PortRef};
use crate::signature::RoleKind;
use crate::table::{NONE, Table};

/// Passes at their positions and their ports with lifetimes, before any of them has a slot.
pub(super) struct Draft {
    pub passes: Vec<PlannedPass>,
    pub ports: Vec<PlannedPort>,
    /// By port number of the graph: planned port.
    pub planned: Vec<u32>,
    /// By pass of the graph: position.
    pub positions: Vec<u32>,
    /// Planned ports that were asked for, sorted.
    pub roots: Vec<u32>,
}

impl Draft {
    /// Numbers the ports of the passes of an order, and finds who reads each last.
    pub fn new(table: &Table, order: &[u32], needed: &[bool], roots: &[PortRef]) -> Self {
        let mut draft = Self {
            passes: Vec::with_capacity(order.len()),
            ports: Vec::with_capacity(2 * order.len()),
            planned: vec![NONE; table.pass_of.len()],
            positions: vec![NONE; table.passes() as usize],
            roots: Vec::with_capacity(roots.len()),
        };
        let mut bindings = 0;
        for pass in order {
            bindings += draft.pass(table, *pass, bindings);
        }
        let end = order.len() as u32;
        for port in table.history.iter().filter(|port| needed[table.pass_of[**port as usize] as usize]) {
            if let Some(source) = table.feeds[*port as usize].as_port() {
                let source = &mut draft.ports[draft.planned[source as usize] as usize];
                source.lifetime.1 = end;
                source.carried = true;
            }
        }
        for root in roots {
            draft.root(table, *root, end);
        }
        draft.roots.sort_unstable();
        draft.roots.dedup();
        draft
    }

    /// Adds a pass at the next position; gives the number of its bindings.
    fn pass(&mut self, table: &Table, pass: u32, first_binding: u32) -> u32 {
        let position = self.passes.len() as u32;
        let first_port = self.ports.len() as u32;
        self.passes.push(PlannedPass { index: pass, volatile: true, first_binding, first_port });
        self.positions[pass as usize] = position;
        let signature = &table.kind(pass).signature;
        let first = table.first_port[pass as usize];
        for (index, port) in signature.ports.iter().enumerate() {
            let number = first as usize + index;
            if !matches!(port.role, RoleKind::History | RoleKind::Output)
                && let Some(source) = table.feeds[number].as_port()
            {
                self.ports[self.planned[source as usize] as usize].lifetime.1 = position;
            }
            if port.role.is_output() {
                self.planned[number] = self.ports.len() as u32;
                let port = PortRef { pass, port: index as u32 };
                self.ports.push(PlannedPort::new(Some(position), port, table.flows[number].class));
            }
        }
        signature.ports.len() as u32
    }

    fn root(&mut self, table: &Table, root: PortRef, end: u32) {
        let number = table.port(root.pass, root.port);
        let planned = match table.out_of(number).as_port() {
            Some(source) => self.planned[source as usize],
            None if self.planned[number as usize] != NONE => self.planned[number as usize],
            None => {
                self.planned[number as usize] = self.ports.len() as u32;
                self.ports.push(PlannedPort::new(None, root, table.flows[number as usize].class));
                self.planned[number as usize]
            }
        };
        let port = &mut self.ports[planned as usize];
        port.root = true;
        port.lifetime.1 = end;
        self.roots.push(planned);
    }

    /// Finds the passes that change from frame to frame, and keeps what they and the outside read of the others.
    pub fn keep(&mut self, graph: &Graph, keep: &Keep) {
        let Keep::Edges { live, animated } = keep else { return };
        let table = &graph.table;
        let mut changing = vec![false; table.passes() as usize];
        for param in live.iter().flat_map(|name| graph.find_params(name)) {
            changing[param.pass as usize] = true;
        }
        let by_kind: Vec<bool> = table
            .kinds
            .iter()
            .map(|kind| {
                let history = kind.signature.ports.iter().any(|port| port.role == RoleKind::History);
                history
                    || kind.descriptor.side_effect
                    || kind.descriptor.scene.iter().any(|data| animated.contains(data))
            })
            .collect();
        for position in 0..self.passes.len() {
            let pass = self.passes[position].index;
            let params = &graph.pass(pass).params;
            let volatile = changing[pass as usize]
                || by_kind[table.kind_of[pass as usize] as usize]
                || params.iter().any(|setting| !matches!(setting, ParamSetting::Value(_)))
                || self.sources(table, pass).any(|source| self.is_volatile(source));
            self.passes[position].volatile = volatile;
        }
        for port in 0..self.ports.len() as u32 {
            let outlives = self.ports[port as usize].root || self.ports[port as usize].carried;
            self.ports[port as usize].kept =
                outlives && !self.is_volatile(port) && self.ports[port as usize].pass.is_some();
        }
        for position in 0..self.passes.len() {
            let pass = self.passes[position];
            if pass.volatile {
                for source in self.sources(table, pass.index).collect::<Vec<_>>() {
                    self.ports[source as usize].kept = !self.is_volatile(source);
                }
            }
        }
    }

    fn is_volatile(&self, port: u32) -> bool {
        self.ports[port as usize].pass.is_some_and(|position| self.passes[position as usize].volatile)
    }

    /// The planned ports that a pass reads of this frame.
    fn sources<'a>(&'a self, table: &'a Table, pass: u32) -> impl Iterator<Item = u32> + 'a {
        let ports = table.ports(pass).zip(&table.kind(pass).signature.ports);
        let read = ports.filter(|(_, port)| !matches!(port.role, RoleKind::History | RoleKind::Output));
        read.filter_map(|(port, _)| Some(self.planned[table.feeds[port as usize].as_port()? as usize]))
    }
}

impl PlannedPort {
    fn new(pass: Option<u32>, port: PortRef, class: crate::descriptor::Class) -> Self {
        let born = pass.unwrap_or(0);
        Self {
            pass,
            port,
            slot: NONE,
            class,
            lifetime: (born, born),
            root: false,
            kept: false,
            carried: false,
            in_place: false,
            next_in_slot: NONE,
        }
    }
}
