//! `new`: commented files to start from.

use std::path::{Path, PathBuf};

use crate::cli::New;
use crate::failure::Failure;
use crate::terminal;

const GRAPH: &str = include_str!("../templates/new.graph.ron");
const SCENE: &str = include_str!("../templates/new.scene.ron");

pub(crate) fn run(what: &New) -> Result<(), Failure> {
    match what {
        New::Graph { name } => {
            let path = with_suffix(name, ".graph.ron");
            create(&path, GRAPH)?;
            terminal::line(&format!("wrote {}", path.display()));
            terminal::line(&format!("try:  tyndall render {} --scene FILE", path.display()));
        }
        New::Scene { name } => {
            let path = with_suffix(name, ".scene.ron");
            create(&path, SCENE)?;
            terminal::line(&format!("wrote {}", path.display()));
            terminal::line(&format!("try:  tyndall render GRAPH --scene {}", path.display()));
        }
    }
    Ok(())
}

fn with_suffix(name: &Path, suffix: &str) -> PathBuf {
    let text = name.to_string_lossy();
    if text.ends_with(suffix) { name.to_owned() } else { PathBuf::from(format!("{text}{suffix}")) }
}

/// Writes a file that is not there yet.
fn create(path: &Path, text: &str) -> Result<(), Failure> {
    if path.exists() {
        return Err(Failure::Usage(format!("{} is there already, and nothing was changed", path.display())));
    }
    Ok(tyndall_image::write_bytes(path, text.as_bytes())?)
}
