//! The classes of mistakes in `mutants.ron`.

use tyndall_document::codes;

codes! {
    /// Every class of mistake that this crate reports and none below it.
    CODES:
    /// A reason is given for a mutant that cannot be made, or does not survive.
    STALE_REASON = "stale-reason";
}
