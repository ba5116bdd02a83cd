//! Reading a scene file: what decoders of its parts, those of plugins among them, are given.

mod values;

use std::ops::{Deref, DerefMut};
use std::path::{Path, PathBuf};

use tyndall_document::{Decoder, Diagnostic, Diagnostics, MISSING_FILE, Node};

pub use self::values::{
    COORDINATE, EXTINCTION, FARTHEST, LENGTH, POWER, Range, animated_direction, animated_number, animated_place,
    animated_power, direction, keys, number, numbers, vector,
};
use crate::extensions::Extensions;
use crate::field::{Fields, Holder};
use crate::overrides::Merged;

/// Reads nodes of a scene file: a [`Decoder`] that knows the fields of plugins, and where files are.
pub struct SceneReader<'a> {
    decoder: Decoder<'a>,
    merged: &'a Merged,
    folder: &'a Path,
    extensions: &'a Extensions,
    files: Vec<PathBuf>,
}

impl<'a> SceneReader<'a> {
    pub(crate) fn new(
        merged: &'a Merged,
        folder: &'a Path,
        extensions: &'a Extensions,
        out: &'a mut Diagnostics,
    ) -> Self {
        Self { decoder: Decoder::new(&merged.source, out), merged, folder, extensions, files: Vec::new() }
    }

    /// The path of a file that a string names, relative to the scene file (on the command line, to the working
    /// directory). The file belongs to the scene from now on: whoever watches the scene watches it. Reported where the
    /// node is not a string, or there is no such file.
    pub fn file(&mut self, node: &Node) -> Option<PathBuf> {
        let text = self.text(node)?;
        let path = self.merged.path(self.folder, text, node.span);
        self.files.push(path.clone());
        if path.is_file() {
            return Some(path);
        }
        let message = format!("there is no file `{}`", path.display());
        let place = self.place(node.span);
        self.report(Diagnostic::error(MISSING_FILE, place, message));
        None
    }

    /// The files that fields of plugins named.
    pub(crate) fn into_files(self) -> Vec<PathBuf> {
        self.files
    }

    /// The fields of a struct: those of the core, which are given back as nodes, and those that plugins bring, which
    /// are read, `None` where one has a mistake. `what` names the struct in messages, with its article.
    pub(crate) fn fields_of<'n>(
        &mut self,
        holder: Holder,
        node: &'n Node,
        what: &str,
        core: &[&str],
    ) -> Option<(tyndall_document::Fields<'n>, Option<Fields>)> {
        let extensions = self.extensions;
        let known: Vec<&str> = core.iter().copied().chain(extensions.fields(holder).map(|field| field.name)).collect();
        let fields = self.fields(node, what, &known)?;
        let mut found = Some(Fields::default());
        for field in extensions.fields(holder) {
            let Some(node) = fields.get(field.name) else { continue };
            match ((field.read)(self, node), &mut found) {
                (Some(value), Some(found)) => drop(found.0.insert(field.name, value)),
                _ => found = None,
            }
        }
        Some((fields, found))
    }
}

impl<'a> Deref for SceneReader<'a> {
    type Target = Decoder<'a>;

    fn deref(&self) -> &Decoder<'a> {
        &self.decoder
    }
}

impl<'a> DerefMut for SceneReader<'a> {
    fn deref_mut(&mut self) -> &mut Decoder<'a> {
        &mut self.decoder
    }
}
