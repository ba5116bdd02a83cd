//! Writes the demo model: `cargo run --release -p tyndall-scene --example pavilion [FILE]`.
//!
//! Without a file it writes `graphs/scenes/models/pavilion.glb`, from the workspace's root.

mod build;
mod glb;
mod model;
mod pictures;

use std::process::ExitCode;

fn main() -> ExitCode {
    let path = std::env::args().nth(1).unwrap_or("graphs/scenes/models/pavilion.glb".to_owned());
    match std::fs::write(&path, model::pavilion()) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("{path}: {error}");
            ExitCode::from(2)
        }
    }
}
