//! What a pass declares, once: its ports, its parameters, and the scene data that it reads.
//!
//! The validator, the planner, the check against the shader, the bind groups, the command line, the documentation
//! and the dump's file names are all read from a [`PassDescriptor`]; nothing about a pass is stated a second time.

mod param;
mod port;
mod refusal;
mod size;
mod texel;
mod value;

use crate::handle::{Handle, Table};

pub use param::{ParamDescriptor, ParamType};
pub use port::{Disabled, PortDescriptor, PortKind, Role};
pub use refusal::Refusal;
pub use size::{Axis, Extent, SizeRule};
pub use texel::{Class, Dimension, Format, Scalar};
pub use value::ParamValue;

/// Everything that the framework knows about a pass without running it.
#[derive(Debug, Clone, PartialEq)]
pub struct PassDescriptor {
    /// `plugin.pass`, the name that a graph file gives after `use`.
    pub name: String,
    /// What the pass computes, in a sentence or a paragraph.
    pub about: String,
    /// Paper and equation that it comes from; may be empty.
    pub source: String,
    /// Inputs and outputs, in the order in which they are documented.
    pub ports: Table<PortDescriptor>,
    /// Parameters, in the order in which they are documented.
    pub params: Table<ParamDescriptor>,
    /// Values of several parameters under one word. If there are any, the pass has a parameter [`PRESET`] whose choices are
    /// their names; they replace defaults, so a parameter that is set keeps its value.
    pub presets: Vec<Preset>,
    /// Names of the scene data that the pass reads (`camera`, `lights`, …), sorted. Opaque to the graph.
    pub scene: Vec<String>,
    /// Whether the pass does something that does not show in a port, so that it is never culled.
    pub side_effect: bool,
    /// Raised by the author whenever Rust code changes what the pass computes: a part of its fingerprint.
    pub revision: u32,
}

impl PassDescriptor {
    /// The ports that must or may be connected, in order; in-out ports are included.
    pub fn inputs(&self) -> impl Iterator<Item = &PortDescriptor> + Clone {
        self.ports.iter().filter(|port| port.role.is_input())
    }

    /// The ports that other passes can read, in order; in-out ports are included.
    pub fn outputs(&self) -> impl Iterator<Item = &PortDescriptor> + Clone {
        self.ports.iter().filter(|port| port.role.is_output())
    }

    /// The port of this name.
    pub fn port(&self, name: &str) -> Option<&PortDescriptor> {
        self.ports.iter().find(|port| port.name == name)
    }

    /// The handle of the port of this name.
    pub fn port_named(&self, name: &str) -> Option<Handle<PortDescriptor>> {
        self.ports.position(|port| port.name == name)
    }

    /// The parameter of this name.
    pub fn param(&self, name: &str) -> Option<&ParamDescriptor> {
        self.params.iter().find(|param| param.name == name)
    }

    /// The handle of the parameter of this name.
    pub fn param_named(&self, name: &str) -> Option<Handle<ParamDescriptor>> {
        self.params.position(|param| param.name == name)
    }

    /// Whether it reads what was written in the frame before.
    pub fn remembers(&self) -> bool {
        self.ports.iter().any(|port| matches!(port.role, Role::History(_)))
    }
}

/// Name of the parameter that chooses one of the [presets](PassDescriptor::presets) of a pass. No shader has it.
pub const PRESET: &str = "preset";

/// Values of several parameters of a pass under one word.
#[derive(Debug, Clone, PartialEq)]
pub struct Preset {
    /// The word.
    pub name: String,
    /// What it is for.
    pub about: String,
    /// Parameters by name and their values; all others keep their defaults.
    pub values: Vec<(String, ParamValue)>,
}
