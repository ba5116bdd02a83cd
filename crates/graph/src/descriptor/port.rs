//! Ports of passes.

use super::{Class, Dimension, Format, Scalar, SizeRule};

/// One port of a pass.
#[derive(Debug, Clone, PartialEq)]
pub struct PortDescriptor {
    /// Name in graph files and of the WGSL variable.
    pub name: String,
    /// What flows through it.
    pub about: String,
    /// Unit of its values, `""` where there is none or any will do. Two stated units must agree along an edge.
    pub unit: String,
    /// Which way it flows.
    pub role: Role,
    /// What flows.
    pub kind: PortKind,
    /// How large it is. For an input: what is demanded (`None`: any size).
    pub size: Option<SizeRule>,
    /// Of an output: the order of its elements carries no meaning (an appended list).
    pub unordered: bool,
}

/// Which way a port flows.
#[derive(Debug, Clone, PartialEq)]
pub enum Role {
    /// Must be fed.
    Input,
    /// May be fed; where it is not, every element reads as this value.
    Optional([f32; 4]),
    /// Fed with what its source held in the frame before; in the first frame every element reads as this value.
    /// Such an edge orders nothing, so it may close a loop.
    History([f32; 4]),
    /// Written by the pass, from nothing.
    Output {
        /// What flows where the pass is switched off.
        disabled: Disabled,
    },
    /// Read and written in place: fed like an input, and yields a new version like an output.
    /// Where the pass is switched off, what was fed flows on.
    InOut,
}

impl Role {
    /// A graph file may (or must) feed it.
    pub fn is_input(&self) -> bool {
        !matches!(self, Role::Output { .. })
    }

    /// Other passes may read it.
    pub fn is_output(&self) -> bool {
        matches!(self, Role::Output { .. } | Role::InOut)
    }
}

/// What flows out of a port whose pass is switched off.
#[derive(Debug, Clone, PartialEq)]
pub enum Disabled {
    /// What flows into this input of the same pass.
    Input(String),
    /// This value, everywhere.
    Constant([f32; 4]),
}

/// What flows through a port.
#[derive(Debug, Clone, PartialEq)]
pub enum PortKind {
    /// A texture.
    Texture {
        /// Its dimension.
        dimension: Dimension,
        /// What its channels mean.
        class: Class,
        /// Of an output: its format. Of an input `None`: every format of the class is read.
        format: Option<Format>,
        /// Read through a filtering sampler.
        filtered: bool,
    },
    /// A storage buffer of elements of one type.
    Buffer {
        /// Name of the element's WGSL type; both ends of an edge must agree.
        element: String,
        /// Bytes of one element, its padding included.
        stride: u32,
    },
    /// A few numbers that a pass computes and another one reads as a uniform.
    Value {
        /// Name of the WGSL type; both ends of an edge must agree.
        element: String,
        /// Bytes.
        bytes: u32,
    },
}

impl PortKind {
    /// How its numbers are stored, as far as this tells: those of a texture input that reads several formats, and of elements
    /// that are structs (whose members may be of several types), count as 32-bit floats.
    pub fn scalar(&self) -> Scalar {
        match self {
            PortKind::Texture { format, .. } => format.map_or(Scalar::F32, Format::scalar),
            PortKind::Buffer { element, .. } | PortKind::Value { element, .. } => Scalar::of_type(element),
        }
    }
}
