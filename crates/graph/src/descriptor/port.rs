//! Ports of passes.

use super::{Class, Dimension, Format, Scalar, SizeRule};

/// One port of a pass.
#[derive(Debug, Clone, PartialEq)]
pub struct PortDescriptor {
    /// Name in graph files and of the WGSL variable.
    pub name: String,
    /// What flows through it.
    pub about: String,
    /// Unit of its values; `""` if there is none or any will do. The units of connected ports must agree.
    pub unit: String,
    /// Its direction.
    pub role: Role,
    /// The kind of data.
    pub kind: PortKind,
    /// Its size. For an input: the size that it must have (`None`: any).
    pub size: Option<SizeRule>,
    /// Of an output: whether the order of its elements has no meaning (an appended list).
    pub unordered: bool,
}

/// The direction of a port.
#[derive(Debug, Clone, PartialEq)]
pub enum Role {
    /// Must be connected.
    Input,
    /// May be connected; if it is not, every element reads as this value.
    Optional([f32; 4]),
    /// Reads what the connected port held in the frame before; in the first frame every element reads as this value.
    /// Such a connection does not order passes, so it may close a loop.
    History([f32; 4]),
    /// Written by the pass, from nothing.
    Output {
        /// What flows while the pass is disabled.
        disabled: Disabled,
    },
    /// Read and written in place: connected like an input, and a new version like an output. While the pass is disabled,
    /// the input is passed on.
    InOut,
}

impl Role {
    /// Whether it can be connected to a port that it reads.
    pub fn is_input(&self) -> bool {
        !matches!(self, Role::Output { .. })
    }

    /// Whether other passes may read it.
    pub fn is_output(&self) -> bool {
        matches!(self, Role::Output { .. } | Role::InOut)
    }
}

/// What flows out of a port while its pass is disabled.
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
        /// Whether it is read through a filtering sampler.
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
    /// How its numbers are stored, as far as this is known: those of a texture input that reads several formats, and of
    /// struct elements (whose members may be of several types), count as 32-bit floats.
    pub fn scalar(&self) -> Scalar {
        match self {
            PortKind::Texture { format, .. } => format.map_or(Scalar::F32, Format::scalar),
            PortKind::Buffer { element, .. } | PortKind::Value { element, .. } => Scalar::of_type(element),
        }
    }
}
