//! The project's commands: `cargo xtask demo`, `cargo xtask test` and `cargo xtask fuzz`.
//!
//! Each does all its own set-up on a fresh machine that has a Rust toolchain and git. Every other program that they
//! start is printed before it runs. Exit codes are those of `tyndall`: 0 done, 1 a check failed, 2 wrong usage,
//! 3 the machine cannot do it.

#![allow(clippy::print_stdout, reason = "a command-line tool prints to standard output")]

mod browser;
mod command;
mod compiler;
mod demo;
mod driver;
mod fuzz;
mod licences;
mod machine_paths;
mod one_version;
mod spdx;
mod system;
mod test;
mod test_output;
mod workspace;

use std::process::ExitCode;

use command::Failure;
use workspace::Workspace;

const USAGE: &str = "\
Usage: cargo xtask <demo|test|fuzz>

  demo   builds, makes sure that there is a GPU driver, renders the demo graphs into out/
  test   builds, makes sure that there are a GPU driver and a browser, runs every check and test
  fuzz   builds, and breaks files at random for so long: --seconds N [--seed SEED] [--cases N] [--kind KIND]

The environment variable TYNDALL_ASSETS names a folder of real models that some tests read; without it they do
not run, and `test` reports how many.";

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    match run(&arguments) {
        Ok(()) => ExitCode::SUCCESS,
        Err(failure) => {
            eprintln!("error: {}", failure.message);
            ExitCode::from(failure.exit_code)
        }
    }
}

fn run(arguments: &[String]) -> Result<(), Failure> {
    let arguments: Vec<&str> = arguments.iter().map(String::as_str).collect();
    match arguments[..] {
        ["demo"] => demo::run(&Workspace::here()?),
        ["test"] => test::run(&Workspace::here()?),
        ["fuzz", ref options @ ..] => fuzz::run(&Workspace::here()?, options),
        ["help" | "--help" | "-h"] => {
            println!("{USAGE}");
            Ok(())
        }
        [] => Err(Failure::usage(format!("no command given\n\n{USAGE}"))),
        [ref other, ..] => Err(Failure::usage(format!("unknown command `{other}`, or too many arguments\n\n{USAGE}"))),
    }
}
