//! The immutable plan of a graph: what runs in which order, and which memory each port has.

mod build;
mod cull;
mod lifetimes;
mod options;
mod order;
mod resource;
pub(crate) mod sizes;
mod slots;

use std::sync::Arc;

use crate::descriptor::{Class, ParamDescriptor, PassDescriptor, PortDescriptor};
use crate::graph::{Graph, ParamSetting, Pass, PortRef, Values};
use crate::handle::{Handle, Handles, Slice, Table};
use crate::wiring::GraphPort;

pub use build::plan;
pub use options::{Keep, Order, PlanOptions, Roots};
pub use resource::Resource;

/// What a frame does, by handles alone. Made by [`plan`](plan()); two plans of the same graph and options are equal.
#[derive(Debug, Clone)]
pub struct Plan {
    /// The graph that was planned.
    pub graph: Arc<Graph>,
    /// Size of the frame in pixels.
    pub size: (u32, u32),
    /// The passes that run, in order: their handles are positions.
    pub passes: Table<PlannedPass>,
    /// Every port that a pass of this plan writes, pass by pass; after them, constants that stand for requested ports of
    /// disabled passes.
    pub ports: Table<PlannedPort>,
    /// The physical textures and buffers.
    pub slots: Table<Slot>,
    /// The steps of a frame, in order.
    pub steps: Vec<Step>,
    /// The graph's outputs that are roots of this plan, by name, in file order.
    pub outputs: Vec<(String, Handle<PlannedPort>)>,
    /// The ports that live to the end of the frame because they were requested, sorted.
    pub roots: Vec<Handle<PlannedPort>>,
    /// The passes that do not run, in file order.
    pub culled: Vec<Culled>,
    /// Bytes of memory.
    pub bytes: Bytes,
    bindings: Bindings,
    planned: Table<GraphPort, Option<Handle<PlannedPort>>>,
    positions: Table<Pass, Option<Handle<PlannedPass>>>,
}

/// What each port of the passes that run is bound to, and what feeds it.
#[derive(Debug, Clone)]
struct Bindings {
    slots: Table<GraphPort, Option<Handle<Slot>>>,
    sources: Table<GraphPort, Option<Handle<PlannedPort>>>,
}

/// A pass at its position; its data are read through the methods of [`Plan`].
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct PlannedPass {
    /// The pass in the graph.
    pub pass: Handle<Pass>,
    /// By what the plan's options say is live or animated, its results may differ from frame to frame. What passes that are not
    /// volatile write for others is kept, so these run once. True for every pass under [`Keep::Nothing`].
    pub volatile: bool,
    /// The ports that it writes.
    outputs: Handles<PlannedPort>,
}

/// A version of a resource, as one pass writes it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct PlannedPort {
    /// Position of the pass that writes it. `None` for a constant that stands for a port of a disabled pass.
    pub pass: Option<Handle<PlannedPass>>,
    /// The port in the graph.
    pub port: PortRef,
    /// The slot that holds it.
    pub slot: Handle<Slot>,
    /// What its channels mean; never [`Class::Any`] for a texture.
    pub class: Class,
    /// How long it lives after it was written.
    pub until: Until,
    /// Whether it was requested: an output, a tap.
    pub root: bool,
    /// Whether its content outlives the frame, because passes that change from frame to frame read what this unchanging
    /// pass writes; then it has a slot of its own.
    pub kept: bool,
    /// Whether a history port reads it in the next frame.
    pub carried: bool,
    /// Whether it shares its slot with the version before it, which the same pass reads in place.
    pub in_place: bool,
    next_in_slot: Option<Handle<PlannedPort>>,
}

/// How long a port lives.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Until {
    /// The pass at this position reads it last; if none reads it, the one that writes it.
    Pass(Handle<PlannedPass>),
    /// To the end of the frame.
    End,
}

impl PlannedPort {
    /// Whether it is written while another one lives, or before.
    pub(crate) fn is_written_before_the_end_of(&self, other: &Self) -> bool {
        self.pass.is_none_or(|written| Until::Pass(written) <= other.until)
    }
}

/// A physical texture or buffer.
#[derive(Debug, Clone, PartialEq)]
pub struct Slot {
    /// What it is.
    pub resource: Resource,
    /// How long it holds its content.
    pub kind: SlotKind,
    first_port: Option<Handle<PlannedPort>>,
}

/// How long a slot holds its content.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum SlotKind {
    /// One port after the other within a frame.
    Transient,
    /// One port (and its versions in place), across frames.
    Kept,
    /// This value in every element, for ever.
    Constant([f32; 4]),
    /// What a port held in the frame before.
    History {
        /// The planned port whose content is carried over.
        of: Handle<PlannedPort>,
        /// Every element reads as this value in the first frame.
        first: [f32; 4],
    },
}

impl Slot {
    /// The value that fills the slot before the first frame, if any does.
    pub fn initial(&self) -> Option<[f32; 4]> {
        match self.kind {
            SlotKind::Constant(value) | SlotKind::History { first: value, .. } => Some(value),
            SlotKind::Transient | SlotKind::Kept => None,
        }
    }
}

/// One thing to do in a frame.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Step {
    /// Copies a version that is still needed, so that the pass at this position can change the copy in place. Belongs
    /// to the pass: if that does not run, neither does this.
    Copy {
        /// Position of the pass that follows.
        pass: Handle<PlannedPass>,
        /// Slot to read.
        from: Handle<Slot>,
        /// Slot to write; of an equal resource.
        to: Handle<Slot>,
    },
    /// Runs the pass at this position.
    Run {
        /// Position.
        pass: Handle<PlannedPass>,
    },
    /// At the end of the frame: carries a port's content over to the next frame.
    Carry {
        /// Slot to read.
        from: Handle<Slot>,
        /// History slot to write; of an equal resource.
        to: Handle<Slot>,
    },
}

/// A pass that does not run.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Culled {
    /// The pass in the graph.
    pub pass: Handle<Pass>,
    /// The reason.
    pub reason: CullReason,
}

/// Why a pass does not run.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum CullReason {
    /// It is disabled.
    Off,
    /// Nothing that was requested depends on any of its ports, and it has no side effect.
    Unread,
}

/// Bytes of memory of one frame's textures and buffers.
///
/// `shared` and `unshared` are those of transient ports with nothing kept, whatever the options of the plan.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Bytes {
    /// Transient slots, shared by ports.
    pub shared: u64,
    /// Transient slots if every port had its own.
    pub unshared: u64,
    /// All slots of this plan, of every kind.
    pub allocated: u64,
    /// The part of these that is kept across frames: kept ports and history.
    pub kept: u64,
    /// Of these, constants.
    pub constant: u64,
    /// The same, one sharing class each, in order of first use.
    pub classes: Table<ClassBytes>,
}

/// Ports that may share memory because their resources are equal.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct ClassBytes {
    /// The resource of them all.
    pub resource: Resource,
    /// Ports, and so slots without sharing.
    pub ports: u32,
    /// Slots with sharing.
    pub slots: u32,
}

impl Plan {
    /// Name of the pass at this position.
    pub fn pass_name(&self, position: Handle<PlannedPass>) -> &str {
        &self.pass(position).name
    }

    /// What the pass at this position declares.
    pub fn descriptor(&self, position: Handle<PlannedPass>) -> &Arc<PassDescriptor> {
        self.pass(position).descriptor()
    }

    /// Whether any pass reads the scene data of this name.
    pub fn reads(&self, name: &str) -> bool {
        self.passes.handles().any(|position| self.descriptor(position).scene.iter().any(|read| read == name))
    }

    /// Settings of the pass at this position.
    pub fn params(&self, position: Handle<PlannedPass>) -> &Table<ParamDescriptor, ParamSetting> {
        &self.pass(position).params
    }

    /// The values of all parameters in the frame of this number, at this time in seconds.
    pub fn values(&self, frame: u32, seconds: f64) -> Table<PlannedPass, Values> {
        let of_pass = |pass| self.params(pass).iter().map(|setting| setting.value(frame, seconds)).collect();
        self.passes.handles().map(of_pass).collect()
    }

    /// The slot bound to each of the descriptor's ports: inputs, constants for what is absent, outputs. Every entry is
    /// `Some`, except for an input that a mistake left unconnected.
    pub fn bindings(&self, position: Handle<PlannedPass>) -> Slice<'_, PortDescriptor, Option<Handle<Slot>>> {
        self.bindings.slots.slice(self.graph.wiring.passes.ports[self.passes[position].pass])
    }

    /// The planned port that feeds each of the descriptor's ports. `None` for an output, a history port, and an input that
    /// reads a constant slot.
    pub fn sources(&self, position: Handle<PlannedPass>) -> Slice<'_, PortDescriptor, Option<Handle<PlannedPort>>> {
        self.bindings.sources.slice(self.graph.wiring.passes.ports[self.passes[position].pass])
    }

    /// The ports that the pass at this position writes, in the descriptor's order.
    pub fn outputs_of(&self, position: Handle<PlannedPass>) -> Handles<PlannedPort> {
        self.passes[position].outputs.clone()
    }

    /// `pass.port` of a planned port.
    pub fn port_name(&self, port: Handle<PlannedPort>) -> String {
        self.graph.port_name(self.ports[port].port)
    }

    /// What the pass declares about a planned port.
    pub fn port_descriptor(&self, port: Handle<PlannedPort>) -> &PortDescriptor {
        self.graph.port(self.ports[port].port)
    }

    /// The resource of a planned port.
    pub fn resource(&self, port: Handle<PlannedPort>) -> &Resource {
        &self.slots[self.ports[port].slot].resource
    }

    /// The planned port of a port of the graph; if the pass is disabled, the port that is passed through. `None` if it was
    /// culled, or is a constant that was not requested.
    pub fn planned(&self, port: PortRef) -> Option<Handle<PlannedPort>> {
        let wiring = &self.graph.wiring;
        let port = wiring.passes.port(port);
        self.planned[port].or_else(|| self.planned[wiring.out_of(port).as_port()?])
    }

    /// The planned port that a name means: an output of the graph or `pass.port`. `None` if the name is unknown, or
    /// its pass was culled.
    pub fn find(&self, name: &str) -> Option<Handle<PlannedPort>> {
        let place = tyndall_document::Place::Argument(String::new());
        self.planned(self.graph.find(name, place).ok()?)
    }

    /// Position of a pass of the graph; `None` if it does not run.
    pub fn position(&self, pass: Handle<Pass>) -> Option<Handle<PlannedPass>> {
        self.positions[pass]
    }

    /// The ports that a slot holds one after the other, in order; none for a constant slot that does not stand for a port.
    pub fn ports_in(&self, slot: Handle<Slot>) -> impl Iterator<Item = Handle<PlannedPort>> + '_ {
        std::iter::successors(self.slots[slot].first_port, |port| self.ports[*port].next_in_slot)
    }

    fn pass(&self, position: Handle<PlannedPass>) -> &Pass {
        self.graph.pass(self.passes[position].pass)
    }
}
