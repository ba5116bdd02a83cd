//! The files of a plugin: embedded in the program, or on disk.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use tyndall_document::{Diagnostic, Place, Source};
use tyndall_shader::Library;

use crate::codes::UNREADABLE_PLUGIN;

/// Where a plugin's files come from.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Origin {
    /// Compiled into the program.
    BuiltIn,
    /// This folder.
    Folder(PathBuf),
}

/// A plugin's manifest and shaders.
#[derive(Debug, Clone)]
pub struct Folder {
    /// Where they come from.
    pub origin: Origin,
    /// Number of the search path that it was found on: of two plugins of one name, the one on the lower path wins.
    pub(crate) path: usize,
    pub(crate) files: BTreeMap<String, Arc<Source>>,
    /// Why files are not there that should be.
    pub(crate) unreadable: Vec<Diagnostic>,
}

/// Name of the manifest in a plugin's folder.
pub(crate) const MANIFEST: &str = "plugin.ron";

impl Folder {
    /// Files that were compiled in: names and texts. `name` is the plugin's, for messages. See [`crate::folder!`].
    pub fn embedded(name: &str, files: &[(&str, &str)]) -> Self {
        let source = |(file, text): &(&str, &str)| {
            ((*file).to_owned(), Source::new(format!("plugins/{name}/{file}"), (*text).to_owned()))
        };
        let files = files.iter().map(source).collect();
        Self { origin: Origin::BuiltIn, path: 0, files, unreadable: Vec::new() }
    }

    /// The manifest and all WGSL files of a folder on disk (not of folders in it). What cannot be read is a mistake of
    /// the plugin, told where it is used.
    pub fn read(path: &Path) -> Self {
        let mut folder =
            Self { origin: Origin::Folder(path.to_owned()), path: 0, files: BTreeMap::new(), unreadable: Vec::new() };
        match std::fs::read_dir(path).and_then(Iterator::collect::<std::io::Result<Vec<_>>>) {
            Ok(entries) => entries.iter().for_each(|entry| folder.read_file(&entry.path())),
            Err(error) => {
                let message = format!("the plugin's folder cannot be read: {error}");
                let place = Place::File(path.display().to_string());
                folder.unreadable.push(Diagnostic::error(UNREADABLE_PLUGIN, place, message));
            }
        }
        folder
    }

    fn read_file(&mut self, file: &Path) {
        let Some(name) = file.file_name().and_then(|name| name.to_str()) else { return };
        if name != MANIFEST && !name.ends_with(".wgsl") {
            return;
        }
        match Source::read(file) {
            Ok(source) => drop(self.files.insert(name.to_owned(), source)),
            Err(problem) => self.unreadable.push(problem),
        }
    }

    /// The folder's own name: a plugin's folder is usually called like the plugin.
    pub(crate) fn name(&self) -> String {
        match &self.origin {
            Origin::Folder(path) => path.file_name().unwrap_or_default().to_string_lossy().into_owned(),
            Origin::BuiltIn => String::new(),
        }
    }

    /// The manifest's path, where a user can look at it.
    pub(crate) fn manifest_path(&self) -> Option<String> {
        match &self.origin {
            Origin::Folder(path) => Some(path.join(MANIFEST).display().to_string()),
            Origin::BuiltIn => None,
        }
    }

    /// A file by its name.
    pub fn file(&self, name: &str) -> Option<&Arc<Source>> {
        self.files.get(name)
    }

    /// What the shaders of this folder may import: shared modules, and its own files.
    pub(crate) fn library(&self, shared: &Library) -> Library {
        let mut library = shared.clone();
        for (name, source) in self.files.iter().filter(|(name, _)| name.ends_with(".wgsl")) {
            library.insert_file(name, source.clone());
        }
        library
    }
}

/// Embeds a plugin's files: `folder!("core": "plugin.ron", "add.wgsl")`, paths relative to the crate's root.
#[macro_export]
macro_rules! folder {
    ($plugin:literal : $($file:literal),+ $(,)?) => {
        $crate::Folder::embedded(
            $plugin,
            &[$(($file, include_str!(concat!(env!("CARGO_MANIFEST_DIR"), "/", $file)))),+],
        )
    };
}
