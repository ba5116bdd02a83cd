//! An order in which every pass stands behind those that it reads, and the loops that make one impossible.

use std::collections::VecDeque;
use std::collections::hash_map::Entry;

use petgraph::Direction;
use petgraph::algo::kosaraju_scc;
use petgraph::graph::{EdgeIndex, NodeIndex};
use petgraph::visit::{EdgeFiltered, EdgeRef};
use rustc_hash::{FxHashMap, FxHashSet};
use tyndall_document::Diagnostic;

use super::Validator;
use crate::codes;
use crate::signature::RoleKind;

#[derive(Clone, Copy, PartialEq)]
enum State {
    Unseen,
    Waiting,
    Done,
}

impl Validator<'_> {
    /// Orders the passes as the file does, but for those that must wait; reports loops.
    pub(super) fn find_order(&mut self) {
        let passes = self.table.passes();
        let mut order = Vec::with_capacity(passes as usize);
        let mut state = vec![State::Unseen; passes as usize];
        let mut stack: Vec<(u32, u32)> = Vec::new();
        let mut loops = false;
        for pass in 0..passes {
            if state[pass as usize] == State::Unseen {
                state[pass as usize] = State::Waiting;
                stack.push((pass, self.table.first_port[pass as usize]));
            }
            while let Some((pass, port)) = stack.last_mut() {
                let (pass, number) = (*pass, *port);
                if number == self.table.first_port[pass as usize + 1] {
                    state[pass as usize] = State::Done;
                    order.push(pass);
                    stack.pop();
                    continue;
                }
                *port += 1;
                let Some(source) = self.read_by(pass, number) else { continue };
                match state[source as usize] {
                    State::Unseen => {
                        state[source as usize] = State::Waiting;
                        stack.push((source, self.table.first_port[source as usize]));
                    }
                    State::Waiting => loops = true,
                    State::Done => {}
                }
            }
        }
        self.table.order = order;
        if loops {
            self.report_loops();
        }
    }

    /// The pass that must run before `pass`, because its port `number` reads it.
    fn read_by(&self, pass: u32, number: u32) -> Option<u32> {
        let index = number - self.table.first_port[pass as usize];
        let role = self.kind_of(pass).signature.ports[index as usize].role;
        let feed = self.written[number as usize].as_port()?;
        (role != RoleKind::History).then(|| self.table.pass_of[feed as usize])
    }

    /// One loop of each tangle of passes that wait for each other: the shortest through its first pass in the file.
    fn report_loops(&mut self) {
        let ordering = EdgeFiltered::from_fn(&self.passes, |edge| !edge.weight().history);
        let mut tangles = kosaraju_scc(&ordering);
        tangles.retain(|tangle| tangle.len() > 1 || self.reads_itself(tangle[0]));
        for tangle in tangles {
            let edges = self.shortest_loop(&tangle);
            self.report_loop(&edges);
        }
    }

    fn reads_itself(&self, pass: NodeIndex) -> bool {
        self.passes.edges_connecting(pass, pass).any(|edge| !edge.weight().history)
    }

    /// The connections of the shortest loop through the first pass of a tangle, against the flow: each is read by the
    /// writer of the one before it.
    fn shortest_loop(&self, tangle: &[NodeIndex]) -> Vec<EdgeIndex> {
        let within: FxHashSet<NodeIndex> = tangle.iter().copied().collect();
        let Some(start) = tangle.iter().copied().min() else { return Vec::new() };
        let mut reached_by: FxHashMap<NodeIndex, EdgeIndex> = FxHashMap::default();
        let mut queue = VecDeque::from([start]);
        while let Some(pass) = queue.pop_front() {
            let mut inputs: Vec<_> = self.passes.edges_directed(pass, Direction::Incoming).collect();
            inputs.sort_by_key(|edge| edge.weight().to);
            for edge in inputs.into_iter().filter(|edge| !edge.weight().history && within.contains(&edge.source())) {
                if edge.source() == start {
                    return self.walk_back(edge.id(), start, &reached_by);
                }
                if let Entry::Vacant(vacant) = reached_by.entry(edge.source()) {
                    vacant.insert(edge.id());
                    queue.push_back(edge.source());
                }
            }
        }
        Vec::new()
    }

    fn walk_back(
        &self,
        last: EdgeIndex,
        start: NodeIndex,
        reached_by: &FxHashMap<NodeIndex, EdgeIndex>,
    ) -> Vec<EdgeIndex> {
        let mut edges = vec![last];
        let reader = |edge: EdgeIndex| self.passes.edge_endpoints(edge).map(|(_, reader)| reader);
        while let Some(pass) = edges.last().and_then(|edge| reader(*edge)).filter(|pass| *pass != start) {
            edges.push(reached_by[&pass]);
        }
        edges.reverse();
        edges
    }

    fn report_loop(&mut self, edges: &[EdgeIndex]) {
        let file = self.file;
        let name = |pass: NodeIndex| file.text(&file.passes[pass.index()].name);
        let Some(first) = edges.iter().copied().min_by_key(|edge| self.passes[*edge].span.start) else { return };
        let Some((_, start)) = self.passes.edge_endpoints(first) else { return };
        let at = edges.iter().position(|edge| *edge == first).unwrap_or(0);
        let (before, behind) = edges.split_at(at);
        let mut waits = format!("`{}` waits", name(start));
        let mut diagnostic = Diagnostic::error(codes::CYCLE, self.place(self.passes[first].span), String::new());
        for (index, edge) in behind.iter().chain(before).enumerate() {
            let Some((writer, reader)) = self.passes.edge_endpoints(*edge) else { continue };
            waits += if index == 0 { " for " } else { ", which waits for " };
            waits += &if writer == reader { "itself".to_owned() } else { format!("`{}`", name(writer)) };
            if index > 0 {
                let kind = self.kind_of(reader.index() as u32);
                let port = &kind.descriptor.ports[self.passes[*edge].to as usize].name;
                let what = format!(
                    "`{}` reads `{}` as `{port}`",
                    name(reader),
                    file.source.slice(self.passes[*edge].span).trim_matches('"')
                );
                diagnostic = diagnostic.relate(self.place(self.passes[*edge].span), what);
            }
        }
        diagnostic.message = waits;
        self.report(
            diagnostic
                .suggest("break the loop at one of these connections, or read the frame before through a history port"),
        );
    }
}
