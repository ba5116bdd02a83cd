//! What a plan is asked for.

use std::collections::BTreeSet;

use crate::graph::PortRef;

/// What a plan is asked for.
#[derive(Debug, Clone)]
pub struct PlanOptions {
    /// Size of the frame in pixels, usually [`Graph::size`](crate::Graph).
    pub size: (u32, u32),
    /// Which ports must exist at the end of the frame.
    pub roots: Roots,
    /// Further ports that must: what a test or an editor looks at.
    pub taps: Vec<PortRef>,
    /// Ports whose lifetimes do not overlap may share memory.
    pub share: bool,
    /// What outlives a frame.
    pub keep: Keep,
    /// Which of the valid orders.
    pub order: Order,
}

impl PlanOptions {
    /// The graph's outputs at this size, with sharing, nothing kept, in file order.
    pub fn new(size: (u32, u32)) -> Self {
        Self { size, roots: Roots::Outputs, taps: Vec::new(), share: true, keep: Keep::Nothing, order: Order::File }
    }
}

/// Which ports must exist at the end of the frame. Passes with side effects run whatever is chosen.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Roots {
    /// Every output of the graph.
    Outputs,
    /// Every port of every pass that is switched on, and every output of the graph.
    All,
    /// These, as [`Graph::find`](crate::Graph::find) gives them.
    Ports(Vec<PortRef>),
}

/// What outlives a frame, so that a pass whose inputs have not changed need not run again.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Keep {
    /// Nothing: what is left of the frame before is not counted on.
    Nothing,
    /// The ports on the edge between passes that stay the same and passes that change from frame to frame.
    Edges {
        /// Parameters that will be changed while the plan stands: `pass.parameter`, or a parameter of the graph.
        live: BTreeSet<String>,
        /// Scene data that change from frame to frame.
        animated: BTreeSet<String>,
    },
}

/// Which of the valid orders passes run in.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Order {
    /// That of the file; a pass that stands before one that it reads waits for it.
    File,
    /// Another one, drawn by this seed.
    Shuffled(u64),
}
