//! `probe`: the numbers of one pixel.

use tyndall_document::Place;
use tyndall_gpu::{FrameOptions, Gpu, Numbers, PipelineCache};
use tyndall_graph::Roots;
use tyndall_render::Running;

use crate::App;
use crate::cli::{Arguments, Probe};
use crate::failure::Failure;
use crate::loading::{self, Wanted};
use crate::warnings::Untold;
use crate::{plugins, terminal};

pub(crate) fn run(app: &App, arguments: &Arguments, verb: &Probe) -> Result<(), Failure> {
    let registry = plugins::registry(app, arguments, &[&verb.graph.graph])?;
    let loaded = loading::load(&verb.graph, &registry, &Untold::of_models())?;
    let port = loaded.graph.find(&verb.port, Place::Argument(verb.port.clone()))?;
    let plan = loading::plan(&loaded, Wanted { roots: Roots::Ports(vec![port]), keep: false, live: &[] })?;
    let planned = plan
        .planned(port)
        .ok_or_else(|| Failure::Usage(format!("`{}` belongs to a pass that does not run", verb.port)))?;
    let gpu = Gpu::open(verb.adapter.as_deref())?;
    let mut running = Running::new(&gpu, plan, loaded.scene.as_ref(), &registry, &mut PipelineCache::default())?;
    running.frame(FrameOptions { frame: verb.frame, ..FrameOptions::default() })?;
    loading::warn_of_unfinished(&running, &Untold::of_models())?;
    let data = running.executor.read(planned)?;
    let (x, y) = verb.pixel;
    if x >= data.width() || y >= data.height() {
        let message = format!("`{}` is {}x{}: pixel {x},{y} is outside", verb.port, data.width(), data.height());
        return Err(Failure::Usage(message));
    }
    let unit = running.executor.plan().port_descriptor(planned).unit.clone();
    let numbers = data.numbers();
    for layer in 0..data.layers() {
        let first = ((layer * data.height() + y) * data.width() + x) * data.channels();
        let texel = first as usize..(first + data.channels()) as usize;
        let numbers: Vec<String> = match &numbers {
            Numbers::Floats(numbers) => numbers[texel].iter().map(|number| format!("{number:e}")).collect(),
            Numbers::Whole(numbers) => numbers[texel].iter().map(u32::to_string).collect(),
            Numbers::Signed(numbers) => numbers[texel].iter().map(i32::to_string).collect(),
        };
        let layer = if data.layers() > 1 { format!("[{layer}]") } else { String::new() };
        terminal::line(format!("{}{layer} {x},{y}: {} {unit}", verb.port, numbers.join("  ")).trim_end());
    }
    Ok(())
}
