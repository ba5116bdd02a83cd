//! The modules that a shader may import.

use std::collections::BTreeMap;
use std::path::Path;
use std::sync::Arc;

use tyndall_document::{Diagnostic, Source};

/// Shared modules by name (`#import phase`) and files of the importing plugin's folder (`#import "march.wgsl"`).
///
/// A plugin starts from a clone of the library of shared modules (sources are shared, so that is cheap) and adds its
/// own files.
#[derive(Debug, Clone, Default)]
pub struct Library {
    modules: BTreeMap<String, Arc<Source>>,
    files: BTreeMap<String, Arc<Source>>,
}

impl Library {
    /// Adds the shared module that `#import name` means: `phase` for `shaders/phase.wgsl`.
    pub fn insert(&mut self, name: &str, source: Arc<Source>) {
        self.modules.insert(name.to_owned(), source);
    }

    /// Adds a file of the plugin's folder, under its path in that folder with `/` between its parts.
    pub fn insert_file(&mut self, path: &str, source: Arc<Source>) {
        self.files.insert(path.to_owned(), source);
    }

    /// Adds every `.wgsl` file that lies in a folder (not in folders below it) as a file of the plugin.
    ///
    /// # Errors
    /// The first file that cannot be read. A folder that cannot be listed counts as empty.
    pub fn read_folder(&mut self, folder: &Path) -> Result<(), Diagnostic> {
        let mut paths: Vec<_> = std::fs::read_dir(folder).into_iter().flatten().flatten().map(|e| e.path()).collect();
        paths.sort();
        for path in paths.iter().filter(|path| path.extension().is_some_and(|extension| extension == "wgsl")) {
            if let Some(name) = path.file_name().and_then(|name| name.to_str()) {
                self.insert_file(name, Source::read(path)?);
            }
        }
        Ok(())
    }

    /// The shared module of this name.
    pub fn module(&self, name: &str) -> Option<&Arc<Source>> {
        self.modules.get(name)
    }

    /// The plugin's file of this path.
    pub fn file(&self, path: &str) -> Option<&Arc<Source>> {
        self.files.get(path)
    }

    /// Names of the shared modules, sorted.
    pub fn module_names(&self) -> impl Iterator<Item = &str> + Clone {
        self.modules.keys().map(String::as_str)
    }

    /// Paths of the plugin's files, sorted.
    pub fn file_names(&self) -> impl Iterator<Item = &str> + Clone {
        self.files.keys().map(String::as_str)
    }
}
