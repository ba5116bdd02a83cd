//! What a slot is made of.

use std::fmt;
use std::ops::{BitOr, BitOrAssign};

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
    /// A buffer; also what holds a value.
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

    /// Bytes that it takes, without what a driver adds; saturates.
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

/// In which ways a slot is used: a set.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub struct Usages(u8);

impl Usages {
    /// In none.
    pub const NONE: Self = Self(0);
    /// Read as a texture.
    pub const SAMPLED: Self = Self(1);
    /// Bound as a storage texture or storage buffer.
    pub const STORAGE: Self = Self(2);
    /// Drawn into.
    pub const ATTACHMENT: Self = Self(4);
    /// Copied from: to another slot or back to the CPU.
    pub const COPY_FROM: Self = Self(8);
    /// Copied to, or filled with a value.
    pub const COPY_TO: Self = Self(16);
    /// Bound as a uniform.
    pub const UNIFORM: Self = Self(32);

    /// Whether every way of `other` is in this.
    pub fn contains(self, other: Self) -> bool {
        self.0 & other.0 == other.0
    }
}

impl BitOr for Usages {
    type Output = Self;

    fn bitor(self, other: Self) -> Self {
        Self(self.0 | other.0)
    }
}

impl BitOrAssign for Usages {
    fn bitor_assign(&mut self, other: Self) {
        self.0 |= other.0;
    }
}

/// `sampled, storage`.
impl fmt::Display for Usages {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let names = [
            (Self::SAMPLED, "sampled"),
            (Self::STORAGE, "storage"),
            (Self::ATTACHMENT, "attachment"),
            (Self::COPY_FROM, "copied from"),
            (Self::COPY_TO, "copied to"),
            (Self::UNIFORM, "uniform"),
        ];
        let names: Vec<&str> = names.iter().filter(|(usage, _)| self.contains(*usage)).map(|(_, name)| *name).collect();
        f.write_str(&names.join(", "))
    }
}
