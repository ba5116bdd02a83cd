//! What a slot is made of.

use std::fmt;

use crate::descriptor::{Dimension, Format, PortDescriptor, Scalar};

/// A texture or buffer as a GPU allocates it. Ports may share memory only where these are equal.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Resource {
    /// A texture with one mip level and one sample.
    Texture {
        /// Its dimension.
        dimension: Dimension,
        /// Its format.
        format: Format,
        /// Texels in x.
        width: u32,
        /// Texels in y.
        height: u32,
        /// Texels in z, or layers.
        depth_or_layers: u32,
    },
    /// A buffer, or a single value.
    Buffer {
        /// Bytes in all.
        bytes: u64,
        /// Bytes of an element.
        stride: u32,
    },
}

impl Resource {
    /// How its numbers are stored where a port of this descriptor holds it.
    pub fn scalar(&self, port: &PortDescriptor) -> Scalar {
        match self {
            Resource::Texture { format, .. } => format.scalar(),
            Resource::Buffer { .. } => port.kind.scalar(),
        }
    }

    /// Its size in bytes, without what a driver adds; saturates.
    pub fn bytes(&self) -> u64 {
        match *self {
            Resource::Texture { format, width, height, depth_or_layers, .. } => {
                let texels = u64::from(width) * u64::from(height);
                texels.saturating_mul(u64::from(depth_or_layers)).saturating_mul(format.bytes())
            }
            Resource::Buffer { bytes, .. } => bytes,
        }
    }
}

/// `rgba16float 640×480`, `r32float 64×64×64 (3D)`, `4096 B (stride 16)`.
impl fmt::Display for Resource {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match *self {
            Resource::Texture { dimension, format, width, height, depth_or_layers } => {
                write!(f, "{format} {width}×{height}")?;
                match dimension {
                    Dimension::D2 => Ok(()),
                    Dimension::D2Array => write!(f, ", {depth_or_layers} layers"),
                    Dimension::D3 => write!(f, "×{depth_or_layers}"),
                }
            }
            Resource::Buffer { bytes, stride } => {
                write!(f, "buffer of {} × {stride} B", bytes / u64::from(stride.max(1)))
            }
        }
    }
}
