//! Mistakes that only a comparison can have; each has a fixture in `tests/fixtures`.

use tyndall_document::Code;

/// There are no scenes, or no methods.
pub(crate) const NOTHING_TO_COMPARE: Code = Code("nothing-to-compare");
/// The program knows no truth of an output.
pub(crate) const NO_TRUTH: Code = Code("no-truth");
/// What a method's graph gives is no picture of the size that is compared.
pub(crate) const WRONG_PICTURE: Code = Code("wrong-picture");

/// A method changes the scene, of which the truth is.
pub(crate) const SCENE_OF_METHOD: Code = Code("scene-of-method");

/// All of them.
pub const CODES: &[Code] = &[NOTHING_TO_COMPARE, NO_TRUTH, SCENE_OF_METHOD, WRONG_PICTURE];
