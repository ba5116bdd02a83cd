//! Mutants: whether image tests notice mistakes, and lay them at the right door.
//!
//! Of every pass a few shaders are made that differ from the right one in a single place ([`Mutation`]), and the tests
//! that run the pass are run with each, the quickest first. A mutant is *killed* where a test fails and every pass that
//! it names is the pass that was changed. One that makes a test blame another pass is *misnamed*; one that no test
//! notices *survives*, and is said why: nothing depends on the place, no bit changes, or all stays within tolerances.
//!
//! Goldens are a record of what was; properties, references on the CPU and relations say what is right. So each mutant
//! is first shown to these alone, and only where they do not kill it to the goldens as well.
//!
//! | step | where |
//! | --- | --- |
//! | which mistakes can be made, and making one | `tyndall_shader` |
//! | which of them are made | `draw` |
//! | one mutant before the tests | `trial` |
//! | all of them, pass by pass | [`hunt()`] |
//! | what is known of survivors | `reasons` |
//! | what became of them, for people and programs | [`Figures`], [`headline`], [`missed`], [`table`], [`summary`], [`json`] |
//!
//! [`Mutation`]: tyndall_shader::Mutation

mod codes;
mod draw;
mod figures;
mod findings;
mod hunt;
mod reasons;
mod trial;

pub use codes::{CODES, STALE_REASON};
pub use figures::{Figures, headline, json, missed, summary, table};
pub use findings::{Mutant, Nearest, PassFindings, Verdict};
pub use hunt::{Hunt, Trouble, hunt};
pub use reasons::REASONS;
