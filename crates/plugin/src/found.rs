//! Which plugins there are: of several of one name, one is taken.

use tyndall_document::{Diagnostic, Diagnostics, Place};
use tyndall_scene::Extensions;

use crate::codes::DUPLICATE_PLUGIN;
use crate::folder::{Folder, MANIFEST};
use crate::manifest::{self, Manifest};

/// A plugin whose manifest was read.
pub(crate) struct Found {
    /// As its manifest says; where that cannot be read, the one that it was looked for under.
    pub name: String,
    /// The manifest says the name.
    pub is_named: bool,
    /// `None` where it cannot be read.
    pub manifest: Option<Manifest>,
    pub folder: Folder,
    /// Of the manifest and of files that cannot be read.
    pub mistakes: Diagnostics,
}

impl Found {
    /// Reads the manifest of a folder that is looked for under a name; `None` where it is not there.
    pub fn read(folder: Folder, name: &str, extensions: &Extensions) -> Option<Self> {
        let mut mistakes: Diagnostics = folder.unreadable.iter().cloned().collect();
        let (said, manifest) = match folder.file(MANIFEST) {
            Some(source) => manifest::read(source, extensions, &mut mistakes),
            None if mistakes.has_errors() => (None, None),
            None => return None,
        };
        let is_named = said.is_some();
        Some(Self { name: said.unwrap_or_else(|| name.to_owned()), is_named, manifest, folder, mistakes })
    }

    /// Its manifest.
    pub fn place(&self) -> Place {
        Place::File(self.folder.file(MANIFEST).map_or_else(|| self.folder.name(), |source| source.name().to_owned()))
    }
}

/// Reads the manifests of folders, which stand in order of search path. Of several plugins of one name the first is taken,
/// broken or not; another one on the same path is a mistake of both. With the mistakes of those that are not taken.
pub(crate) fn winners(folders: Vec<Folder>, extensions: &Extensions) -> (Vec<Found>, Diagnostics) {
    let mut winners: Vec<Found> = Vec::new();
    let mut mistakes = Diagnostics::default();
    for folder in folders {
        let name = folder.name();
        let Some(found) = Found::read(folder, &name, extensions) else { continue };
        match winners.iter_mut().find(|winner| winner.name == found.name) {
            None => winners.push(found),
            Some(winner) if winner.folder.path < found.folder.path => mistakes.extend(found.mistakes),
            Some(winner) => {
                let message = format!("there are two plugins named `{}`", found.name);
                let problem = Diagnostic::error(DUPLICATE_PLUGIN, found.place(), message);
                winner.mistakes.push(problem.relate(winner.place(), "the first one"));
                winner.mistakes.extend(found.mistakes);
            }
        }
    }
    (winners, mistakes)
}
