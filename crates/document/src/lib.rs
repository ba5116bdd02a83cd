//! Documents that people write, and what is said about their mistakes.
//!
//! * [`parse`] reads RON into a tree of [`Node`]s. Every node, field name and map key knows the [`Span`] of text that
//!   it came from, and one reading reports every syntax error that it can find, not only the first.
//! * [`Decoder`] turns nodes into typed values and reports what does not fit.
//! * [`Diagnostic`]s carry a stable [`Code`], a [`Place`], a sentence, a way out and the other places involved.
//!   [`render_text`] shows them to people, [`render_json`] to programs.
//! * [`near`] finds the name that was probably meant.
//! * [`fixture`] holds every code to a pinned text and position; each crate that reports uses it in a test.
//!
//! The reader accepts what the `ron` crate accepts with implicit `Some`, except what `parse.rs` lists, and tests hold
//! the two against each other.

mod brackets;
mod closing;
mod codes;
mod decode;
mod diagnostic;
mod duplicate;
pub mod fixture;
mod json;
mod near;
mod node;
mod number;
mod parse;
mod reader;
mod render;
mod sequence;
mod source;
mod string;

pub use codes::*;
pub use decode::{Decoder, Fields};
pub use diagnostic::{Code, Diagnostic, Diagnostics, Place, Severity};
pub use json::render_json;
pub use near::near;
pub use node::{Field, Node, Number, Value};
pub use parse::{MAX_DEPTH, parse, parse_value};
pub use render::render_text;
pub use source::{Source, Span};
