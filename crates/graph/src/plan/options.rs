//! Options of a plan.

use std::collections::BTreeSet;

use crate::graph::PortRef;

/// Options of a plan.
#[derive(Debug, Clone)]
pub struct PlanOptions {
    /// Size of the frame in pixels, usually [`Graph::size`](crate::Graph).
    pub size: (u32, u32),
    /// The ports that must exist at the end of the frame.
    pub roots: Roots,
    /// Further ports that must exist: those that a test or an editor looks at.
    pub taps: Vec<PortRef>,
    /// Whether ports whose lifetimes do not overlap may share memory.
    pub share: bool,
    /// What outlives a frame.
    pub keep: Keep,
    /// Which of the valid orders to use.
    pub order: Order,
}

impl PlanOptions {
    /// The graph's outputs at this size, with sharing, nothing kept, in file order.
    pub fn new(size: (u32, u32)) -> Self {
        Self { size, roots: Roots::Outputs, taps: Vec::new(), share: true, keep: Keep::Nothing, order: Order::File }
    }
}

/// The ports that must exist at the end of the frame. Passes with side effects run in any case.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Roots {
    /// Every output of the graph.
    Outputs,
    /// Every port of every enabled pass, and every output of the graph.
    All,
    /// These, as returned by [`Graph::find`](crate::Graph::find).
    Ports(Vec<PortRef>),
}

/// What outlives a frame, so that a pass whose inputs have not changed need not run again.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Keep {
    /// Nothing: what is left of the frame before is not counted on.
    Nothing,
    /// The ports between passes that stay the same and passes that change from frame to frame.
    Edges {
        /// Parameters that will be changed while the plan is in use: `pass.parameter`, or a parameter of the graph.
        live: BTreeSet<String>,
        /// Scene data that change from frame to frame.
        animated: BTreeSet<String>,
    },
}

/// Which of the valid orders passes run in.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Order {
    /// That of the file; a pass that comes before one that it reads waits for it.
    File,
    /// Another one, chosen by this seed.
    Shuffled(u64),
}
