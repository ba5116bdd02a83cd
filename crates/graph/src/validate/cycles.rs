//! An order in which every pass comes after those that it reads, and the loops that make one impossible.

use std::collections::VecDeque;
use std::collections::hash_map::Entry;

use petgraph::algo::kosaraju_scc;
use petgraph::graph::{DiGraph, NodeIndex};
use rustc_hash::{FxHashMap, FxHashSet};
use tyndall_document::Diagnostic;

use super::connections::Connections;
use super::mistakes::Mistakes;
use super::scope::Scope;
use crate::codes;
use crate::graph::{Connection, Pass};
use crate::handle::{Handle, Table};
use crate::wiring::{Feeds, Passes};

/// Orders the passes as the file does, except for those that must wait; reports loops.
pub(super) fn order(scope: &Scope<'_>, connections: &Connections, out: &mut Mistakes) -> Vec<Handle<Pass>> {
    let (order, has_loops) = depth_first(&scope.passes, &connections.written);
    if has_loops {
        for tangle in tangles(scope, connections) {
            let way = shortest_loop(scope, connections, &tangle);
            if let Some(mistake) = in_words(scope, &way) {
                out.report(mistake);
            }
        }
    }
    order
}

#[derive(Clone, Copy, PartialEq)]
enum State {
    Unseen,
    Waiting,
    Done,
}

/// Each pass after those that it reads, and whether there is a pass that waits for itself.
fn depth_first(passes: &Passes, feeds: &Feeds) -> (Vec<Handle<Pass>>, bool) {
    let mut order = Vec::with_capacity(passes.kind_of.len());
    let mut state = passes.kind_of.column(State::Unseen);
    let mut stack = Vec::new();
    let mut has_loops = false;
    for first in passes.kind_of.handles() {
        if state[first] == State::Unseen {
            state[first] = State::Waiting;
            stack.push((first, passes.sources(first, feeds)));
        }
        while let Some((pass, sources)) = stack.last_mut() {
            let Some(source) = sources.next() else {
                state[*pass] = State::Done;
                order.push(*pass);
                stack.pop();
                continue;
            };
            let writer = passes.pass_of[source];
            match state[writer] {
                State::Unseen => {
                    state[writer] = State::Waiting;
                    stack.push((writer, passes.sources(writer, feeds)));
                }
                State::Waiting => has_loops = true,
                State::Done => {}
            }
        }
    }
    (order, has_loops)
}

/// Sets of passes that wait for each other; also every pass by itself that waits for none.
fn tangles(scope: &Scope<'_>, connections: &Connections) -> Vec<FxHashSet<Handle<Pass>>> {
    let mut waits: DiGraph<Handle<Pass>, ()> = DiGraph::new();
    let nodes: Table<Pass, NodeIndex> = scope.file.passes.handles().map(|pass| waits.add_node(pass)).collect();
    for Connection { from, to, .. } in connections.list.iter().filter(|connection| !connection.history) {
        waits.add_edge(nodes[from.pass], nodes[to.pass], ());
    }
    let tangles = kosaraju_scc(&waits).into_iter();
    tangles.map(|tangle| tangle.into_iter().map(|node| waits[node]).collect()).collect()
}

/// The connections of the shortest loop through the first pass of a tangle, against the flow: each is read by the
/// writer of the one before it. Empty where the pass waits for no pass of the tangle.
fn shortest_loop<'c>(
    scope: &Scope<'_>,
    connections: &'c Connections,
    tangle: &FxHashSet<Handle<Pass>>,
) -> Vec<&'c Connection> {
    let Some(start) = tangle.iter().copied().min() else { return Vec::new() };
    let mut reached_by: FxHashMap<Handle<Pass>, &Connection> = FxHashMap::default();
    let mut queue = VecDeque::from([start]);
    while let Some(pass) = queue.pop_front() {
        let read = scope.passes.ports[pass].handles().filter_map(|port| connections.to[port]);
        for connection in read.map(|read| &connections.list[read]).filter(|connection| !connection.history) {
            let writer = connection.from.pass;
            if writer == start {
                return walk_back(connection, start, &reached_by);
            }
            if tangle.contains(&writer)
                && let Entry::Vacant(vacant) = reached_by.entry(writer)
            {
                vacant.insert(connection);
                queue.push_back(writer);
            }
        }
    }
    Vec::new()
}

fn walk_back<'c>(
    last: &'c Connection,
    start: Handle<Pass>,
    reached_by: &FxHashMap<Handle<Pass>, &'c Connection>,
) -> Vec<&'c Connection> {
    let mut way = vec![last];
    let mut reader = last.to.pass;
    while reader != start {
        let next = reached_by[&reader];
        way.push(next);
        reader = next.to.pass;
    }
    way.reverse();
    way
}

/// A loop in words, starting at the connection that comes first in the file.
fn in_words(scope: &Scope<'_>, way: &[&Connection]) -> Option<Diagnostic> {
    let (at, first) = way.iter().enumerate().min_by_key(|(_, connection)| connection.span.start)?;
    let (before, behind) = way.split_at(at);
    let mut waits = format!("`{}` waits", scope.name(first.to.pass));
    let mut diagnostic = Diagnostic::error(codes::CYCLE, scope.place(first.span), String::new());
    for (index, connection) in behind.iter().chain(before).enumerate() {
        let Connection { from, to, span, .. } = connection;
        waits += if index == 0 { " for " } else { ", which waits for " };
        waits += &match from.pass == to.pass {
            true => "itself".to_owned(),
            false => format!("`{}`", scope.name(from.pass)),
        };
        if index > 0 {
            let port = &scope.passes.descriptor(scope.passes.port(*to)).name;
            let from = scope.file.source.slice(*span).trim_matches('"');
            let what = format!("`{}` reads `{from}` as `{port}`", scope.name(to.pass));
            diagnostic = diagnostic.relate(scope.place(*span), what);
        }
    }
    diagnostic.message = waits;
    Some(
        diagnostic
            .suggest("break the loop at one of these connections, or read the frame before through a history port"),
    )
}
