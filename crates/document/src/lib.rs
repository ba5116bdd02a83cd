//! Documents that people write, and diagnostics of the mistakes in them.
//!
//! * [`parse`] reads RON into a tree of [`Node`]s. Every node, field name and map key knows the [`Span`] of text that
//!   it came from. One reading reports every syntax error that it can find, not only the first.
//! * [`Decoder`] turns nodes into typed values, and reports those that do not fit.
//! * A [`Diagnostic`] carries a stable [`Code`], a [`Place`], a message, a suggestion and the other places involved.
//!   [`render_text`] writes it for people, [`render_json`] for programs.
//! * [`Diagnostic::suggest_near`] names what was probably meant by an unknown name, or what is available.
//! * [`fixture`] pins the text and the position of every code; each crate that reports mistakes uses it in a test.
//!
//! The reader accepts what the `ron` crate accepts with implicit `Some`, except what `parse.rs` lists. Tests compare
//! the two.

mod brackets;
mod closing;
mod codes;
mod decode;
mod diagnostic;
mod duplicate;
pub mod fixture;
mod json;
mod name;
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
pub use name::{NAME_RULE, is_name};
pub use near::{available, did_you_mean, near};
pub use node::{Field, Node, Number, Value};
pub use parse::{MAX_DEPTH, parse, parse_value};
pub use render::render_text;
pub use source::{Source, Span};
