//! A plan for people: as text, as a drawing, as a graph for other programs, as data.

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
