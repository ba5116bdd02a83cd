//! The registry of a run: the program's own plugins, and those found at run time.

use std::path::{Path, PathBuf};

use tyndall_plugin::{Registry, SearchPath};

use crate::App;
use crate::cli::Arguments;
use crate::failure::Failure;

/// The environment variable with further folders, separated as in `PATH`.
const PLUGIN_PATH: &str = "TYNDALL_PLUGIN_PATH";

/// Every pass that is found, none of them linked yet. `beside` are files whose folders may hold a `plugins` folder.
pub(crate) fn registry(app: &App, arguments: &Arguments, beside: &[&Path]) -> Result<Registry, Failure> {
    let paths = search_paths(arguments, beside);
    let crates = app.plugins.iter().map(|plugin| plugin()).collect();
    Ok(tyndall_render::registry(crates, &paths)?)
}

/// Where plugins are looked for: the command line, the environment, `plugins` beside the graph, `plugins` in the working
/// directory.
pub(crate) fn search_paths(arguments: &Arguments, beside: &[&Path]) -> Vec<SearchPath> {
    let required = |path: PathBuf| SearchPath { path, required: true };
    let usual = |path: PathBuf| SearchPath { path, required: false };
    let mut paths: Vec<SearchPath> = arguments.plugin_path.iter().cloned().map(required).collect();
    if let Some(more) = std::env::var_os(PLUGIN_PATH) {
        paths.extend(std::env::split_paths(&more).filter(|path| !path.as_os_str().is_empty()).map(required));
    }
    for file in beside {
        paths.push(usual(file.parent().unwrap_or(Path::new("")).join("plugins")));
    }
    paths.push(usual(PathBuf::from("plugins")));
    paths
}
