//! Mistakes that only a comparison can have; each has a fixture in `tests/compare`.

use tyndall_document::Code;

/// There are no scenes, or no methods.
pub(super) const NOTHING_TO_COMPARE: Code = Code("nothing-to-compare");
/// The program knows no truth of an output.
pub(super) const NO_TRUTH: Code = Code("no-truth");
/// What a method's graph gives is no picture of the size that is compared.
pub(super) const WRONG_PICTURE: Code = Code("wrong-picture");

/// All of them.
#[cfg(test)]
pub(super) const CODES: &[Code] = &[NOTHING_TO_COMPARE, NO_TRUTH, WRONG_PICTURE];
