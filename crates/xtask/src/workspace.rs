//! Where the sources and the built program are.

use std::path::{Path, PathBuf};
use std::process::Command;

use serde_json::Value;

use crate::command::{Failure, output};

/// The checkout that `cargo xtask` runs in.
pub struct Workspace {
    /// The folder of the workspace's `Cargo.toml`.
    pub root: PathBuf,
    /// The output of `cargo metadata`.
    pub metadata: Value,
}

impl Workspace {
    /// The workspace that this program was built in.
    ///
    /// # Errors
    /// If `cargo metadata` fails.
    pub fn here() -> Result<Self, Failure> {
        let crate_folder = std::env::var_os("CARGO_MANIFEST_DIR").map(PathBuf::from);
        let crate_folder = crate_folder.unwrap_or_else(|| PathBuf::from(env!("CARGO_MANIFEST_DIR")));
        let text = output(cargo().args(["metadata", "--format-version", "1"]).current_dir(crate_folder))?;
        let metadata: Value =
            serde_json::from_str(&text).map_err(|error| Failure::check(format!("cargo metadata: {error}")))?;
        let root = metadata["workspace_root"].as_str().map(PathBuf::from);
        let root = root.ok_or_else(|| Failure::check("cargo metadata names no workspace"))?;
        Ok(Self { root, metadata })
    }

    /// `cargo`, to be run in the workspace's root.
    pub fn cargo(&self) -> Command {
        let mut cargo = cargo();
        cargo.current_dir(&self.root);
        cargo
    }

    /// The built program, to be run in the workspace's root.
    pub fn tyndall(&self) -> Command {
        self.program("tyndall")
    }

    /// A built program of the workspace, to be run in the workspace's root.
    pub fn program(&self, name: &str) -> Command {
        let target = self.metadata["target_directory"].as_str().unwrap_or("target");
        let name = format!("{name}{}", std::env::consts::EXE_SUFFIX);
        let mut program = Command::new(Path::new(target).join("release").join(name));
        program.current_dir(&self.root);
        program
    }
}

fn cargo() -> Command {
    Command::new(std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into()))
}
