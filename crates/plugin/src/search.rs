//! Where plugins are looked for at run time.

use std::path::{Path, PathBuf};

use tyndall_document::{Diagnostic, Place, Source};
use tyndall_shader::Library;

use crate::codes::UNREADABLE_PLUGIN;
use crate::folder::{Folder, MANIFEST};

/// A folder whose sub-folders are plugins, or that is one itself.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct SearchPath {
    /// The folder.
    pub path: PathBuf,
    /// Somebody named it, so it is a mistake if it is not there or holds no plugin.
    pub required: bool,
}

/// The plugin folders under the search paths, in order of path, then of name. All of them: which of two plugins of one
/// name wins is [`crate::Registry::new`]'s to say, since names stand in manifests.
///
/// # Errors
/// Required paths without a plugin. What cannot be read in a folder is a mistake of its plugin.
pub fn find_folders(paths: &[SearchPath]) -> Result<Vec<Folder>, Vec<Diagnostic>> {
    let (mut found, mut problems) = (Vec::new(), Vec::new());
    let mut seen = Vec::new();
    for (index, search) in paths.iter().enumerate() {
        let folders = plugin_folders(&search.path);
        if folders.is_empty() && search.required {
            let place = Place::File(search.path.display().to_string());
            let message = format!("no plugin is there: neither it nor a folder in it holds a `{MANIFEST}`");
            problems.push(Diagnostic::error(UNREADABLE_PLUGIN, place, message));
        }
        for folder in folders {
            let identity = folder.canonicalize().unwrap_or_else(|_| folder.clone());
            if seen.contains(&identity) {
                continue;
            }
            seen.push(identity);
            found.push(Folder { path: index, ..Folder::read(&folder) });
        }
    }
    if problems.is_empty() { Ok(found) } else { Err(problems) }
}

fn plugin_folders(path: &Path) -> Vec<PathBuf> {
    if path.join(MANIFEST).is_file() {
        return vec![path.to_owned()];
    }
    let entries = std::fs::read_dir(path).into_iter().flatten().flatten().map(|entry| entry.path());
    let mut folders: Vec<PathBuf> = entries.filter(|folder| folder.join(MANIFEST).is_file()).collect();
    folders.sort();
    folders
}

/// The shared modules: those compiled in, and over them those of a `shaders` folder beside each search path; as with
/// plugins, an earlier path wins.
///
/// # Errors
/// Files that cannot be read.
pub fn shader_modules(built_in: &[(&str, &str)], paths: &[SearchPath]) -> Result<Library, Vec<Diagnostic>> {
    let mut library = Library::default();
    for (name, text) in built_in {
        library.insert(name, Source::new(format!("shaders/{name}.wgsl"), (*text).to_owned()));
    }
    let mut problems = Vec::new();
    for search in paths.iter().rev() {
        let Some(folder) = search.path.parent().map(|parent| parent.join("shaders")) else { continue };
        let entries = std::fs::read_dir(&folder).into_iter().flatten().flatten().map(|entry| entry.path());
        let mut files: Vec<PathBuf> = entries.filter(|file| file.extension().is_some_and(|e| e == "wgsl")).collect();
        files.sort();
        for file in files {
            match (file.file_stem().and_then(|stem| stem.to_str()), Source::read(&file)) {
                (Some(name), Ok(source)) => library.insert(name, source),
                (_, Err(problem)) => problems.push(problem),
                (None, Ok(_)) => {}
            }
        }
    }
    if problems.is_empty() { Ok(library) } else { Err(problems) }
}
