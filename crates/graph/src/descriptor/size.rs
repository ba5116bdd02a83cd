//! Sizes of ports, as rules.

use std::fmt;

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

/// `the size of `depth``, `640 × 480`, `1/2 of the frame`: a rule in words, for messages and documentation.
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
#[allow(missing_docs, reason = "the names say it")]
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
