//! What a pass declares, once: its ports, its parameters, and the scene data that it reads.
//!
//! The validator, the planner, the check against the shader, the bind groups, the command line, the documentation
//! and the dump's file names are all read from a [`PassDescriptor`]; nothing about a pass is stated a second time.

use std::fmt;

use crate::handle::{Handle, Table};

/// Everything that the framework knows about a pass without running it.
#[derive(Debug, Clone, PartialEq)]
pub struct PassDescriptor {
    /// `plugin.pass`, the name that a graph file gives after `use`.
    pub name: String,
    /// What the pass computes, in a sentence or a paragraph.
    pub about: String,
    /// Paper and equation that it comes from; empty where there is none.
    pub source: String,
    /// Inputs and outputs, in the order in which they are documented.
    pub ports: Table<PortDescriptor>,
    /// Parameters, in the order in which they are documented.
    pub params: Table<ParamDescriptor>,
    /// Values of several parameters under one word. Where there are any, the pass has a parameter [`PRESET`] whose
    /// choices are their names; they stand in for the defaults, so a parameter that is given keeps what it is given.
    pub presets: Vec<Preset>,
    /// Names of the scene data that the pass reads (`camera`, `lights`, …), sorted. Opaque to the graph.
    pub scene: Vec<String>,
    /// The pass does something that no port shows, so it is never culled.
    pub side_effect: bool,
    /// Raised by the author whenever Rust code changes what the pass computes: a part of its fingerprint.
    pub revision: u32,
}

impl PassDescriptor {
    /// The ports that must or may be fed, in order; an in-out port is one of them.
    pub fn inputs(&self) -> impl Iterator<Item = &PortDescriptor> + Clone {
        self.ports.iter().filter(|port| port.role.is_input())
    }

    /// The ports that other passes can read, in order; an in-out port is one of them.
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
    /// What it stands for.
    pub about: String,
    /// Parameters by name and their values; all others keep their defaults.
    pub values: Vec<(String, ParamValue)>,
}

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

    /// Of a scalar, a vector, a matrix or an array in WGSL (`u32`, `vec3<u32>`, `array<atomic<u32>, 4>`); floats of all
    /// others.
    fn of_type(name: &str) -> Self {
        let innermost = name.rsplit('<').next().unwrap_or(name);
        match innermost.split(['>', ',']).next().map(str::trim) {
            Some("u32") => Scalar::U32,
            Some("i32") => Scalar::I32,
            _ => Scalar::F32,
        }
    }
}

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

/// What the channels of a texture mean: it decides which ports may be joined, and how a file names the channels.
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
    /// Whatever: numbers that only their reader understands (lookup tables, material layers, identifiers).
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

/// How large a port is: width, height, and depth or layers. A buffer has `width` elements.
#[derive(Debug, Clone, PartialEq)]
pub struct SizeRule {
    /// Texels in x, or elements of a buffer.
    pub width: Extent,
    /// Texels in y.
    pub height: Extent,
    /// Texels in z, or layers.
    pub depth: Extent,
}

impl SizeRule {
    /// The size of another port of the same pass.
    pub fn same(port: &str) -> Self {
        Self::scaled(port, 1.0)
    }

    /// The size of another port, times a factor in x and y, rounded up; depth is unchanged.
    pub fn scaled(port: &str, scale: f64) -> Self {
        let extent = |axis, scale| Extent::Port { port: port.to_owned(), axis, scale };
        Self { width: extent(Axis::X, scale), height: extent(Axis::Y, scale), depth: extent(Axis::Z, 1.0) }
    }

    /// The frame's size times a factor, rounded up.
    pub fn frame(scale: f64) -> Self {
        Self {
            width: Extent::Frame { axis: Axis::X, scale },
            height: Extent::Frame { axis: Axis::Y, scale },
            depth: Extent::Fixed(1),
        }
    }

    /// The size of the picture that a file parameter names.
    pub fn picture(param: &str) -> Self {
        let extent = |axis| Extent::Picture { param: param.to_owned(), axis };
        Self { width: extent(Axis::X), height: extent(Axis::Y), depth: Extent::Fixed(1) }
    }

    /// A size in texels.
    pub fn fixed(width: u32, height: u32, depth: u32) -> Self {
        Self { width: Extent::Fixed(width), height: Extent::Fixed(height), depth: Extent::Fixed(depth) }
    }
}

/// One extent of a [`SizeRule`]; a scaled one is rounded up, and never below 1.
#[derive(Debug, Clone, PartialEq)]
pub enum Extent {
    /// Texels.
    Fixed(u32),
    /// A fraction of the frame.
    Frame {
        /// Which of the frame's axes.
        axis: Axis,
        /// Factor.
        scale: f64,
    },
    /// A fraction of another port of the same pass.
    Port {
        /// That port.
        port: String,
        /// Which of its axes.
        axis: Axis,
        /// Factor.
        scale: f64,
    },
    /// The value of an integer parameter of the pass.
    Param(String),
    /// An axis of the picture that a file parameter of the pass names.
    Picture {
        /// That parameter.
        param: String,
        /// Which of the picture's axes.
        axis: Axis,
    },
    /// Texels of the frame (width × height), times a factor: per-pixel lists in buffers.
    FramePixels(f64),
}

/// `the size of `depth``, `640 × 480`, `1/2 of the frame`: what a rule says, for messages and documentation.
impl fmt::Display for SizeRule {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let uniform = |scale: f64| (*self == Self::frame(scale)).then_some(scale);
        if let Extent::Frame { scale, .. } = &self.width
            && let Some(scale) = uniform(*scale)
        {
            return write!(f, "{}the frame's size", factor(scale));
        }
        if let Extent::Port { port, scale, .. } = &self.width
            && *self == Self::scaled(port, *scale)
        {
            return write!(f, "{}the size of `{port}`", factor(*scale));
        }
        write!(f, "{} × {}", self.width, self.height)?;
        if self.depth == Extent::Fixed(1) { Ok(()) } else { write!(f, " × {}", self.depth) }
    }
}

impl fmt::Display for Extent {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Extent::Fixed(texels) => write!(f, "{texels}"),
            Extent::Frame { axis, scale } => write!(f, "{}the frame's {axis}", factor(*scale)),
            Extent::Port { port, axis, scale } => write!(f, "{}the {axis} of `{port}`", factor(*scale)),
            Extent::Param(param) => write!(f, "the parameter `{param}`"),
            Extent::Picture { param, axis } => write!(f, "the {axis} of the picture `{param}`"),
            Extent::FramePixels(scale) => write!(f, "{}the pixels of the frame", factor(*scale)),
        }
    }
}

fn factor(scale: f64) -> String {
    if scale == 1.0 { String::new() } else { format!("{scale} × ") }
}

impl fmt::Display for Axis {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Axis::X => "width",
            Axis::Y => "height",
            Axis::Z => "depth",
        })
    }
}

/// An axis of a size.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[allow(missing_docs, reason = "they say it all")]
pub enum Axis {
    X,
    Y,
    Z,
}

impl Axis {
    /// The extent of a size along this axis.
    pub(crate) fn of(self, [x, y, z]: [u32; 3]) -> u32 {
        match self {
            Axis::X => x,
            Axis::Y => y,
            Axis::Z => z,
        }
    }
}

/// One parameter of a pass.
#[derive(Debug, Clone, PartialEq)]
pub struct ParamDescriptor {
    /// Name in graph files, and of the member of the WGSL `Params` or of the `override`.
    pub name: String,
    /// What it does.
    pub about: String,
    /// Unit, `""` where there is none.
    pub unit: String,
    /// Value where a graph gives none; its type is the parameter's type.
    pub default: ParamValue,
    /// Smallest and largest value of every component, inclusive.
    pub range: Option<(f64, f64)>,
    /// Of a [`ParamValue::Choice`]: the words to choose from; the shader sees the index.
    pub choices: Vec<String>,
    /// A part of the pipeline (an `override` in WGSL), so a change of it builds a new one.
    pub fixed: bool,
}

/// Value of a parameter.
#[derive(Debug, Clone, PartialEq)]
pub enum ParamValue {
    /// A switch; `u32` 0 or 1 in WGSL.
    Bool(bool),
    /// A whole number; `i32` or `u32` in WGSL.
    Integer(i64),
    /// A number; `f32` in WGSL.
    Float(f64),
    /// Two to four numbers; `vec2<f32>` to `vec4<f32>` in WGSL.
    Vector(Vec<f64>),
    /// One of the words of [`ParamDescriptor::choices`]; `u32` index in WGSL.
    Choice(String),
    /// A path, relative to the file that holds it; for passes in Rust.
    File(String),
}

impl fmt::Display for ParamValue {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            ParamValue::Bool(value) => write!(f, "{value}"),
            ParamValue::Integer(value) => write!(f, "{value}"),
            ParamValue::Float(value) => write!(f, "{value:?}"),
            ParamValue::Vector(values) => {
                let parts: Vec<String> = values.iter().map(|value| format!("{value:?}")).collect();
                write!(f, "({})", parts.join(", "))
            }
            ParamValue::Choice(word) | ParamValue::File(word) => write!(f, "{word:?}"),
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
