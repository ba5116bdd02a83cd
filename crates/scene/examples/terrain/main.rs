//! Writes the mountains of `graphs/aerial-perspective.graph.ron`:
//! `cargo run --release -p tyndall-scene --example terrain [FILE]`.
//!
//! Without a file it writes `graphs/scenes/models/terrain.glb`, from the workspace's root.

mod erosion;
#[path = "../pavilion/glb.rs"]
#[allow(dead_code, reason = "the pavilion uses more of it")]
mod glb;
mod model;
mod noise;

use std::process::ExitCode;

fn main() -> ExitCode {
    let path = std::env::args().nth(1).unwrap_or("graphs/scenes/models/terrain.glb".to_owned());
    match std::fs::write(&path, model::terrain()) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("{path}: {error}");
            ExitCode::from(2)
        }
    }
}
