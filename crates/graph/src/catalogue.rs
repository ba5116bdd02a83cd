//! Every pass that a graph file may use, by name.

use std::path::Path;
use std::sync::{Arc, LazyLock};

use rustc_hash::FxHashMap;
use tyndall_document::Diagnostics;

use crate::descriptor::PassDescriptor;
use crate::signature::{DescriptorError, Signature};

/// Width and height in texels of the picture in a file; `None` if it is not a readable picture.
pub type PictureSize = fn(&Path) -> Option<(u32, u32)>;

/// Every pass by name. All names are known from the start; a descriptor is made when a graph first uses its pass, once
/// for all clones of the catalogue.
#[derive(Debug, Clone, Default)]
pub struct Catalogue {
    /// Gives the sizes of pictures in files, for passes whose ports have their size.
    pub picture_size: Option<PictureSize>,
    kinds: FxHashMap<String, Arc<LazyKind>>,
    plugins: FxHashMap<String, PluginEntry>,
    /// Mistakes that hide which passes there are.
    unread: Diagnostics,
}

type LazyKind = LazyLock<Result<Arc<Kind>, Diagnostics>, MakeKind>;
type MakeKind = Box<dyn FnOnce() -> Result<Arc<Kind>, Diagnostics> + Send>;

/// What is known of the passes of a plugin together.
#[derive(Debug, Clone)]
struct PluginEntry {
    manifest: Option<String>,
    mistakes: Diagnostics,
}

/// A descriptor that does not contradict itself, and what validation and planning read instead of its names.
#[derive(Debug)]
pub struct Kind {
    pub(crate) descriptor: Arc<PassDescriptor>,
    pub(crate) signature: Signature,
}

impl Kind {
    /// Checks a descriptor.
    ///
    /// # Errors
    /// Everything that contradicts itself in it.
    pub fn new(descriptor: Arc<PassDescriptor>) -> Result<Self, Vec<DescriptorError>> {
        let signature = Signature::of(&descriptor)?;
        Ok(Self { descriptor, signature })
    }

    /// The descriptor.
    pub fn descriptor(&self) -> &Arc<PassDescriptor> {
        &self.descriptor
    }
}

impl Catalogue {
    /// A catalogue without passes.
    pub fn new() -> Self {
        Self::default()
    }

    /// Adds a pass whose descriptor is known.
    ///
    /// # Errors
    /// Every contradiction in the descriptor, or that there already is a pass of this name. Then the catalogue is
    /// unchanged.
    pub fn insert(&mut self, descriptor: Arc<PassDescriptor>) -> Result<(), Vec<DescriptorError>> {
        if self.kinds.contains_key(&descriptor.name) {
            return Err(vec![DescriptorError::DuplicatePass(descriptor.name.clone())]);
        }
        let kind = Arc::new(Kind::new(descriptor)?);
        self.insert_lazy(&kind.descriptor.name.clone(), move || Ok(kind));
        Ok(())
    }

    /// Adds a pass whose descriptor is made when a graph first uses it; where that fails, a graph that uses the pass has
    /// these mistakes. Takes the place of a pass of the same name.
    pub fn insert_lazy(&mut self, name: &str, make: impl FnOnce() -> Result<Arc<Kind>, Diagnostics> + Send + 'static) {
        self.kinds.insert(name.to_owned(), Arc::new(LazyLock::new(Box::new(make))));
    }

    /// Says which file declares the passes of a plugin (`plugin.pass`), where a user can look at it, and what is wrong
    /// there: a graph that uses a pass of the plugin which is not in the catalogue has these mistakes.
    pub fn insert_plugin(&mut self, plugin: &str, manifest: Option<String>, mistakes: Diagnostics) {
        self.plugins.insert(plugin.to_owned(), PluginEntry { manifest, mistakes });
    }

    /// Adds mistakes of a file that declares passes of a plugin whose name cannot be read: they are told with every pass
    /// that is not found.
    pub fn insert_unread(&mut self, mistakes: Diagnostics) {
        self.unread.extend(mistakes);
    }

    /// The pass of this name; where it or the plugin that should declare it is broken, every mistake.
    pub fn get(&self, name: &str) -> Option<Result<&Arc<PassDescriptor>, &Diagnostics>> {
        Some(self.kind(name)?.map(|kind| &kind.descriptor))
    }

    /// All names, sorted.
    pub fn names(&self) -> Vec<&str> {
        let mut names: Vec<&str> = self.kinds.keys().map(String::as_str).collect();
        names.sort_unstable();
        names
    }

    pub(crate) fn kind(&self, name: &str) -> Option<Result<&Arc<Kind>, &Diagnostics>> {
        if let Some(kind) = self.kinds.get(name) {
            return Some((***kind).as_ref());
        }
        let mistakes = &self.plugin_of(name)?.mistakes;
        mistakes.has_errors().then_some(Err(mistakes))
    }

    /// The file that should declare a pass of this name.
    pub(crate) fn manifest_of(&self, name: &str) -> Option<&str> {
        self.plugin_of(name)?.manifest.as_deref()
    }

    pub(crate) fn unread(&self) -> &Diagnostics {
        &self.unread
    }

    fn plugin_of(&self, name: &str) -> Option<&PluginEntry> {
        self.plugins.get(name.split_once('.')?.0)
    }
}
