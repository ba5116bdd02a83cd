//! Every `.test.ron` of the repository as a test of its own, by its name: for `cargo test` and nextest.
//!
//! Within one process the tests share results that are the same.

#![allow(clippy::unwrap_used, reason = "a test may panic")]

use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::sync::{Arc, Mutex, PoisonError};

use libtest_mimic::{Arguments, Failed, Trial};
use tyndall_plugin::SearchPath;
use tyndall_testing::{Found, Options, Sessions, ShownMistakes, discover};
use tyndall_tests::root;

fn main() -> ExitCode {
    // Paths in tests and messages are as a user at the root of the repository writes them.
    std::env::set_current_dir(root()).unwrap();
    let Found { tests, orphans } = discover(&[PathBuf::from(".")]).unwrap();
    assert!(!tests.is_empty(), "the repository has no image test");
    // As the program looks for plugins where it is started.
    let search = vec![SearchPath { path: PathBuf::from("plugins"), required: false }];
    let shared = Arc::new((Sessions::new(tyndall::shipped(), search), Mutex::new(ShownMistakes::default())));
    let trial = |path: PathBuf| {
        let shared = shared.clone();
        Trial::test(name(&path), move || run(&shared.0, &shared.1, &path))
    };
    let orphaned = |path: PathBuf| {
        let message = format!("{} holds goldens of no test", path.display());
        Trial::test(name(&path), move || Err(Failed::from(message)))
    };
    let trials = tests.into_iter().map(trial).chain(orphans.into_iter().map(orphaned)).collect();
    libtest_mimic::run(&Arguments::from_args(), trials).exit_code()
}

fn name(path: &Path) -> String {
    let name = path.display().to_string().replace('\\', "/");
    name.strip_suffix(".test.ron").unwrap_or(&name).to_owned()
}

fn run(sessions: &Sessions, shown: &Mutex<ShownMistakes>, path: &Path) -> Result<(), Failed> {
    let outcome = sessions.with(|session| session.run(path, &Options::default()))?;
    if outcome.passed() {
        return Ok(());
    }
    Err(Failed::from(shown.lock().unwrap_or_else(PoisonError::into_inner).text(&outcome)))
}
