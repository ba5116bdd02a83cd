//! A plugin as its crate declares it.

use std::collections::BTreeMap;
use std::sync::Arc;

use tyndall_gpu::{GpuError, Numbers, PortData, Program, Setup};
use tyndall_graph::Resource;
use tyndall_graph::descriptor::{ParamValue, PassDescriptor};
use tyndall_shader::Linked;

use crate::folder::Folder;

/// A plugin of a crate: a folder, and passes in Rust beside those that the manifest declares.
pub struct Plugin {
    /// Name, as in its manifest.
    pub name: String,
    pub(crate) folder: Folder,
    pub(crate) passes: Vec<RustPass>,
    pub(crate) references: Vec<(String, Reference)>,
}

impl Plugin {
    /// A plugin without passes in Rust.
    pub fn new(name: &str, folder: Folder) -> Self {
        Self { name: name.to_owned(), folder, passes: Vec::new(), references: Vec::new() }
    }

    /// Adds a pass in Rust.
    #[must_use]
    pub fn pass(mut self, pass: RustPass) -> Self {
        self.passes.push(pass);
        self
    }

    /// Says what a pass of this plugin (`plugin.pass`) computes, on the CPU.
    #[must_use]
    pub fn reference(mut self, pass: &str, reference: Reference) -> Self {
        self.references.push((pass.to_owned(), reference));
        self
    }
}

/// What a pass computes, in double precision on the CPU: what tests hold the pass against.
///
/// # Errors
/// Why it cannot say.
pub type Reference = fn(&ReferenceInput<'_>) -> Outputs;

/// The numbers of each output that a reference knows, by port, as a read-back gives them; or why it cannot say.
pub type Outputs = Result<BTreeMap<&'static str, Numbers>, String>;

/// What a pass was given in a frame.
pub struct ReferenceInput<'a> {
    /// What was fed, by port.
    pub inputs: BTreeMap<&'a str, &'a PortData>,
    /// What each port is, inputs and outputs.
    pub resources: BTreeMap<&'a str, Resource>,
    /// Values of the parameters, by name.
    pub params: BTreeMap<&'a str, ParamValue>,
    /// The scene in this frame; `None` where the graph has none.
    pub scene: Option<&'a tyndall_shaders::scene::Scene>,
    /// The triangles of the scene in this frame; `None` where the pass reads none.
    pub surfaces: Option<&'a tyndall_shaders::scene::Surfaces>,
}

impl ReferenceInput<'_> {
    /// What was fed into a port.
    ///
    /// # Errors
    /// Where nothing was.
    pub fn input(&self, port: &str) -> Result<&PortData, String> {
        self.inputs.get(port).copied().ok_or_else(|| format!("nothing is fed into `{port}`"))
    }

    /// Texels of a port in x and y.
    ///
    /// # Errors
    /// Where the port is no texture.
    pub fn size(&self, port: &str) -> Result<[u32; 2], String> {
        match self.resources.get(port) {
            Some(Resource::Texture { width, height, .. }) => Ok([*width, *height]),
            _ => Err(format!("`{port}` is no texture")),
        }
    }

    /// The value of a parameter that is one number.
    ///
    /// # Errors
    /// Where it is none.
    pub fn number(&self, param: &str) -> Result<f64, String> {
        match self.params.get(param) {
            Some(ParamValue::Float(value)) => Ok(*value),
            Some(ParamValue::Integer(value)) => Ok(*value as f64),
            _ => Err(format!("`{param}` is no number")),
        }
    }

    /// The scene.
    ///
    /// # Errors
    /// Where there is none.
    pub fn scene(&self) -> Result<&tyndall_shaders::scene::Scene, String> {
        self.scene.ok_or_else(|| "the graph has no scene".to_owned())
    }

    /// The triangles of the scene.
    ///
    /// # Errors
    /// Where there is no scene, or the pass reads no triangles.
    pub fn surfaces(&self) -> Result<&tyndall_shaders::scene::Surfaces, String> {
        self.surfaces.ok_or_else(|| "the pass reads no triangles".to_owned())
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
