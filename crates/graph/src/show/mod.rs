//! Views of a plan: text, drawing, graph for other programs, data.

mod chart;
mod dot;
mod json;
mod layout;
mod names;
mod svg;
mod text;

pub use dot::dot;
pub use json::json;
pub use names::{byte_words, culled_words};
pub(crate) use names::{readers, value_words};
pub use svg::svg;
pub use text::text;
