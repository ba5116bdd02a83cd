//! A plugin as its crate declares it.

use std::collections::BTreeMap;
use std::sync::Arc;

use tyndall_gpu::{GpuError, Program, Setup};
use tyndall_graph::descriptor::PassDescriptor;
use tyndall_scene::{Extension, Feature, FieldValue, HoldsFields, Refusal, Scene, SceneData, SceneField};
use tyndall_shader::Linked;

use crate::folder::Folder;
use crate::reference::Reference;

/// A plugin of a crate: a folder, and passes in Rust beside those that the manifest declares.
pub struct Plugin {
    /// Name, as in its manifest.
    pub name: String,
    pub(crate) folder: Folder,
    pub(crate) passes: Vec<RustPass>,
    pub(crate) references: Vec<(String, Reference)>,
    pub(crate) extension: Extension,
}

impl Plugin {
    /// A plugin without passes in Rust.
    pub fn new(name: &str, folder: Folder) -> Self {
        let (passes, references, extension) = (Vec::new(), Vec::new(), Extension::default());
        Self { name: name.to_owned(), folder, passes, references, extension }
    }

    /// Adds a pass in Rust.
    #[must_use]
    pub fn pass(mut self, pass: RustPass) -> Self {
        self.passes.push(pass);
        self
    }

    /// Adds scene data, which any pass may read by name.
    #[must_use]
    pub fn scene_data(mut self, data: SceneData) -> Self {
        self.extension.add_data(data);
        self
    }

    /// Adds a field of the scene file.
    #[must_use]
    pub fn scene_field<H: HoldsFields, T: FieldValue>(mut self, field: &SceneField<H, T>) -> Self {
        self.extension.add_field(field);
        self
    }

    /// Adds something that a scene can have, which `limits` and `refuses` of manifests can name.
    #[must_use]
    pub fn scene_feature(mut self, name: &'static str, is_in: fn(&Scene) -> bool) -> Self {
        self.extension.add_feature(Feature { name, is_in });
        self
    }

    /// Adds scene data that others are wrong without, in some scenes.
    #[must_use]
    pub fn scene_refusal(mut self, refusal: Refusal) -> Self {
        self.extension.add_refusal(refusal);
        self
    }

    /// Says what a pass of this plugin (`plugin.pass`) computes, on the CPU.
    #[must_use]
    pub fn reference(mut self, pass: &str, reference: Reference) -> Self {
        self.references.push((pass.to_owned(), reference));
        self
    }
}

/// Makes a pass ready for a plan.
pub type MakeProgram = dyn Fn(&mut Setup<'_>, &Shaders) -> Result<Box<dyn Program>, GpuError> + Send + Sync;

/// A pass in Rust: for what needs several dispatches, a rasteriser, or files.
pub struct RustPass {
    /// What it declares; held against the shaders like that of every other pass.
    pub descriptor: PassDescriptor,
    /// Names of its shaders in the plugin's folder.
    pub shaders: Vec<&'static str>,
    /// Makes it ready for a plan.
    pub make: Box<MakeProgram>,
}

/// The linked shaders of a pass, by file name.
#[derive(Debug, Clone, Default)]
pub struct Shaders(pub(crate) BTreeMap<String, Arc<Linked>>);

impl Shaders {
    /// The shader of this file name.
    ///
    /// # Errors
    /// [`GpuError::Pass`] where the pass did not declare it.
    pub fn get(&self, file: &str) -> Result<&Arc<Linked>, GpuError> {
        self.0.get(file).ok_or_else(|| GpuError::Pass {
            pass: file.to_owned(),
            reason: "the pass declares no such shader".to_owned(),
        })
    }
}
