//! `tyndall` with the plugins that it ships.

use std::process::ExitCode;

fn main() -> ExitCode {
    tyndall::App::new().run()
}
