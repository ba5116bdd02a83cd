//! Every pass that a graph can use, linked and checked when a graph first uses it, and how to make each ready.

use std::collections::BTreeMap;
use std::sync::{Arc, LazyLock};

use tyndall_document::{Diagnostic, Diagnostics, near};
use tyndall_gpu::{GpuError, Program, Programs, Setup};
use tyndall_graph::descriptor::PassDescriptor;
use tyndall_graph::{Catalogue, Kind, PictureSize};
use tyndall_scene::Extensions;
use tyndall_shader::{Library, Linked};

use crate::codes::SCENE_CLASH;
use crate::dispatch;
use crate::folder::{Folder, Origin};
use crate::found::{self, Found};
use crate::limits::Limit;
use crate::linker::{Linker, Make, fingerprint};
use crate::manifest::Version;
use crate::pass::{Plugin, RustPass, Shaders};
use crate::ports::Need;
use crate::reference::Reference;

/// Every pass of every plugin. The names of all passes are known from the manifests; a pass is linked and checked when a
/// graph first uses it, once for all clones of the registry. So a mistake in a plugin is told where its passes are used,
/// and by [`Self::mistakes`].
#[derive(Clone, Default)]
pub struct Registry {
    catalogue: Catalogue,
    extensions: Arc<Extensions>,
    passes: BTreeMap<String, Arc<LazyPass>>,
    /// Of manifests and folders.
    mistakes: Diagnostics,
}

type LazyPass = LazyLock<Result<RegistryPass, Diagnostics>, LinkPass>;
type LinkPass = Box<dyn FnOnce() -> Result<RegistryPass, Diagnostics> + Send>;

/// A pass that is ready to be used in graphs.
#[derive(Clone)]
pub struct RegistryPass {
    /// What it declares.
    pub descriptor: Arc<PassDescriptor>,
    /// Version of its plugin.
    pub version: Version,
    /// What its plugin is about.
    pub plugin_about: String,
    /// Where its plugin's files come from.
    pub origin: Origin,
    /// Switches that do nothing where an optional input is not fed.
    pub needs: Vec<Need>,
    /// What it does not do justice to.
    pub limits: Vec<Limit>,
    /// What it is wrong with.
    pub refuses: Vec<Limit>,
    /// Of its linked shaders.
    pub fingerprint: u64,
    /// What it computes, on the CPU, where its plugin says.
    pub reference: Option<Reference>,
    pub(crate) kind: Arc<Kind>,
    pub(crate) shaders: Shaders,
    pub(crate) make: Make,
}

impl RegistryPass {
    /// Its linked shaders, by the name of their file.
    pub fn shaders(&self) -> impl Iterator<Item = (&str, &Arc<Linked>)> {
        self.shaders.0.iter().map(|(file, linked)| (file.as_str(), linked))
    }
}

impl Registry {
    /// Reads the manifests of all plugins, those of crates and those of folders found at run time, and links nothing. A
    /// folder of the same name as a crate's plugin replaces that plugin's embedded files, and one on an earlier search
    /// path wins over one on a later path; two on one path are a mistake.
    pub fn new(mut crates: Vec<Plugin>, folders: Vec<Folder>, shared: &Library) -> Self {
        let (extensions, clashes) = extensions(&mut crates);
        let (mut found, mistakes) = found::winners(folders, &extensions);
        let mut registry = Self { mistakes, extensions: Arc::new(extensions), ..Self::default() };
        for (Plugin { name, folder, passes, references, .. }, clashes) in crates.into_iter().zip(clashes) {
            let replaced = found.iter().position(|found| found.name == name);
            let files = match replaced {
                Some(index) => Some(found.remove(index)),
                None => Found::read(folder, &name, &registry.extensions),
            };
            if let Some(mut files) = files {
                let place = files.place();
                files
                    .mistakes
                    .extend(clashes.into_iter().map(|text| Diagnostic::error(SCENE_CLASH, place.clone(), text)));
                registry.add(files, passes, references, shared);
            }
        }
        for files in found {
            registry.add(files, Vec::new(), Vec::new(), shared);
        }
        registry
    }

    /// Adds the passes of a plugin.
    fn add(
        &mut self,
        Found { name, is_named, manifest, folder, mistakes }: Found,
        rust: Vec<RustPass>,
        references: Vec<(String, Reference)>,
        shared: &Library,
    ) {
        self.mistakes.extend(mistakes.iter().cloned());
        self.catalogue.insert_plugin(&name, folder.manifest_path(), mistakes.clone());
        if !is_named {
            self.catalogue.insert_unread(mistakes.clone());
        }
        let Some(manifest) = manifest else { return };
        let linker = Arc::new(Linker {
            library: folder.library(shared),
            extensions: self.extensions.clone(),
            references: references.into_iter().collect(),
            manifest,
            folder,
            mistakes,
        });
        for (index, pass) in linker.manifest.passes.iter().enumerate() {
            let of = linker.clone();
            self.insert(format!("{name}.{}", pass.name), &linker, Box::new(move || of.data_pass(index)));
        }
        for pass in rust {
            let of = linker.clone();
            self.insert(pass.descriptor.name.clone(), &linker, Box::new(move || of.rust_pass(pass)));
        }
    }

    /// Adds a pass; two of one name are both refused.
    fn insert(&mut self, name: String, linker: &Linker, mut link: LinkPass) {
        if self.passes.contains_key(&name) {
            let duplicate = linker.duplicate(&name);
            link = Box::new(|| Err(duplicate));
        }
        let pass = Arc::new(LazyLock::new(link));
        let of = pass.clone();
        self.catalogue.insert_lazy(&name, move || linked(&of).map(|pass| pass.kind.clone()).map_err(Clone::clone));
        self.passes.insert(name, pass);
    }

    /// What the plugins add to scenes: what a scene is loaded with.
    pub fn extensions(&self) -> &Arc<Extensions> {
        &self.extensions
    }

    /// The descriptors, for validation.
    pub fn catalogue(&self) -> &Catalogue {
        &self.catalogue
    }

    /// Tells how large the pictures in files are, for the passes whose ports have their size.
    #[must_use]
    pub fn with_picture_size(mut self, picture_size: PictureSize) -> Self {
        self.catalogue.picture_size = Some(picture_size);
        self
    }

    /// Every mistake of every plugin, those included that no graph uses: links every pass.
    pub fn mistakes(&self) -> Diagnostics {
        let mut all = self.mistakes.clone();
        for mistakes in self.passes.values().filter_map(|pass| linked(pass).err()) {
            all.extend(mistakes.iter().cloned());
        }
        all.sort();
        all.dedup();
        all
    }

    /// Every sound pass, sorted by name: links every pass.
    pub fn passes(&self) -> impl Iterator<Item = &RegistryPass> {
        self.passes.values().filter_map(|pass| linked(pass).ok())
    }

    /// The pass of this name; where it or its plugin is broken, every mistake.
    pub fn find(&self, name: &str) -> Option<Result<&RegistryPass, &Diagnostics>> {
        match self.catalogue.get(name)? {
            Ok(_) => self.pass(name).map(Ok),
            Err(mistakes) => Some(Err(mistakes)),
        }
    }

    /// The pass of this name, if there is a sound one: a pass of a graph is.
    pub fn pass(&self, name: &str) -> Option<&RegistryPass> {
        self.passes.get(name).and_then(|pass| linked(pass).ok())
    }

    /// The same passes, but of one of them one shader replaced by another that binds and declares the same.
    #[must_use]
    pub fn with_shader(&self, pass: &str, file: &str, shader: &Arc<Linked>) -> Self {
        let mut registry = self.clone();
        if let Some(mut pass) = self.pass(pass).cloned() {
            pass.shaders.0.insert(file.to_owned(), shader.clone());
            pass.fingerprint = fingerprint(&pass.shaders, &pass.make);
            let name = pass.descriptor.name.clone();
            registry.passes.insert(name, Arc::new(LazyLock::new(Box::new(|| Ok(pass)))));
        }
        registry
    }

    /// The name that was probably meant.
    pub fn near(&self, name: &str) -> Option<&str> {
        near(name, self.passes.keys().map(String::as_str))
    }
}

/// What plugins add to scenes, all together, and of each plugin what of it was taken already; of such a plugin nothing is
/// added.
fn extensions(crates: &mut [Plugin]) -> (Extensions, Vec<Vec<String>>) {
    let mut all = Extensions::default();
    let add =
        |plugin: &mut Plugin| all.add(&plugin.name, std::mem::take(&mut plugin.extension)).err().unwrap_or_default();
    let clashes = crates.iter_mut().map(add).collect();
    (all, clashes)
}

/// A pass, which is linked now if it has not been.
fn linked(pass: &LazyPass) -> Result<&RegistryPass, &Diagnostics> {
    LazyLock::force(pass).as_ref()
}

impl Programs for Registry {
    fn program(&self, setup: &mut Setup<'_>) -> Result<Box<dyn Program>, GpuError> {
        let name = &setup.pass.descriptor().name;
        let pass = self.pass(name).ok_or_else(|| setup.pass.refuse(format!("`{name}` is not registered")))?;
        match &pass.make {
            Make::Dispatch { file, over } => dispatch::make(setup, &pass.shaders, file, over),
            Make::Rust(make) => make(setup, &pass.shaders),
        }
    }

    fn shaders(&self, pass: &str) -> u64 {
        self.pass(pass).map_or(0, |pass| pass.fingerprint)
    }
}
