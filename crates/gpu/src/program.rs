//! What a pass of a plan is to the executor, and what it is made ready with.

use tyndall_graph::descriptor::{Format, ParamValue};
use tyndall_graph::{Handle, Resource, Slot, Table, Values};

use crate::cache::PipelineCache;
use crate::device::Gpu;
use crate::error::GpuError;
use crate::recorder::Recorder;
use crate::scene::SceneBuffers;
use crate::view::PlannedView;

/// A pass of a plan that can record its work.
pub trait Program {
    /// Records one run of the pass into the frame.
    ///
    /// # Errors
    /// What the recorder reports.
    fn record(&mut self, recorder: &mut Recorder<'_>) -> Result<(), GpuError>;

    /// Where the pass counts threads whose loops the driver has ended, if it does.
    fn unfinished(&self) -> Option<&wgpu::Buffer> {
        None
    }
}

/// Gives the program of each pass of a plan: implemented by the registry of plugins.
pub trait Programs {
    /// Makes a pass ready: links shaders, compiles pipelines, reads files.
    ///
    /// # Errors
    /// What stands in the way.
    fn program(&self, setup: &mut Setup<'_>) -> Result<Box<dyn Program>, GpuError>;

    /// A number that stands for what the shaders of this pass (`plugin.pass`) do: the same in every process.
    fn shaders(&self, pass: &str) -> u64;
}

/// What a pass is made ready with.
pub struct Setup<'a> {
    /// The device.
    pub gpu: &'a Gpu,
    /// The pass within its plan.
    pub pass: PlannedView<'a>,
    pub(crate) values: &'a Values,
    pub(crate) scene: &'a mut SceneBuffers,
    pub(crate) cache: &'a mut PipelineCache,
    /// What the textures of slots must allow: what is made ready adds what it needs.
    pub(crate) usages: &'a mut Table<Slot, wgpu::TextureUsages>,
}

impl Setup<'_> {
    /// The value of a parameter at this moment; a parameter that is not `fixed` may change from frame to frame.
    pub fn param(&self, name: &str) -> Option<&ParamValue> {
        Some(&self.values[self.pass.param(name)?])
    }

    /// The slot and the format of a texture port that is drawn into.
    pub(crate) fn target(&mut self, port: &str) -> Result<(Handle<Slot>, Format), GpuError> {
        let index = self.pass.port(port)?;
        match (self.pass.slot(index), self.pass.resource(index)) {
            (Some(slot), Some(Resource::Texture { format, .. })) => {
                self.usages[slot] |= wgpu::TextureUsages::RENDER_ATTACHMENT;
                Ok((slot, *format))
            }
            _ => Err(self.pass.refuse(format!("it draws into `{port}`, which is not one of its textures"))),
        }
    }
}
