//! Pass-by-pass image tests.
//!
//! A test file names a graph, a scene and a size, and says what must hold of ports on the way: how far each may be
//! from its golden, which properties it has, how it changes when something is changed. Ports are judged in the order
//! in which passes run, so a failure names the first pass that diverges, and what only follows from it is told apart.
//!
//! | step | where |
//! | --- | --- |
//! | text to [`TestFile`], every mistake collected | [`mod@file`] |
//! | rendering, results shared between tests | [`Session`] |
//! | figures: [`Metric`], properties, relations | `metric`, `property`, `relation` |
//! | whose fault it is: [`Outcome`] | `judge` |
//! | goldens and what they were made from | [`golden`] |
//! | pages that show it | [`Report`] |
//!
//! It knows no command line; the verbs `tyndall test` and `tyndall diff` are one user of it, the tests of a plugin's
//! crate another:
//!
//! ```no_run
//! # fn plugin() -> tyndall_plugin::Plugin { todo!() }
//! #[test]
//! fn images() {
//!     tyndall_testing::assert_passes(vec![plugin], "tests/glow.test.ron");
//! }
//! ```

mod adapter;
mod blame;
mod bless;
mod cached_references;
pub mod codes;
mod discover;
mod draw;
pub mod file;
mod flip;
pub mod golden;
mod isolate;
mod judge;
mod metric;
mod options;
mod outcome;
mod picture;
mod property;
mod provenance;
mod relation;
mod report;
mod robust;
mod run;
mod session;
mod sessions;
mod shared;
mod shown_mistakes;
pub mod summary;
mod unchecked;

use std::path::Path;

pub use adapter::AdapterClass;
pub use codes::CODES;
pub use discover::{Found, discover};
pub use draw::Drawn;
pub use file::TestFile;
pub use metric::{Compared, Judgement, Metric};
pub use options::{Options, Robustness};
pub use outcome::{
    Check, GOLDEN, Outcome, PassOutcome, PortOutcome, Problem, Reach, RelationOutcome, State, Suspicion, UncheckedPort,
};
pub use picture::Picture;
pub use report::Report;
pub use session::{Plugins, Rendered, Saved, Session, Variation};
pub use sessions::Sessions;
pub use shared::Shared;
pub use shown_mistakes::ShownMistakes;

/// Runs the test in a file with these plugins: for a `#[test]` of a plugin's crate.
///
/// # Panics
/// Where the test does not pass, with what it found; where no adapter answers.
pub fn assert_passes(plugins: Plugins, path: impl AsRef<Path>) {
    let outcome = match Session::new(plugins, Vec::new(), None) {
        Ok(mut session) => session.run(path.as_ref(), &Options::default()),
        Err(error) => panic!("{error}"),
    };
    assert!(outcome.passed(), "{} failed\n{}", outcome.name(), outcome.text());
}
