//! What a method costs, and what it draws.

use std::collections::BTreeSet;
use std::sync::Arc;

use tyndall_gpu::{FrameOptions, Gpu, PipelineCache, Timing};
use tyndall_graph::Plan;
use tyndall_image::metrics::median;
use tyndall_plugin::Registry;
use tyndall_render::{Error, Running};

use crate::prepare::PreparedMethod;

/// A method on a device, in one scene.
pub(crate) struct Measured<'p> {
    running: Running<'p>,
    own: Vec<OwnPass>,
    frame_us: Vec<f64>,
    set_up_us: Vec<f64>,
}

/// A pass that the compared light depends on.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
struct OwnPass {
    position: u32,
    /// Its result stays while camera and lights move.
    is_set_up: bool,
}

/// What a method costs.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Cost {
    /// GPU time of a frame, µs; `None` where the adapter cannot tell.
    pub frame_us: Option<f64>,
    /// GPU time of what is computed once, µs.
    pub set_up_us: Option<f64>,
    /// Of what is written in each frame.
    pub frame_bytes: u64,
    /// Of what is computed once.
    pub set_up_bytes: u64,
}

impl<'p> Measured<'p> {
    /// Makes the method ready and draws a first frame, so that no later one waits for a compiler.
    pub fn new(
        gpu: &Arc<Gpu>,
        method: &'p PreparedMethod<'_>,
        registry: &Registry,
        cache: &mut PipelineCache,
    ) -> Result<Self, Error> {
        let mut running = Running::new(gpu, method.plan.clone(), method.scene.as_ref(), registry, cache)?;
        running.frame(FrameOptions::default())?;
        gpu.wait()?;
        let own = own_passes(running.executor.plan());
        Ok(Self { running, own, frame_us: Vec::new(), set_up_us: Vec::new() })
    }

    /// Red, green and blue of every pixel of the compared picture, row by row from the top.
    pub fn picture(&self) -> Result<Vec<[f32; 3]>, Error> {
        let executor = &self.running.executor;
        let data = executor.read(executor.plan().roots[0])?;
        let channels = data.channels.max(1) as usize;
        let pixel = |texel: &[f32]| [0, 1, 2].map(|channel: usize| texel[channel.min(channels - 1)]);
        Ok(data.data.chunks_exact(channels).map(pixel).collect())
    }

    /// Times each of the method's own passes once, alone on the GPU.
    pub fn time(&mut self) -> Result<(), Error> {
        let (mut frame, mut set_up) = (Some(0.0), Some(0.0));
        for pass in &self.own {
            let timing = Timing::Pass(pass.position as usize);
            let report = self.running.frame(FrameOptions { frame: 0, everything: true, timing, cpu_times: false })?;
            let sum = if pass.is_set_up { &mut set_up } else { &mut frame };
            *sum = sum.zip(report.gpu_us).map(|(sum, us)| sum + us);
        }
        self.frame_us.extend(frame);
        self.set_up_us.extend(set_up);
        Ok(())
    }

    /// Medians of the times so far, and bytes.
    pub fn cost(&mut self) -> Cost {
        let plan = self.running.executor.plan();
        let (set_up_bytes, frame_bytes) = bytes(plan, &self.own);
        Cost { frame_us: median(&mut self.frame_us), set_up_us: median(&mut self.set_up_us), frame_bytes, set_up_bytes }
    }
}

/// All passes of a plan for one port, but those that rasterise: that read triangles, and no light.
fn own_passes(plan: &Plan) -> Vec<OwnPass> {
    let rasterises = |position: &u32| {
        let reads = |name: &str| plan.descriptor(*position).scene.iter().any(|data| data == name);
        reads("triangles") && !reads("lights")
    };
    let own = |position: u32| OwnPass { position, is_set_up: !plan.passes[position as usize].volatile };
    (0..plan.passes.len() as u32).filter(|position| !rasterises(position)).map(own).collect()
}

/// Bytes of what passes write once, and in each frame. Memory that ports share counts once.
fn bytes(plan: &Plan, own: &[OwnPass]) -> (u64, u64) {
    let of = |set_up: bool| {
        let passes = own.iter().filter(|pass| pass.is_set_up == set_up);
        let ports = passes.flat_map(|pass| plan.outputs_of(pass.position));
        let slots: BTreeSet<u32> = ports.map(|port| plan.ports[port as usize].slot).collect();
        slots.into_iter().map(|slot| plan.slots[slot as usize].resource.bytes()).sum()
    };
    (of(true), of(false))
}
