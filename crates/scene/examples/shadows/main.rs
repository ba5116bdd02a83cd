//! Writes the models of `graphs/scenes/shadows`: `cargo run --release -p tyndall-scene --example shadows [FOLDER]`.
//!
//! Without a folder it writes into `graphs/scenes/shadows/models`, from the workspace's root.

mod amphora;
mod columns;
#[path = "../pavilion/glb.rs"]
#[allow(dead_code, reason = "the pavilion uses more of it")]
mod glb;
mod pen;
mod skin;
mod tree;

use std::path::Path;
use std::process::ExitCode;

fn main() -> ExitCode {
    let folder = std::env::args().nth(1).unwrap_or("graphs/scenes/shadows/models".to_owned());
    let models =
        [("amphora", amphora::amphora()), ("columns", columns::columns()), ("tree", tree::tree()), ("pen", pen::pen())];
    for (name, bytes) in models {
        let path = Path::new(&folder).join(name).with_extension("glb");
        if let Err(error) = std::fs::write(&path, bytes) {
            eprintln!("{}: {error}", path.display());
            return ExitCode::from(2);
        }
    }
    ExitCode::SUCCESS
}
