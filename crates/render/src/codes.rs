//! Every class of mistake that this crate reports.

use tyndall_document::Code;

/// The graph reads a scene, and none is given.
pub const NO_SCENE: Code = Code("no-scene");
/// A pass is right in a homogeneous medium only, and the scene has height fog.
pub const NOT_HOMOGENEOUS: Code = Code("not-homogeneous");
/// A switch is on whose work needs an optional input that nothing feeds.
pub const INPUT_NEEDED: Code = Code("input-needed");
/// The scene has something that a pass does not do justice to.
pub const LIMIT: Code = Code("limit");
/// A driver ended loops of a pass before they were done.
pub const UNFINISHED: Code = Code("unfinished");

/// All of them.
pub const CODES: &[Code] = &[INPUT_NEEDED, LIMIT, NO_SCENE, NOT_HOMOGENEOUS, UNFINISHED];
