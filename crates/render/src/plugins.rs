//! The registry of a run.

use std::path::Path;

use tyndall_document::Diagnostics;
use tyndall_plugin::{Plugin, Registry, SearchPath, find_folders, shader_modules};

/// Every pass: those of crates, and those of the folders on the search paths, which win. None is linked yet.
///
/// # Errors
/// Search paths that somebody named and that hold no plugin, shared shaders that cannot be read.
pub fn registry(crates: Vec<Plugin>, paths: &[SearchPath]) -> Result<Registry, Diagnostics> {
    let collected = |mistakes: Vec<_>| mistakes.into_iter().collect::<Diagnostics>();
    let folders = find_folders(paths).map_err(collected)?;
    let shared = shader_modules(tyndall_shaders::MODULES, paths).map_err(collected)?;
    let registry = Registry::new(crates, folders, &shared);
    Ok(registry.with_picture_size(picture_size))
}

fn picture_size(path: &Path) -> Option<(u32, u32)> {
    tyndall_image::read(path).ok().map(|picture| (picture.width, picture.height))
}
