//! The program of a pass that is one dispatch of one shader: every pass of a data plugin.

use tyndall_gpu::{GpuError, Kernel, Program, Recorder, Setup};
use tyndall_graph::Resource;
use tyndall_graph::descriptor::PassDescriptor;

use crate::pass::Shaders;

/// One thread per texel (or element) of an output.
struct Dispatch {
    kernel: Kernel,
    threads: [u32; 3],
}

/// Makes the program of a pass whose shader is `file` and which runs over the port `over`.
pub(crate) fn make(
    setup: &mut Setup<'_>,
    shaders: &Shaders,
    file: &str,
    over: &str,
) -> Result<Box<dyn Program>, GpuError> {
    let port = setup.pass.port(over)?;
    let threads = match setup.pass.resource(port) {
        Some(Resource::Texture { width, height, depth_or_layers, .. }) => [*width, *height, *depth_or_layers],
        Some(Resource::Buffer { bytes, stride }) => [(bytes / u64::from((*stride).max(1))) as u32, 1, 1],
        None => return Err(setup.pass.refuse(format!("nothing is bound to `{over}`"))),
    };
    let linked = shaders.get(file)?;
    let entry = linked.entry_points.first().map_or("main", |entry| entry.name.as_str()).to_owned();
    Ok(Box::new(Dispatch { kernel: Kernel::new(setup, linked, &entry)?, threads }))
}

impl Program for Dispatch {
    fn record(&mut self, recorder: &mut Recorder<'_>) -> Result<(), GpuError> {
        recorder.dispatch(&mut self.kernel, self.threads)
    }
}

/// The port that a pass runs over where its manifest names none: its first output.
pub(crate) fn default_over(descriptor: &PassDescriptor) -> Option<String> {
    descriptor.outputs().next().map(|port| port.name.clone())
}
