//! What textures and buffers are made of.

use std::fmt;

/// Dimension of a texture.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Dimension {
    /// `texture_2d`.
    D2,
    /// `texture_2d_array`.
    D2Array,
    /// `texture_3d`.
    D3,
}

impl fmt::Display for Dimension {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Dimension::D2 => "2D",
            Dimension::D2Array => "2D array",
            Dimension::D3 => "3D",
        })
    }
}

/// What the channels of a texture mean, which decides which ports may be connected, and how a file names the channels.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Class {
    /// Linear RGB in the first three channels: R, G, B, A in a file.
    Color,
    /// One number: Y in a file.
    Scalar,
    /// Three components: X, Y, Z in a file.
    Vector,
    /// Display-referred RGB, already encoded (sRGB).
    Display,
    /// Numbers that only their reader understands (lookup tables, material layers, identifiers).
    Data,
    /// A rasteriser's depth buffer.
    RasterDepth,
    /// Of an input: every class is read. Of an output: that of the input of this pass named first in `size`.
    Any,
}

impl fmt::Display for Class {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Class::Color => "color",
            Class::Scalar => "scalar",
            Class::Vector => "vector",
            Class::Display => "display",
            Class::Data => "data",
            Class::RasterDepth => "raster depth",
            Class::Any => "any",
        })
    }
}

/// Makes [`Format`] of a row for each: name, WGSL's name, channels, how a channel is stored.
macro_rules! formats {
    ($($name:ident $wgsl:literal $channels:literal $scalar:ident;)*) => {
        /// Format of a texel.
        #[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
        #[allow(missing_docs, reason = "the names are WGSL's")]
        pub enum Format {
            $($name,)*
        }

        impl Format {
            /// All of them.
            pub const ALL: &[Format] = &[$(Format::$name,)*];

            /// Channels of a texel.
            pub const fn channels(self) -> u32 {
                match self {
                    $(Format::$name => $channels,)*
                }
            }

            /// How a channel is stored.
            pub const fn scalar(self) -> Scalar {
                match self {
                    $(Format::$name => Scalar::$scalar,)*
                }
            }

            /// WGSL's name of it, as in `texture_storage_2d<NAME, write>`.
            pub const fn wgsl(self) -> &'static str {
                match self {
                    $(Format::$name => $wgsl,)*
                }
            }
        }
    };
}

formats! {
    R32Float "r32float" 1 F32;
    Rg32Float "rg32float" 2 F32;
    Rgba32Float "rgba32float" 4 F32;
    R16Float "r16float" 1 F16;
    Rg16Float "rg16float" 2 F16;
    Rgba16Float "rgba16float" 4 F16;
    Rgba8Unorm "rgba8unorm" 4 Unorm8;
    R32Uint "r32uint" 1 U32;
    Rg32Uint "rg32uint" 2 U32;
    Rgba32Uint "rgba32uint" 4 U32;
    Depth32Float "depth32float" 1 F32;
}

impl Format {
    /// Bytes of a texel.
    pub const fn bytes(self) -> u64 {
        self.channels() as u64 * self.scalar().bytes() as u64
    }
}

impl fmt::Display for Format {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.wgsl())
    }
}

/// How a number of a port is stored.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Scalar {
    /// 32-bit float.
    F32,
    /// 16-bit float.
    F16,
    /// 0 to 1 in 255 steps, one byte.
    Unorm8,
    /// Whole number from 0, 32 bits.
    U32,
    /// Whole number with a sign, 32 bits.
    I32,
}

impl Scalar {
    /// Bytes of a number.
    pub const fn bytes(self) -> usize {
        match self {
            Scalar::F32 | Scalar::U32 | Scalar::I32 => 4,
            Scalar::F16 => 2,
            Scalar::Unorm8 => 1,
        }
    }

    /// That of a scalar, vector, matrix or array type of WGSL (`u32`, `vec3<u32>`, `array<atomic<u32>, 4>`); floats for all
    /// other types.
    pub(super) fn of_type(name: &str) -> Self {
        let innermost = name.rsplit('<').next().unwrap_or(name);
        match innermost.split(['>', ',']).next().map(str::trim) {
            Some("u32") => Scalar::U32,
            Some("i32") => Scalar::I32,
            _ => Scalar::F32,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_numbers_of_wgsl_types() {
        let types =
            ["f32", "vec2<f32>", "mat3x3<f32>", "Light", "u32", "vec4<u32>", "atomic<u32>", "array<vec2<i32>, 8>"];
        use Scalar::{F32, I32, U32};
        assert_eq!(types.map(Scalar::of_type), [F32, F32, F32, F32, U32, U32, U32, I32]);
    }
}
