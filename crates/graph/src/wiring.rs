//! A graph as flat tables: all that planning reads of it.
//!
//! Every port of every pass has a handle of its own here: the passes in file order, and within each the descriptor's
//! order.

use std::sync::Arc;

use crate::catalogue::Kind;
use crate::descriptor::{Class, Dimension, Format, PortDescriptor};
use crate::graph::{Connection, Pass, PortRef};
use crate::handle::{Handle, Segment, Table};
use crate::signature::PortSignature;

/// A port of a pass of a graph, inputs included. It holds nothing itself: each of its properties is a column of a table.
#[derive(Debug)]
pub(crate) enum GraphPort {}

/// What flows into a port.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Feed {
    /// Nothing: an output, or an input that a mistake left unconnected.
    Nothing,
    /// What an enabled pass writes to this port.
    Port(Handle<GraphPort>),
    /// The constant that stands for this port: an optional input, or an output of a disabled pass.
    Constant(Handle<GraphPort>),
}

impl Feed {
    pub fn as_port(self) -> Option<Handle<GraphPort>> {
        if let Feed::Port(port) = self { Some(port) } else { None }
    }

    pub fn as_constant(self) -> Option<Handle<GraphPort>> {
        if let Feed::Constant(port) = self { Some(port) } else { None }
    }

    /// The port whose size and type it has.
    pub fn like(self) -> Option<Handle<GraphPort>> {
        match self {
            Feed::Nothing => None,
            Feed::Port(port) | Feed::Constant(port) => Some(port),
        }
    }
}

/// What flows into every port; for an output of a disabled pass, what flows out of it.
pub(crate) type Feeds = Table<GraphPort, Feed>;

/// What flows through a port, without its size.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Flow {
    pub class: Class,
    pub shape: Shape,
}

/// What flows through a port, as memory.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Shape {
    /// Unknown, because a mistake hides it.
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

/// The passes of a graph and their ports, by kind.
#[derive(Debug, Default)]
pub(crate) struct Passes {
    /// The kinds of pass that occur.
    pub kinds: Table<Kind, Arc<Kind>>,
    pub kind_of: Table<Pass, Handle<Kind>>,
    pub ports: Table<Pass, Segment<PortDescriptor, GraphPort>>,
    pub pass_of: Table<GraphPort, Handle<Pass>>,
}

impl Passes {
    /// Adds a pass with its ports.
    pub fn push(&mut self, kind: Handle<Kind>) -> Handle<Pass> {
        let pass = self.kind_of.push(kind);
        self.ports.push(self.pass_of.push_for(&self.kinds[kind].signature.ports, pass));
        pass
    }

    pub fn kind(&self, pass: Handle<Pass>) -> &Arc<Kind> {
        &self.kinds[self.kind_of[pass]]
    }

    pub fn port(&self, port: PortRef) -> Handle<GraphPort> {
        self.ports[port.pass].at(port.port)
    }

    /// The pass, and which of its ports it is.
    pub fn port_ref(&self, port: Handle<GraphPort>) -> PortRef {
        let pass = self.pass_of[port];
        PortRef { pass, port: self.ports[pass].key(port) }
    }

    pub fn signature(&self, port: Handle<GraphPort>) -> &PortSignature {
        let PortRef { pass, port } = self.port_ref(port);
        &self.kind(pass).signature.ports[port]
    }

    pub fn descriptor(&self, port: Handle<GraphPort>) -> &PortDescriptor {
        let PortRef { pass, port } = self.port_ref(port);
        &self.kind(pass).descriptor.ports[port]
    }

    /// The ports of a pass, in the descriptor's order.
    pub fn ports_of(&self, pass: Handle<Pass>) -> impl Iterator<Item = (Handle<GraphPort>, &PortSignature)> + Clone {
        self.ports[pass].handles().zip(&self.kind(pass).signature.ports)
    }

    /// The same with what the kind declares of each.
    pub fn declared_ports_of(
        &self,
        pass: Handle<Pass>,
    ) -> impl Iterator<Item = (Handle<GraphPort>, &PortSignature, &PortDescriptor)> + Clone {
        let ports = self.ports_of(pass).zip(&self.kind(pass).descriptor.ports);
        ports.map(|((port, signature), descriptor)| (port, signature, descriptor))
    }

    /// The ports of other passes that a pass reads in the same frame, so that it runs after them.
    pub fn sources<'a>(&'a self, pass: Handle<Pass>, feeds: &'a Feeds) -> impl Iterator<Item = Handle<GraphPort>> + 'a {
        let read = self.ports_of(pass).filter(|(_, port)| port.role.reads_this_frame());
        read.filter_map(|(port, _)| feeds[port].as_port())
    }
}

/// A graph as flat tables.
#[derive(Debug, Default)]
pub(crate) struct Wiring {
    pub passes: Passes,
    /// What the file connects to a port.
    pub connection_to: Table<GraphPort, Option<Handle<Connection>>>,
    /// The history ports that are connected.
    pub history: Vec<Handle<GraphPort>>,
    /// Passes, each after those that it reads.
    pub order: Vec<Handle<Pass>>,
    /// Whether a pass is switched on.
    pub enabled: Table<Pass, bool>,
    /// What feeds a port once disabled passes have been passed through.
    pub feeds: Feeds,
    /// What flows through a port.
    pub flows: Table<GraphPort, Flow>,
}

impl Wiring {
    /// The ports of other passes that a pass reads in the same frame, past disabled ones.
    pub fn sources(&self, pass: Handle<Pass>) -> impl Iterator<Item = Handle<GraphPort>> + '_ {
        self.passes.sources(pass, &self.feeds)
    }

    /// What flows out of a port that the pass writes.
    pub fn out_of(&self, port: Handle<GraphPort>) -> Feed {
        if self.enabled[self.passes.pass_of[port]] { Feed::Port(port) } else { self.feeds[port] }
    }
}
