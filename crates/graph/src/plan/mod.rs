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

use crate::descriptor::{Class, PassDescriptor, PortDescriptor};
use crate::graph::{Graph, ParamSetting, PortRef};
use crate::table::NONE;

pub use build::plan;
pub use options::{Keep, Order, PlanOptions, Roots};
pub use resource::{Resource, Usages};

/// What a frame does, by index alone. Made by [`plan`](plan()); two plans of the same graph and options are equal.
#[derive(Debug, Clone)]
pub struct Plan {
    /// The graph that was planned.
    pub graph: Arc<Graph>,
    /// Size of the frame in pixels.
    pub size: (u32, u32),
    /// The passes that run, in order: a position is an index into this.
    pub passes: Vec<PlannedPass>,
    /// Every port that a pass of this plan writes, pass by pass; and after them, constants that stand for an asked-for
    /// port of a switched-off pass.
    pub ports: Vec<PlannedPort>,
    /// The physical textures and buffers.
    pub slots: Vec<Slot>,
    /// What to do in a frame, in order.
    pub steps: Vec<Step>,
    /// The graph's outputs that are roots of this plan, by name, in file order, and their index in `ports`.
    pub outputs: Vec<(String, u32)>,
    /// The ports that live to the end of the frame because they were asked for, as indices into `ports`, sorted.
    pub roots: Vec<u32>,
    /// The passes that do not run, in file order.
    pub culled: Vec<Culled>,
    /// Bytes of memory.
    pub bytes: Bytes,
    bindings: Vec<Option<u32>>,
    sources: Vec<Option<u32>>,
    /// Planned port of every port of the graph, or `NONE`.
    planned: Vec<u32>,
    /// By pass of the graph: position, or `NONE`.
    positions: Vec<u32>,
}

/// A pass at its position; what belongs to it is read through the methods of [`Plan`].
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct PlannedPass {
    /// Index of the pass in the graph.
    pub index: u32,
    /// Its results may differ from frame to frame, so that it runs in each. True for every pass under
    /// [`Keep::Nothing`].
    pub volatile: bool,
    /// First of its entries in `bindings` and `sources`.
    first_binding: u32,
    /// First of its ports in `ports`.
    first_port: u32,
}

/// A version of a resource, as one pass writes it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct PlannedPort {
    /// Position of the pass that writes it. `None` of a constant that stands for a port of a switched-off pass.
    pub pass: Option<u32>,
    /// The port in the graph.
    pub port: PortRef,
    /// The slot that holds it.
    pub slot: u32,
    /// What its channels mean; never [`Class::Any`] for a texture.
    pub class: Class,
    /// Positions of the pass that writes it and of the last that reads it; the number of passes where it lives to the
    /// end of the frame.
    pub lifetime: (u32, u32),
    /// It was asked for: an output, a tap.
    pub root: bool,
    /// Its content outlives the frame, because passes that change from frame to frame read what this unchanging pass
    /// writes; its slot is its own.
    pub kept: bool,
    /// A history port reads it in the next frame.
    pub carried: bool,
    /// It shares its slot with the version before it, which the same pass reads in place.
    pub in_place: bool,
    next_in_slot: u32,
}

/// A physical texture or buffer.
#[derive(Debug, Clone, PartialEq)]
pub struct Slot {
    /// What it is.
    pub resource: Resource,
    /// How long it holds what.
    pub kind: SlotKind,
    /// In which ways it is used.
    pub usages: Usages,
    first_port: u32,
}

/// How long a slot holds what.
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
        of: u32,
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
    /// to the pass: where that does not run, neither does this.
    Copy {
        /// Position of the pass that follows.
        pass: u32,
        /// Slot to read.
        from: u32,
        /// Slot to write; of an equal resource.
        to: u32,
    },
    /// Runs the pass at this position.
    Run {
        /// Position.
        pass: u32,
    },
    /// At the end of the frame: carries a port's content over to the next frame.
    Carry {
        /// Slot to read.
        from: u32,
        /// History slot to write; of an equal resource.
        to: u32,
    },
}

/// A pass that does not run.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Culled {
    /// Index of the pass in the graph.
    pub pass: u32,
    /// Why.
    pub reason: CullReason,
}

/// Why a pass does not run.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum CullReason {
    /// It is switched off.
    Off,
    /// Nothing that was asked for depends on any of its ports, and it has no side effect.
    Unread,
}

/// Bytes of memory of one frame's textures and buffers.
///
/// `shared` and `unshared` are those of transient ports with nothing kept, whatever the options of the plan.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Bytes {
    /// Transient slots where ports share them.
    pub shared: u64,
    /// Transient slots if every port had its own.
    pub unshared: u64,
    /// What this plan's slots of every kind take.
    pub allocated: u64,
    /// Of these, kept across frames: kept ports and history.
    pub kept: u64,
    /// Of these, constants.
    pub constant: u64,
    /// The same, one sharing class each, in order of first use.
    pub classes: Vec<ClassBytes>,
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
    pub fn pass_name(&self, pass: u32) -> &str {
        &self.graph.pass(self.passes[pass as usize].index).name
    }

    /// What the pass at this position declares.
    pub fn descriptor(&self, pass: u32) -> &Arc<PassDescriptor> {
        self.graph.pass(self.passes[pass as usize].index).descriptor()
    }

    /// Whether any pass reads the scene data of this name.
    pub fn reads(&self, name: &str) -> bool {
        (0..self.passes.len() as u32).any(|pass| self.descriptor(pass).scene.iter().any(|read| read == name))
    }

    /// Settings of the pass at this position, one for each of the descriptor's parameters.
    pub fn params(&self, pass: u32) -> &[ParamSetting] {
        &self.graph.pass(self.passes[pass as usize].index).params
    }

    /// The slot bound to each of the descriptor's ports: inputs, constants for what is absent, outputs. Every entry is
    /// `Some`, but for an input that the pass declares and a mistake left unfed.
    pub fn bindings(&self, pass: u32) -> &[Option<u32>] {
        let first = self.passes[pass as usize].first_binding as usize;
        &self.bindings[first..first + self.descriptor(pass).ports.len()]
    }

    /// The planned port that feeds each of the descriptor's ports. `None` of an output, of a history port, and of an
    /// input that reads a constant slot.
    pub fn sources(&self, pass: u32) -> &[Option<u32>] {
        let first = self.passes[pass as usize].first_binding as usize;
        &self.sources[first..first + self.descriptor(pass).ports.len()]
    }

    /// The ports that the pass at this position writes, as a range of `ports`, in the descriptor's order.
    pub fn outputs_of(&self, pass: u32) -> std::ops::Range<u32> {
        let first = self.passes[pass as usize].first_port;
        first..first + self.descriptor(pass).outputs().count() as u32
    }

    /// `pass.port` of a planned port.
    pub fn port_name(&self, port: u32) -> String {
        self.graph.port_name(self.ports[port as usize].port)
    }

    /// What the pass declares about a planned port.
    pub fn port_descriptor(&self, port: u32) -> &PortDescriptor {
        self.graph.port(self.ports[port as usize].port)
    }

    /// The resource of a planned port.
    pub fn resource(&self, port: u32) -> &Resource {
        &self.slots[self.ports[port as usize].slot as usize].resource
    }

    /// The planned port of a port of the graph: what flows there, so the port that is passed through where the pass is
    /// switched off. `None` where it was culled, or is a constant that nobody asked for.
    pub fn planned(&self, port: PortRef) -> Option<u32> {
        let table = &self.graph.table;
        let number = table.port(port.pass, port.port);
        let planned = |number: u32| Some(self.planned[number as usize]).filter(|port| *port != NONE);
        planned(number).or_else(|| planned(table.out_of(number).as_port()?))
    }

    /// The planned port that a name means: an output of the graph or `pass.port`. `None` where the name is unknown, or
    /// its pass was culled.
    pub fn find(&self, name: &str) -> Option<u32> {
        let place = tyndall_document::Place::Argument(String::new());
        self.planned(self.graph.find(name, place).ok()?)
    }

    /// Position of a pass of the graph; `None` where it does not run.
    pub fn position(&self, index: u32) -> Option<u32> {
        Some(self.positions[index as usize]).filter(|position| *position != NONE)
    }

    /// The ports that a slot holds one after the other, in order; none of a constant slot that stands for no port.
    pub fn ports_in(&self, slot: u32) -> impl Iterator<Item = u32> + '_ {
        let first = Some(self.slots[slot as usize].first_port).filter(|port| *port != NONE);
        std::iter::successors(first, |port| Some(self.ports[*port as usize].next_in_slot).filter(|port| *port != NONE))
    }
}
