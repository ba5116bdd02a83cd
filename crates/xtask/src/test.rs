//! `cargo xtask test`: every check and every test, all built in the one profile `release`.

use std::io::{BufRead, BufReader};
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

use crate::command::{Failure, announce, not_started, succeed, works};
use crate::machine_paths::{Found, search};
use crate::test_output::Tally;
use crate::workspace::Workspace;
use crate::{browser, compiler, driver, fuzz, licences, one_version};

/// The environment variable that names the folder of real models.
const ASSETS: &str = "TYNDALL_ASSETS";

/// Runs everything, and ends with how long each step took and `N passed, N failed`. What fails does not keep later
/// steps from running, unless they cannot run without it.
///
/// # Errors
/// If a check or a test failed, or the machine lacks a GPU driver or a browser that cannot be installed.
pub fn run(workspace: &Workspace) -> Result<(), Failure> {
    check_assets()?;
    let mut report = Report::default();
    let mut tally = Tally::default();
    // What takes seconds to a minute and often fails stands first.
    report.tool("format", "fmt", "rustfmt", workspace, |cargo| cargo.args(["fmt", "--all", "--check"]));
    report.step("repository", || repository(workspace));
    if let Err(failure) = report.timed("compiler", compiler::ensure) {
        report.print(tally);
        return Err(failure);
    }
    report.tool("clippy", "clippy", "clippy", workspace, |cargo| {
        cargo.args(["clippy", "--release", "--workspace", "--all-targets", "--", "-D", "warnings"])
    });
    report.step("documentation", || {
        let mut doc = workspace.cargo();
        succeed(doc.args(["doc", "--release", "--workspace", "--no-deps"]).env("RUSTDOCFLAGS", "-D warnings"))
    });
    let set_up = report
        .timed("build", || build(workspace))
        .and_then(|()| report.timed("driver", || driver::ensure(workspace)))
        .and_then(|()| report.timed("browser", browser::ensure));
    if let Err(failure) = set_up {
        report.print(tally);
        return Err(failure);
    }
    report.step("tests", || tests(workspace, &mut tally));
    report.step("robustness", || robustness(workspace));
    report.step("fuzz", || fuzz::campaign(workspace, &["--seconds", "30", "--seed", "1"]));
    match report.print(tally) {
        0 => Ok(()),
        _ => Err(Failure::check("not everything passed")),
    }
}

/// A folder that is named must be there; tests that need it do not silently stay away.
fn check_assets() -> Result<(), Failure> {
    match std::env::var_os(ASSETS) {
        Some(folder) if !std::path::Path::new(&folder).is_dir() => {
            Err(Failure::usage(format!("{ASSETS} names {}, which is not a folder", folder.to_string_lossy())))
        }
        _ => Ok(()),
    }
}

/// Licences, versions and machine paths.
fn repository(workspace: &Workspace) -> Result<(), Failure> {
    let mut mistakes = licences::check(&workspace.metadata).err().unwrap_or_default();
    let lock = std::fs::read_to_string(workspace.root.join("Cargo.lock"))
        .map_err(|error| Failure::check(format!("Cargo.lock: {error}")))?;
    mistakes.extend(one_version::check(&lock).err().unwrap_or_default());
    match search(&workspace.root) {
        Found::Nothing => {}
        Found::Paths(lines) => mistakes.extend(lines.into_iter().map(|line| format!("a machine's path: {line}"))),
        Found::NotSearched => println!("not run: the search for machine paths (it needs git and a checkout)"),
    }
    if mistakes.is_empty() { Ok(()) } else { Err(Failure::check(mistakes.join("\n"))) }
}

/// Builds every test, and with them the program. Not the program by itself: tests turn on features of other crates, and
/// those would be built a second time.
fn build(workspace: &Workspace) -> Result<(), Failure> {
    succeed(workspace.cargo().args(["test", "--release", "--workspace", "--no-run"]))
}

/// The image tests once more, small: in another order, from poisoned memory, with and without sharing, twice. What passes
/// should compute is asked by the tests themselves; here every way must come out the same.
fn robustness(workspace: &Workspace) -> Result<(), Failure> {
    let mut tests = workspace.tyndall();
    tests.args(["test", "--at-most", "31x31", "--no-references", "--shuffle", "1", "--poison", "--no-sharing"]);
    tests.args(["--repeat", "2"]);
    succeed(tests.current_dir(&workspace.root))
}

/// `cargo test`, its output passed on and counted.
fn tests(workspace: &Workspace, tally: &mut Tally) -> Result<(), Failure> {
    let mut command = workspace.cargo();
    command.args(["test", "--release", "--workspace", "--no-fail-fast"]).stdout(Stdio::piped());
    announce(&command);
    let mut child = command.spawn().map_err(|error| not_started(&command, &error))?;
    if let Some(out) = child.stdout.take() {
        // Lines as bytes: a test may print text that is not UTF-8.
        for line in BufReader::new(out).split(b'\n').map_while(Result::ok) {
            let line = String::from_utf8_lossy(&line);
            println!("{line}");
            tally.read(&line);
        }
    }
    let status = child.wait().map_err(|error| not_started(&command, &error))?;
    match (status.success(), tally.programs) {
        (true, 0) => Err(Failure::check("no test ran")),
        (true, _) => Ok(()),
        (false, _) => Err(Failure::check(format!("cargo test: {status}, {} tests failed", tally.failed))),
    }
}

/// What ran, for how long, and what failed.
#[derive(Default)]
struct Report {
    steps: Vec<(&'static str, Duration, Outcome)>,
}

#[derive(Clone, Copy, PartialEq, Eq)]
enum Outcome {
    Passed,
    Failed,
    NotRun,
}

impl Report {
    /// Runs a step; a failure is printed and kept.
    fn step(&mut self, name: &'static str, run: impl FnOnce() -> Result<(), Failure>) {
        if let Err(failure) = self.timed(name, run) {
            println!("{name} failed: {}", failure.message);
        }
    }

    /// Runs a tool of the toolchain that not every installation has.
    fn tool(
        &mut self,
        name: &'static str,
        verb: &str,
        component: &str,
        workspace: &Workspace,
        arguments: impl FnOnce(&mut Command) -> &mut Command,
    ) {
        let there = || works(workspace.cargo().args([verb, "--version"]));
        if !there() && works(Command::new("rustup").arg("--version")) {
            let _ = succeed(Command::new("rustup").args(["component", "add", component]));
        }
        if there() {
            self.step(name, || succeed(arguments(&mut workspace.cargo())));
        } else {
            println!("not run: {name} (add it to the toolchain: rustup component add {component})");
            self.steps.push((name, Duration::ZERO, Outcome::NotRun));
        }
    }

    /// Runs a step and keeps how it went.
    fn timed(&mut self, name: &'static str, run: impl FnOnce() -> Result<(), Failure>) -> Result<(), Failure> {
        println!("\n== {name}");
        let start = Instant::now();
        let result = run();
        let outcome = if result.is_ok() { Outcome::Passed } else { Outcome::Failed };
        self.steps.push((name, start.elapsed(), outcome));
        result
    }

    /// Prints the table and the last line; how much failed.
    fn print(&self, tally: Tally) -> usize {
        println!();
        for (name, time, outcome) in &self.steps {
            let outcome = match outcome {
                Outcome::Passed => "",
                Outcome::Failed => "  FAILED",
                Outcome::NotRun => "  not run",
            };
            println!("{name:<14} {:>7.1} s{outcome}", time.as_secs_f64());
        }
        if tally.without_assets > 0 {
            println!("{} tests did not run: they read the folder that {ASSETS} names", tally.without_assets);
        }
        if tally.ignored > 0 {
            println!("{} tests are marked to be ignored", tally.ignored);
        }
        let failed = failures(&tally, &self.steps);
        println!("{} passed, {failed} failed", tally.passed);
        failed
    }
}

/// Failed tests, and failed steps: that of the tests counts where no single test is to blame (it did not build, say).
fn failures(tally: &Tally, steps: &[(&str, Duration, Outcome)]) -> usize {
    let failed = steps
        .iter()
        .filter(|(name, _, outcome)| *outcome == Outcome::Failed && (*name != "tests" || tally.failed == 0));
    tally.failed + failed.count()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn failing_steps_count_also_where_no_test_does() {
        let step = |name: &'static str, outcome: Outcome| (name, Duration::ZERO, outcome);
        let failed = Tally { passed: 3, failed: 2, ..Tally::default() };
        let fine = Tally { passed: 5, ..Tally::default() };
        assert_eq!(failures(&fine, &[step("tests", Outcome::Passed), step("clippy", Outcome::NotRun)]), 0);
        assert_eq!(failures(&failed, &[step("tests", Outcome::Failed)]), 2);
        assert_eq!(failures(&fine, &[step("tests", Outcome::Failed), step("clippy", Outcome::Failed)]), 2);
    }
}
