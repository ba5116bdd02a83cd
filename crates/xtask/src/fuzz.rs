//! `cargo xtask fuzz`: files that are broken at random are read, drawn or refused.

use crate::command::{Failure, status, succeed};
use crate::workspace::Workspace;
use crate::{compiler, driver};

/// Where finds are kept, from the workspace's root.
const FINDS: &str = "target/fuzz";

/// Builds, makes sure that there is a driver, and breaks files as the arguments say: `--seconds 60`, say.
///
/// # Errors
/// If one of these fails, or something was found.
pub fn run(workspace: &Workspace, arguments: &[&str]) -> Result<(), Failure> {
    compiler::ensure()?;
    succeed(workspace.cargo().args(["build", "--release", "--workspace", "--bins"]))?;
    driver::ensure(workspace)?;
    campaign(workspace, arguments)
}

/// The same of what is built.
///
/// # Errors
/// If something was found.
pub fn campaign(workspace: &Workspace, arguments: &[&str]) -> Result<(), Failure> {
    let ended = status(workspace.program("tyndall-fuzz").args(arguments))?;
    match ended.code() {
        Some(0) => Ok(()),
        Some(1) => Err(Failure::check(format!("what was found is in {FINDS}"))),
        Some(2) => Err(Failure::usage("`cargo xtask fuzz` takes the options above")),
        _ => Err(Failure::check(format!("{ended}: the files that were at work are in {FINDS}/at-work-*"))),
    }
}
