//! From the files of a plugin to a pass that is ready to be used: its shaders are linked, and held against what it declares.

use std::collections::BTreeMap;
use std::sync::Arc;

use tyndall_document::{Diagnostic, Diagnostics, Place};
use tyndall_graph::descriptor::{PRESET, PassDescriptor};
use tyndall_graph::{DescriptorError, Digest, Kind};
use tyndall_scene::Extensions;
use tyndall_shader::{Library, check_all, link};

use crate::codes::{BAD_DESCRIPTOR, BAD_PORT, MISSING_SHADER};
use crate::dispatch::{self, Over};
use crate::folder::Folder;
use crate::layout;
use crate::limits::Limit;
use crate::manifest::{Manifest, ManifestPass};
use crate::pass::{MakeProgram, RustPass, Shaders};
use crate::ports::{self, Need};
use crate::reference::Reference;
use crate::registry::RegistryPass;

/// How a pass is made ready for a plan.
#[derive(Clone)]
pub(crate) enum Make {
    /// One dispatch of one shader.
    Dispatch { file: String, over: Over },
    /// By its plugin's crate.
    Rust(Arc<MakeProgram>),
}

/// What the passes of one plugin are made from.
pub(crate) struct Linker {
    pub manifest: Manifest,
    pub folder: Folder,
    /// What its shaders may import.
    pub library: Library,
    /// What its shaders may read of scenes.
    pub extensions: Arc<Extensions>,
    /// By pass.
    pub references: BTreeMap<String, Reference>,
    /// Of the manifest, and so of every pass.
    pub mistakes: Diagnostics,
}

/// A pass before it is held against its shaders.
struct Candidate {
    descriptor: PassDescriptor,
    shaders: Shaders,
    make: Make,
    needs: Vec<Need>,
    limits: Vec<Limit>,
    refuses: Vec<Limit>,
}

impl Linker {
    /// A pass of the manifest.
    pub fn data_pass(&self, index: usize) -> Result<RegistryPass, Diagnostics> {
        let pass = &self.manifest.passes[index];
        let place = self.manifest.source.place(pass.name_span);
        self.pass(&place, |out| self.data_candidate(pass, &place, out))
    }

    /// A pass of the plugin's crate.
    pub fn rust_pass(&self, pass: RustPass) -> Result<RegistryPass, Diagnostics> {
        let place = Place::File(self.manifest.source.name().to_owned());
        self.pass(&place, |out| {
            let shaders = self.shaders(&pass.shaders, &place, out)?;
            let make = Make::Rust(Arc::from(pass.make));
            Some(Candidate {
                descriptor: pass.descriptor,
                shaders,
                make,
                needs: Vec::new(),
                limits: Vec::new(),
                refuses: Vec::new(),
            })
        })
    }

    /// What is wrong with a pass whose name another one has.
    pub fn duplicate(&self, name: &str) -> Diagnostics {
        let mut out = self.mistakes.clone();
        let message = DescriptorError::DuplicatePass(name.to_owned()).to_string();
        out.push(Diagnostic::error(BAD_DESCRIPTOR, Place::File(self.manifest.source.name().to_owned()), message));
        out
    }

    /// Collects the mistakes of a pass, those of its manifest first.
    fn pass(
        &self,
        place: &Place,
        candidate: impl FnOnce(&mut Diagnostics) -> Option<Candidate>,
    ) -> Result<RegistryPass, Diagnostics> {
        let mut out = self.mistakes.clone();
        let pass = candidate(&mut out).and_then(|candidate| self.checked(candidate, place, &mut out));
        out.sort();
        pass.filter(|_| !out.has_errors()).ok_or(out)
    }

    fn data_candidate(&self, pass: &ManifestPass, place: &Place, out: &mut Diagnostics) -> Option<Candidate> {
        let source = &self.manifest.source;
        let shaders = self.shaders(&[pass.shader.as_str()], &source.place(pass.shader_span), out)?;
        let linked = shaders.0.get(&pass.shader)?;
        let before = out.len();
        let descriptor =
            ports::descriptor(&self.manifest.name, pass, source, linked, &self.extensions.data_names(), out);
        if out.len() > before {
            return None;
        }
        let over = match &pass.over {
            Some((Over::Port(port), span)) if descriptor.port(port).is_none() => {
                let message = format!("unknown port `{port}` in `dispatch`");
                out.push(Diagnostic::error(BAD_PORT, source.place(*span), message));
                return None;
            }
            Some((over, _)) => Some(over.clone()),
            None => dispatch::default_over(&descriptor),
        };
        let Some(over) = over else {
            let message = "the pass has no output, so nothing to run over";
            out.push(Diagnostic::error(BAD_PORT, place.clone(), message));
            return None;
        };
        let make = Make::Dispatch { file: pass.shader.clone(), over };
        let (limits, refuses) = (pass.limits.clone(), pass.refuses.clone());
        Some(Candidate { descriptor, shaders, make, needs: ports::needs(pass), limits, refuses })
    }

    fn shaders(&self, files: &[&str], place: &Place, out: &mut Diagnostics) -> Option<Shaders> {
        let mut shaders = Shaders::default();
        for file in files {
            let Some(source) = self.folder.file(file) else {
                let message = format!("the plugin's folder holds no `{file}`");
                let problem = Diagnostic::error(MISSING_SHADER, place.clone(), message);
                out.push(problem.suggest_near(file, self.folder.files.keys().map(String::as_str)));
                return None;
            };
            match link(source, &self.library) {
                Ok(linked) => shaders.0.insert((*file).to_owned(), Arc::new(linked)),
                Err(problems) => {
                    out.extend(problems);
                    return None;
                }
            };
        }
        Some(shaders)
    }

    /// Holds a pass against its shaders.
    fn checked(&self, candidate: Candidate, place: &Place, out: &mut Diagnostics) -> Option<RegistryPass> {
        let Candidate { descriptor, shaders, make, needs, limits, refuses } = candidate;
        let linked: Vec<_> = shaders.0.values().map(AsRef::as_ref).collect();
        if !linked.is_empty() {
            let mut built = descriptor.clone();
            built.params.retain(|param| param.name != PRESET || built.presets.is_empty());
            let mut problems = check_all(&linked, &built, &self.extensions.data_names(), &[]);
            problems.extend(linked.iter().flat_map(|linked| layout::check(linked, &self.extensions)));
            if !problems.is_empty() {
                out.extend(problems);
                return None;
            }
        }
        let descriptor = Arc::new(descriptor);
        let kind = match Kind::new(descriptor.clone()) {
            Ok(kind) => Arc::new(kind),
            Err(errors) => {
                let mistake =
                    |error: DescriptorError| Diagnostic::error(BAD_DESCRIPTOR, place.clone(), error.to_string());
                out.extend(errors.into_iter().map(mistake));
                return None;
            }
        };
        Some(RegistryPass {
            version: self.manifest.version,
            plugin_about: self.manifest.about.clone(),
            origin: self.folder.origin.clone(),
            needs,
            limits,
            refuses,
            fingerprint: fingerprint(&shaders, &make),
            reference: self.references.get(&descriptor.name).copied(),
            descriptor,
            kind,
            shaders,
            make,
        })
    }
}

/// Of the shaders, each in its place, and of what the manifest says they run over.
pub(crate) fn fingerprint(shaders: &Shaders, make: &Make) -> u64 {
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
