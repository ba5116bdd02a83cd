//! A graph as flat arrays of indices: all that planning reads of it.
//!
//! Every port of every pass has a number: the passes in file order, and within each the descriptor's order. What feeds a
//! port is already what flows after switched-off passes have been passed through.

use std::sync::Arc;

use crate::catalogue::Kind;
use crate::descriptor::{Class, Dimension, Format};

/// No index.
pub(crate) const NONE: u32 = u32::MAX;

/// What flows into a port.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Feed(u32);

impl Feed {
    /// Nothing: an output, or an input that a mistake left unfed.
    pub const NOTHING: Feed = Feed(NONE);
    const CONSTANT: u32 = 1 << 31;

    /// What a pass that is switched on writes to this port.
    pub fn port(number: u32) -> Self {
        Feed(number)
    }

    /// The constant that stands for this port: an optional input, or an output of a pass that is switched off.
    pub fn constant(number: u32) -> Self {
        Feed(number | Self::CONSTANT)
    }

    pub fn as_port(self) -> Option<u32> {
        (self.0 & Self::CONSTANT == 0).then_some(self.0)
    }

    pub fn as_constant(self) -> Option<u32> {
        (self.0 & Self::CONSTANT != 0 && self.0 != NONE).then_some(self.0 & !Self::CONSTANT)
    }

    /// The port whose size and type it has.
    pub fn number(self) -> Option<u32> {
        (self.0 != NONE).then_some(self.0 & !Self::CONSTANT)
    }
}

/// What flows through a port, without its size.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Flow {
    pub class: Class,
    pub shape: Shape,
}

/// What flows through a port, as memory.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Shape {
    /// A mistake hides it.
    Unknown,
    Texture {
        dimension: Dimension,
        format: Format,
    },
    Buffer {
        stride: u32,
    },
    Value {
        bytes: u32,
    },
}

impl Flow {
    pub const UNKNOWN: Flow = Flow { class: Class::Any, shape: Shape::Unknown };
}

/// A graph as flat arrays of indices.
#[derive(Debug, Default)]
pub(crate) struct Table {
    /// The kinds of pass that occur.
    pub kinds: Vec<Arc<Kind>>,
    /// By pass: its kind.
    pub kind_of: Vec<u32>,
    /// By pass: whether it is switched on.
    pub enabled: Vec<bool>,
    /// By pass: number of its first port; and the number of all ports at the end.
    pub first_port: Vec<u32>,
    /// By port: its pass.
    pub pass_of: Vec<u32>,
    /// By port: what flows into it; of an output of a switched-off pass, what flows out of it.
    pub feeds: Vec<Feed>,
    /// By port: what flows through it.
    pub flows: Vec<Flow>,
    /// Passes, each after those that it reads.
    pub order: Vec<u32>,
    /// The history ports that are fed.
    pub history: Vec<u32>,
}

impl Table {
    /// Number of a port.
    pub fn port(&self, pass: u32, port: u32) -> u32 {
        self.first_port[pass as usize] + port
    }

    pub fn kind(&self, pass: u32) -> &Kind {
        &self.kinds[self.kind_of[pass as usize] as usize]
    }

    pub fn passes(&self) -> u32 {
        self.kind_of.len() as u32
    }

    /// The port numbers of a pass.
    pub fn ports(&self, pass: u32) -> std::ops::Range<u32> {
        self.first_port[pass as usize]..self.first_port[pass as usize + 1]
    }

    /// What flows out of a port that the pass writes.
    pub fn out_of(&self, port: u32) -> Feed {
        if self.enabled[self.pass_of[port as usize] as usize] { Feed::port(port) } else { self.feeds[port as usize] }
    }
}
