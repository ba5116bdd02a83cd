//! The program of a pass that is one dispatch of one shader: every pass of a data plugin.

use tyndall_gpu::{GpuError, Kernel, Program, Recorder, Setup};
use tyndall_graph::Resource;
use tyndall_graph::descriptor::PassDescriptor;

use crate::pass::Shaders;

/// What a dispatch runs over.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) enum Over {
    /// The texels (or elements) of a port.
    Port(String),
    /// Threads in x, y and z.
    Threads([u32; 3]),
}

/// One dispatch of so many threads.
struct Dispatch {
    kernel: Kernel,
    threads: [u32; 3],
}

/// Makes the program of a pass whose shader is `file`.
pub(crate) fn make(
    setup: &mut Setup<'_>,
    shaders: &Shaders,
    file: &str,
    over: &Over,
) -> Result<Box<dyn Program>, GpuError> {
    let threads = match over {
        Over::Threads(threads) => *threads,
        Over::Port(name) => match setup.pass.resource(setup.pass.port(name)?) {
            Some(Resource::Texture { width, height, depth_or_layers, .. }) => [*width, *height, *depth_or_layers],
            Some(Resource::Buffer { bytes, stride }) => [(bytes / u64::from((*stride).max(1))) as u32, 1, 1],
            None => return Err(setup.pass.refuse(format!("nothing is bound to `{name}`"))),
        },
    };
    let linked = shaders.get(file)?;
    let entry = linked.entry_points.first().map_or("main", |entry| entry.name.as_str()).to_owned();
    Ok(Box::new(Dispatch { kernel: Kernel::new(setup, linked, &entry)?, threads }))
}

impl Program for Dispatch {
    fn record(&mut self, recorder: &mut Recorder<'_>) -> Result<(), GpuError> {
        recorder.dispatch(&mut self.kernel, self.threads)
    }

    fn unfinished(&self) -> Option<&tyndall_gpu::wgpu::Buffer> {
        self.kernel.unfinished()
    }
}

/// The port that a pass runs over where its manifest names none: its first output.
pub(crate) fn default_over(descriptor: &PassDescriptor) -> Option<Over> {
    descriptor.outputs().next().map(|port| Over::Port(port.name.clone()))
}
