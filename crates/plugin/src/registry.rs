//! Every pass that a graph can use, linked and checked, and how to make each ready.

use std::collections::BTreeMap;
use std::sync::Arc;

use tyndall_document::{Diagnostic, Diagnostics, Place, near};
use tyndall_gpu::{GpuError, Program, Programs, Setup};
use tyndall_graph::descriptor::{PRESET, PassDescriptor};
use tyndall_graph::{Catalogue, Digest, PictureSize};
use tyndall_shader::{Library, Linked, check_all, link};

use crate::codes::{BAD_DESCRIPTOR, DUPLICATE_PLUGIN, MISSING_SHADER};
use crate::dispatch::{self, Over};
use crate::folder::{Folder, MANIFEST, Origin};
use crate::limits::Limit;
use crate::manifest::{self, Manifest, ManifestPass, Version};
use crate::pass::{MakeProgram, Plugin, Reference, RustPass, Shaders};
use crate::ports::{self, Need};

/// Every pass of every plugin.
#[derive(Clone, Default)]
pub struct Registry {
    catalogue: Catalogue,
    passes: BTreeMap<String, RegistryPass>,
}

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
    /// Of its linked shaders.
    pub fingerprint: u64,
    /// What it computes, on the CPU, where its plugin says.
    pub reference: Option<Reference>,
    shaders: Shaders,
    make: Make,
}

#[derive(Clone)]
enum Make {
    Dispatch { file: String, over: Over },
    Rust(Arc<MakeProgram>),
}

impl RegistryPass {
    /// Its linked shaders, by the name of their file.
    pub fn shaders(&self) -> impl Iterator<Item = (&str, &Arc<Linked>)> {
        self.shaders.0.iter().map(|(file, linked)| (file.as_str(), linked))
    }
}

impl Registry {
    /// Links and checks every pass: those of crates, and those of folders found at run time. A folder of the same name
    /// as a crate's plugin replaces that plugin's embedded files, and one on an earlier search path wins over one on a
    /// later path; two on one path are a mistake.
    ///
    /// # Errors
    /// Every mistake of every manifest and shader.
    pub fn new(
        crates: Vec<Plugin>,
        folders: Vec<Folder>,
        shared: &Library,
        scene_names: &[&str],
    ) -> Result<Self, Diagnostics> {
        let mut builder = Builder { registry: Self::default(), shared, scene_names, out: Diagnostics::default() };
        let mut found = builder.manifests(folders);
        for plugin in crates {
            let replaced = found.iter().position(|(manifest, _)| manifest.name == plugin.name);
            let entry = match replaced {
                Some(index) => Some(found.remove(index)),
                None => builder.manifests(vec![plugin.folder]).pop(),
            };
            if let Some((manifest, folder)) = entry {
                builder.plugin(&manifest, &folder, plugin.passes);
            }
            for (pass, reference) in plugin.references {
                if let Some(pass) = builder.registry.passes.get_mut(&pass) {
                    pass.reference = Some(reference);
                }
            }
        }
        for (manifest, folder) in found {
            builder.plugin(&manifest, &folder, Vec::new());
        }
        builder.out.sort();
        if builder.out.has_errors() { Err(builder.out) } else { Ok(builder.registry) }
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

    /// Every pass, sorted by name.
    pub fn passes(&self) -> impl Iterator<Item = &RegistryPass> {
        self.passes.values()
    }

    /// The pass of this name.
    pub fn pass(&self, name: &str) -> Option<&RegistryPass> {
        self.passes.get(name)
    }

    /// The same passes, but of one of them one shader replaced by another that binds and declares the same.
    #[must_use]
    pub fn with_shader(&self, pass: &str, file: &str, shader: &Arc<Linked>) -> Self {
        let mut registry = self.clone();
        if let Some(pass) = registry.passes.get_mut(pass) {
            pass.shaders.0.insert(file.to_owned(), shader.clone());
            pass.fingerprint = fingerprint(&pass.shaders, &pass.make);
        }
        registry
    }

    /// The name that was probably meant.
    pub fn near(&self, name: &str) -> Option<&str> {
        near(name, self.passes.keys().map(String::as_str))
    }
}

impl Programs for Registry {
    fn program(&self, setup: &mut Setup<'_>) -> Result<Box<dyn Program>, GpuError> {
        let name = &setup.pass.descriptor().name;
        let pass = self.passes.get(name).ok_or_else(|| setup.pass.refuse(format!("`{name}` is not registered")))?;
        match &pass.make {
            Make::Dispatch { file, over } => dispatch::make(setup, &pass.shaders, file, over),
            Make::Rust(make) => make(setup, &pass.shaders),
        }
    }

    fn shaders(&self, pass: &str) -> u64 {
        self.passes.get(pass).map_or(0, |pass| pass.fingerprint)
    }
}

/// A pass before it is held against its shaders.
struct Candidate {
    descriptor: PassDescriptor,
    shaders: Shaders,
    make: Make,
    needs: Vec<Need>,
    limits: Vec<Limit>,
}

/// Collects passes and mistakes.
struct Builder<'a> {
    registry: Registry,
    shared: &'a Library,
    scene_names: &'a [&'a str],
    out: Diagnostics,
}

impl Builder<'_> {
    /// Reads the manifests of folders, which stand in order of search path. Of two plugins of one name the first is
    /// taken; the second is a mistake where it is on the same path.
    fn manifests(&mut self, folders: Vec<Folder>) -> Vec<(Manifest, Folder)> {
        let mut found: Vec<(Manifest, Folder)> = Vec::new();
        for folder in folders {
            let Some(source) = folder.file(MANIFEST).cloned() else { continue };
            let Some(manifest) = manifest::read(&source, &mut self.out) else { continue };
            if let Some((first, holder)) = found.iter().find(|(other, _)| other.name == manifest.name) {
                if holder.path < folder.path {
                    continue;
                }
                let message = format!("there are two plugins named `{}`", manifest.name);
                let problem = Diagnostic::error(DUPLICATE_PLUGIN, Place::File(source.name().to_owned()), message);
                self.out.push(problem.relate(Place::File(first.source.name().to_owned()), "the first one"));
                continue;
            }
            found.push((manifest, folder));
        }
        found
    }

    fn plugin(&mut self, manifest: &Manifest, folder: &Folder, rust: Vec<RustPass>) {
        let library = folder.library(self.shared);
        for pass in &manifest.passes {
            self.data_pass(manifest, folder, &library, pass);
        }
        for pass in rust {
            self.rust_pass(manifest, folder, &library, pass);
        }
    }

    fn data_pass(&mut self, manifest: &Manifest, folder: &Folder, library: &Library, pass: &ManifestPass) {
        let place = manifest.source.place(pass.shader_span);
        let Some(shaders) = self.link(folder, library, &[pass.shader.as_str()], &place) else { return };
        let Some(linked) = shaders.0.get(&pass.shader) else { return };
        let before = self.out.len();
        let descriptor =
            ports::descriptor(&manifest.name, pass, &manifest.source, linked, self.scene_names, &mut self.out);
        if self.out.len() > before {
            return;
        }
        let over = match &pass.over {
            Some((Over::Port(port), span)) if descriptor.port(port).is_none() => {
                let message = format!("`dispatch` names `{port}`, which is no port of this pass");
                self.out.push(Diagnostic::error(crate::codes::BAD_PORT, manifest.source.place(*span), message));
                return;
            }
            Some((over, _)) => Some(over.clone()),
            None => dispatch::default_over(&descriptor),
        };
        let Some(over) = over else {
            let place = manifest.source.place(pass.name_span);
            self.out.push(Diagnostic::error(
                crate::codes::BAD_PORT,
                place,
                "the pass has no output, so nothing to run over",
            ));
            return;
        };
        let make = Make::Dispatch { file: pass.shader.clone(), over };
        let place = manifest.source.place(pass.name_span);
        let (needs, limits) = (ports::needs(pass), pass.limits.clone());
        self.insert(manifest, folder, Candidate { descriptor, shaders, make, needs, limits }, &place);
    }

    fn rust_pass(&mut self, manifest: &Manifest, folder: &Folder, library: &Library, pass: RustPass) {
        let place = Place::File(manifest.source.name().to_owned());
        let Some(shaders) = self.link(folder, library, &pass.shaders, &place) else { return };
        let make = Make::Rust(Arc::from(pass.make));
        let candidate = Candidate { descriptor: pass.descriptor, shaders, make, needs: Vec::new(), limits: Vec::new() };
        self.insert(manifest, folder, candidate, &place);
    }

    fn link(&mut self, folder: &Folder, library: &Library, files: &[&str], place: &Place) -> Option<Shaders> {
        let mut shaders = Shaders::default();
        for file in files {
            let Some(source) = folder.file(file) else {
                let message = format!("the plugin's folder holds no `{file}`");
                let problem = Diagnostic::error(MISSING_SHADER, place.clone(), message);
                self.out.push(problem.suggest_near(file, folder.files.keys().map(String::as_str)));
                return None;
            };
            match link(source, library) {
                Ok(linked) => shaders.0.insert((*file).to_owned(), Arc::new(linked)),
                Err(problems) => {
                    self.out.extend(problems);
                    return None;
                }
            };
        }
        Some(shaders)
    }

    /// Holds a pass against its shaders, and registers it where they agree.
    fn insert(&mut self, manifest: &Manifest, folder: &Folder, candidate: Candidate, place: &Place) {
        let Candidate { descriptor, shaders, make, needs, limits } = candidate;
        let linked: Vec<_> = shaders.0.values().map(AsRef::as_ref).collect();
        if !linked.is_empty() {
            let mut built = descriptor.clone();
            built.params.retain(|param| param.name != PRESET || built.presets.is_empty());
            let problems = check_all(&linked, &built, self.scene_names, &[]);
            if !problems.is_empty() {
                self.out.extend(problems);
                return;
            }
        }
        let descriptor = Arc::new(descriptor);
        if let Err(errors) = self.registry.catalogue.insert(descriptor.clone()) {
            for error in errors {
                self.out.push(Diagnostic::error(BAD_DESCRIPTOR, place.clone(), error.to_string()));
            }
            return;
        }
        let fingerprint = fingerprint(&shaders, &make);
        let pass = RegistryPass {
            descriptor: descriptor.clone(),
            version: manifest.version,
            plugin_about: manifest.about.clone(),
            origin: folder.origin.clone(),
            needs,
            limits,
            fingerprint,
            reference: None,
            shaders,
            make,
        };
        self.registry.passes.insert(descriptor.name.clone(), pass);
    }
}

/// Of the shaders, each in its place, and of what the manifest says they run over.
fn fingerprint(shaders: &Shaders, make: &Make) -> u64 {
    let mut digest = Digest::default();
    for (file, linked) in &shaders.0 {
        digest.text(file);
        digest.number(linked.fingerprint);
    }
    if let Make::Dispatch { over, .. } = make {
        digest.text(&format!("{over:?}"));
    }
    digest.finish()
}
