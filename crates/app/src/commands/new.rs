//! `new`: commented files to start from.

use std::path::{Path, PathBuf};

use crate::cli::New;
use crate::failure::Failure;
use crate::terminal;

const GRAPH: &str = include_str!("../templates/new.graph.ron");
const GRAPH_SUFFIX: &str = ".graph.ron";
const SCENE_SUFFIX: &str = ".scene.ron";
const SCENE: &str = include_str!("../templates/new.scene.ron");

pub(crate) fn run(what: &New) -> Result<(), Failure> {
    match what {
        New::Graph { name } => {
            let graph = with_suffix(name, GRAPH_SUFFIX);
            let scene = sibling_scene(&graph);
            let file = scene.file_name().unwrap_or_default().to_string_lossy();
            create(&graph, &GRAPH.replace("NAME.scene.ron", &file))?;
            // A scene of this name may be somebody's work: the graph uses it as it is.
            if !scene.exists() {
                create(&scene, SCENE)?;
            }
            terminal::line(&format!("try:  tyndall render {}", graph.display()));
        }
        New::Scene { name } => {
            let path = with_suffix(name, SCENE_SUFFIX);
            create(&path, SCENE)?;
            terminal::line(&format!("try:  tyndall render GRAPH --scene {}", path.display()));
        }
    }
    Ok(())
}

/// The scene file beside a graph, of the same name.
fn sibling_scene(graph: &Path) -> PathBuf {
    let file = graph.file_name().unwrap_or_default().to_string_lossy();
    graph.with_file_name(format!("{}{SCENE_SUFFIX}", file.strip_suffix(GRAPH_SUFFIX).unwrap_or(&file)))
}

fn with_suffix(name: &Path, suffix: &str) -> PathBuf {
    let text = name.to_string_lossy();
    if text.ends_with(suffix) { name.to_owned() } else { PathBuf::from(format!("{text}{suffix}")) }
}

/// Writes a new file.
fn create(path: &Path, text: &str) -> Result<(), Failure> {
    if path.exists() {
        return Err(Failure::Usage(format!("{} exists already, and was not changed", path.display())));
    }
    tyndall_image::write_bytes(path, text.as_bytes())?;
    terminal::line(&format!("wrote {}", path.display()));
    Ok(())
}
