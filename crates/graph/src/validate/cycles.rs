//! An order in which every pass stands behind those that it reads, and the loops that make one impossible.

use std::collections::VecDeque;
use std::collections::hash_map::Entry;

use petgraph::algo::kosaraju_scc;
use petgraph::graph::{DiGraph, NodeIndex};
use rustc_hash::{FxHashMap, FxHashSet};
use tyndall_document::Diagnostic;

use super::Validator;
use crate::codes;
use crate::graph::{Connection, Pass, PortRef};
use crate::handle::{Handle, Table};
use crate::wiring::GraphPort;

#[derive(Clone, Copy, PartialEq)]
enum State {
    Unseen,
    Waiting,
    Done,
}

impl Validator<'_> {
    /// Orders the passes as the file does, but for those that must wait; reports loops.
    pub(super) fn find_order(&mut self) {
        let mut order = Vec::with_capacity(self.passes.len());
        let mut state = self.passes.column(State::Unseen);
        let mut stack: Vec<(Handle<Pass>, crate::handle::Handles<GraphPort>)> = Vec::new();
        let mut loops = false;
        for pass in self.passes.handles() {
            if state[pass] == State::Unseen {
                state[pass] = State::Waiting;
                stack.push((pass, self.wiring.ports[pass].handles()));
            }
            while let Some((pass, ports)) = stack.last_mut() {
                let pass = *pass;
                let Some(port) = ports.next() else {
                    state[pass] = State::Done;
                    order.push(pass);
                    stack.pop();
                    continue;
                };
                let Some(source) = self.read_by(pass, port) else { continue };
                match state[source] {
                    State::Unseen => {
                        state[source] = State::Waiting;
                        stack.push((source, self.wiring.ports[source].handles()));
                    }
                    State::Waiting => loops = true,
                    State::Done => {}
                }
            }
        }
        self.wiring.order = order;
        if loops {
            self.report_loops();
        }
    }

    /// The pass that must run before `pass`, because its port `number` reads it.
    fn read_by(&self, pass: Handle<Pass>, number: Handle<GraphPort>) -> Option<Handle<Pass>> {
        let source = self.written[number].as_port()?;
        let port = self.wiring.ports[pass].key(number);
        let role = self.kind_of(pass).signature.ports[port].role;
        role.reads_this_frame().then(|| self.wiring.pass_of[source])
    }

    /// One loop of each tangle of passes that wait for each other: the shortest through its first pass in the file.
    fn report_loops(&mut self) {
        let mut ordering: DiGraph<Handle<Pass>, ()> = DiGraph::new();
        let nodes: Table<Pass, NodeIndex> = self.passes.handles().map(|pass| ordering.add_node(pass)).collect();
        for Connection { from, to, .. } in self.connections.iter().filter(|connection| !connection.history) {
            ordering.add_edge(nodes[from.pass], nodes[to.pass], ());
        }
        for tangle in kosaraju_scc(&ordering) {
            let tangle: FxHashSet<Handle<Pass>> = tangle.into_iter().map(|node| ordering[node]).collect();
            let connections = self.shortest_loop(&tangle);
            self.report_loop(&connections);
        }
    }

    /// The connections of the shortest loop through the first pass of a tangle, against the flow: each is read by the
    /// writer of the one before it. None where the pass is a tangle by itself and does not read itself.
    fn shortest_loop(&self, tangle: &FxHashSet<Handle<Pass>>) -> Vec<Handle<Connection>> {
        let Some(start) = tangle.iter().copied().min() else { return Vec::new() };
        let mut reached_by: FxHashMap<Handle<Pass>, Handle<Connection>> = FxHashMap::default();
        let mut queue = VecDeque::from([start]);
        while let Some(pass) = queue.pop_front() {
            let inputs = self.wiring.ports[pass].handles().filter_map(|port| self.wiring.connection_to[port]);
            for input in inputs.filter(|input| !self.connections[*input].history) {
                let writer = self.connections[input].from.pass;
                if writer == start {
                    return self.walk_back(input, start, &reached_by);
                }
                if tangle.contains(&writer)
                    && let Entry::Vacant(vacant) = reached_by.entry(writer)
                {
                    vacant.insert(input);
                    queue.push_back(writer);
                }
            }
        }
        Vec::new()
    }

    fn walk_back(
        &self,
        last: Handle<Connection>,
        start: Handle<Pass>,
        reached_by: &FxHashMap<Handle<Pass>, Handle<Connection>>,
    ) -> Vec<Handle<Connection>> {
        let mut way = vec![last];
        let mut reader = self.connections[last].to.pass;
        while reader != start {
            let next = reached_by[&reader];
            way.push(next);
            reader = self.connections[next].to.pass;
        }
        way.reverse();
        way
    }

    fn report_loop(&mut self, connections: &[Handle<Connection>]) {
        let file = self.file;
        let name = |port: PortRef| file.text(&file.passes[port.pass].name);
        let starts = connections.iter().enumerate();
        let first = starts.min_by_key(|(_, connection)| self.connections[**connection].span.start);
        let Some((at, first)) = first else { return };
        let first = &self.connections[*first];
        let (before, behind) = connections.split_at(at);
        let mut waits = format!("`{}` waits", name(first.to));
        let mut diagnostic = Diagnostic::error(codes::CYCLE, self.place(first.span), String::new());
        for (index, connection) in behind.iter().chain(before).enumerate() {
            let Connection { from, to, span, .. } = &self.connections[*connection];
            waits += if index == 0 { " for " } else { ", which waits for " };
            waits += &if from.pass == to.pass { "itself".to_owned() } else { format!("`{}`", name(*from)) };
            if index > 0 {
                let port = &self.kind_of(to.pass).descriptor.ports[to.port].name;
                let from = file.source.slice(*span).trim_matches('"');
                let what = format!("`{}` reads `{from}` as `{port}`", name(*to));
                diagnostic = diagnostic.relate(self.place(*span), what);
            }
        }
        diagnostic.message = waits;
        self.report(
            diagnostic
                .suggest("break the loop at one of these connections, or read the frame before through a history port"),
        );
    }
}
