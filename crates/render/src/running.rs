//! A plan with its scene on a device.

use std::sync::Arc;

use tyndall_document::{Diagnostic, Diagnostics};
use tyndall_gpu::{Executor, FRAMES_PER_SECOND, FrameOptions, FrameReport, Gpu, PipelineCache, SceneBuffers, memory};
use tyndall_graph::{Graph, Pass, Plan};
use tyndall_plugin::Registry;
use tyndall_scene::{Encoded, Scene};

use crate::codes::UNFINISHED;
use crate::error::Error;

/// Copies of a port that exist at a time while it is read back and written to a file.
const READBACK_COPIES: u64 = 4;

/// A plan with its scene on a device.
pub struct Running<'a> {
    /// What runs it.
    pub executor: Executor,
    scene: Option<(&'a Scene, Encoded)>,
    aspect: f64,
}

impl<'a> Running<'a> {
    /// Checks that the machine can hold the plan, and makes it ready.
    ///
    /// # Errors
    /// What the plan needs and the machine has not; what a pass reports.
    pub fn new(
        gpu: &Arc<Gpu>,
        plan: Plan,
        scene: Option<&'a Scene>,
        registry: &Registry,
        cache: &mut PipelineCache,
    ) -> Result<Self, Error> {
        let largest = plan.roots.iter().map(|port| plan.resource(*port).bytes()).max().unwrap_or_default();
        memory::check(gpu, &plan, READBACK_COPIES.saturating_mul(largest))?;
        let aspect = f64::from(plan.size.0) / f64::from(plan.size.1);
        let scene = scene.map(|scene| (scene, scene.encode_for(0.0, aspect, &|name| plan.reads(name))));
        // Before the pipelines, which may be made for the lengths of its lists.
        let mut buffers = SceneBuffers::default();
        for (name, bytes) in scene.iter().flat_map(|(_, encoded)| &encoded.items) {
            buffers.set(gpu, name, bytes)?;
        }
        let executor = Executor::new(gpu, Arc::new(plan), registry, cache, buffers)?;
        Ok(Self { executor, scene, aspect })
    }

    /// Brings the scene to the frame's time, and runs the frame.
    ///
    /// # Errors
    /// A lost device, scene data over its limits, what a pass reports.
    pub fn frame(&mut self, options: FrameOptions) -> Result<FrameReport, Error> {
        self.bring_scene_to(f64::from(options.frame) / FRAMES_PER_SECOND)?;
        Ok(self.executor.frame(options)?)
    }

    /// Warns of passes whose loops the driver has ended before they were done, in any frame so far. Waits for the GPU.
    ///
    /// # Errors
    /// A lost device.
    pub fn warn_of_unfinished(&self, out: &mut Diagnostics) -> Result<(), Error> {
        let plan = self.executor.plan();
        for (pass, threads) in self.executor.unfinished()? {
            let pass = plan.graph.pass(plan.passes[pass].pass);
            out.push(unfinished(&plan.graph, pass, &self.executor.gpu().info.name, threads));
        }
        Ok(())
    }

    fn bring_scene_to(&mut self, time: f64) -> Result<(), Error> {
        let Some((scene, encoded)) = &mut self.scene else { return Ok(()) };
        let gpu = self.executor.gpu().clone();
        for name in encoded.update(scene, time, self.aspect) {
            self.executor.scene.set(&gpu, name, encoded.bytes(name))?;
        }
        Ok(())
    }
}

/// The warning that a driver ended loops of a pass, in so many threads.
pub(crate) fn unfinished(graph: &Graph, pass: &Pass, driver: &str, threads: u32) -> Diagnostic {
    let message = format!(
        "pass `{}`: {driver} ended its loops before they were done, in {threads} pixels, whose values are wrong",
        pass.name
    );
    let hint = "Mesa's llvmpipe ends all loops of a pixel after 65,535 rounds: use fewer steps, lights or triangles, or \
                another driver, which has no such limit";
    Diagnostic::warning(UNFINISHED, graph.place(pass.span), message).suggest(hint)
}
