//! Every class of mistake that this crate reports.

use tyndall_document::Code;

/// The graph reads a scene, and none is given.
pub const NO_SCENE: Code = Code("no-scene");
/// A parameter asks for something that is not built.
pub const NOT_BUILT: Code = Code("not-built");

/// All of them.
pub const CODES: &[Code] = &[NO_SCENE, NOT_BUILT];
