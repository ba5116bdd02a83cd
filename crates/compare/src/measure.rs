//! What a method draws, and what it costs.

use std::collections::BTreeSet;
use std::sync::Arc;
use std::time::Instant;

use tyndall_document::Diagnostics;
use tyndall_gpu::{FrameOptions, Gpu, PipelineCache, Timing};
use tyndall_graph::{Handle, Plan, PlannedPass, Slot};
use tyndall_image::metrics::median;
use tyndall_plugin::Registry;
use tyndall_render::{Error, Running};
use tyndall_scene::{Part, Scene, SceneData};

use crate::prepare::PreparedMethod;

/// A method on a device, in one scene.
pub(crate) struct Measured<'p> {
    running: Running<'p>,
    own: Vec<OwnPass>,
    scene: Option<&'p Scene>,
    frame_us: Vec<f64>,
    set_up_us: Vec<f64>,
    scene_us: Vec<f64>,
    /// Bytes of data derived from casters: once, and in each frame.
    scene_bytes: (u64, u64),
}

/// A pass that the compared light depends on.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
struct OwnPass {
    position: Handle<PlannedPass>,
    /// Whether its result is kept while camera and lights move.
    is_set_up: bool,
}

/// What a method costs.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Cost {
    /// GPU time of a frame, µs; `None` where the adapter cannot tell.
    pub frame_us: Option<f64>,
    /// GPU time of what is computed once, µs.
    pub set_up_us: Option<f64>,
    /// CPU time, on one core, of deriving what passes read of casters (silhouettes and slices, or a hierarchy of triangles),
    /// µs; `None` if no pass reads any.
    pub scene_us: Option<f64>,
    /// Bytes written in each frame, including data that follow the eye.
    pub frame_bytes: u64,
    /// Bytes computed once.
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
        // A picture that the driver left unfinished would count as the method's error.
        let mut unfinished = Diagnostics::default();
        running.warn_of_unfinished(&mut unfinished)?;
        if !unfinished.is_empty() {
            return Err(unfinished.into());
        }
        let own = own_passes(running.executor.plan());
        let (frame_us, set_up_us, scene_us) = (Vec::new(), Vec::new(), Vec::new());
        let scene = method.scene.as_ref();
        Ok(Self { running, own, scene, frame_us, set_up_us, scene_us, scene_bytes: (0, 0) })
    }

    /// Red, green and blue of every pixel of the compared picture, row by row from the top.
    pub fn picture(&self) -> Result<Vec<[f32; 3]>, Error> {
        let executor = &self.running.executor;
        let data = executor.read(executor.plan().roots[0])?;
        let channels = data.channels() as usize;
        let pixel = |texel: &[f32]| [0, 1, 2].map(|channel: usize| texel[channel.min(channels - 1)]);
        Ok(data.floats().chunks_exact(channels).map(pixel).collect())
    }

    /// Times once each pass that runs in every frame, alone on the GPU; the first time also those whose results are kept,
    /// which may take long.
    pub fn time(&mut self) -> Result<(), Error> {
        let is_first = self.frame_us.is_empty();
        let (mut frame, mut set_up) = (Some(0.0), Some(0.0));
        for pass in self.own.iter().filter(|pass| is_first || !pass.is_set_up) {
            let timing = Timing::Pass(pass.position);
            // Its inputs are kept. It runs if something needs it, so all results after it are forgotten too.
            for following in self.own.iter().filter(|other| other.position >= pass.position) {
                self.running.executor.forget(following.position);
            }
            let report = self.running.frame(FrameOptions { timing, ..FrameOptions::default() })?;
            let sum = if pass.is_set_up { &mut set_up } else { &mut frame };
            *sum = sum.zip(report.gpu_us).map(|(sum, us)| sum + us);
        }
        self.frame_us.extend(frame);
        self.set_up_us.extend(set_up.filter(|_| is_first));
        self.time_scene();
        Ok(())
    }

    /// Times what plugins work out of casters.
    fn time_scene(&mut self) {
        let plan = self.running.executor.plan();
        let Some(scene) = self.scene else { return };
        let is_read =
            |data: &&SceneData| data.is_made_from(Part::Geometry) && data.names().any(|name| plan.reads(name));
        let of_casters: Vec<&SceneData> = scene.extensions().plugin_data().filter(is_read).collect();
        if of_casters.is_empty() {
            return;
        }
        let reads = |name: &str| of_casters.iter().any(|data| data.names().any(|own| own == name));
        let start = Instant::now();
        let encoded = scene.encode_for(0.0, f64::from(plan.size.0) / f64::from(plan.size.1), &reads);
        self.scene_us.push(start.elapsed().as_secs_f64() * 1e6);
        let bytes = |follows_eye: bool| {
            let data = of_casters.iter().filter(|data| data.is_made_from(Part::Camera) == follows_eye);
            let names = data.flat_map(|data| data.names()).filter(|name| plan.reads(name));
            names.map(|name| encoded.bytes(name).len() as u64).sum()
        };
        self.scene_bytes = (bytes(false), bytes(true));
    }

    /// Medians of the times so far, and bytes.
    pub fn cost(&mut self) -> Cost {
        let plan = self.running.executor.plan();
        let (set_up_bytes, frame_bytes) = bytes(plan, &self.own);
        Cost {
            frame_us: median(&mut self.frame_us),
            set_up_us: median(&mut self.set_up_us),
            scene_us: median(&mut self.scene_us),
            frame_bytes: frame_bytes + self.scene_bytes.1,
            set_up_bytes: set_up_bytes + self.scene_bytes.0,
        }
    }
}

/// All passes of a plan for one port, except those that rasterise, which read triangles but no lights.
fn own_passes(plan: &Plan) -> Vec<OwnPass> {
    let rasterises = |position: &Handle<PlannedPass>| {
        let reads = |name: &str| plan.descriptor(*position).scene.iter().any(|data| data == name);
        reads("triangles") && !reads("lights")
    };
    let own = |position| OwnPass { position, is_set_up: !plan.passes[position].volatile };
    plan.passes.handles().filter(|position| !rasterises(position)).map(own).collect()
}

/// Bytes of what passes write once, and in each frame. Memory that ports share counts once.
fn bytes(plan: &Plan, own: &[OwnPass]) -> (u64, u64) {
    let of = |set_up: bool| {
        let passes = own.iter().filter(|pass| pass.is_set_up == set_up);
        let ports = passes.flat_map(|pass| plan.outputs_of(pass.position));
        let slots: BTreeSet<Handle<Slot>> = ports.map(|port| plan.ports[port].slot).collect();
        slots.into_iter().map(|slot| plan.slots[slot].resource.bytes()).sum()
    };
    (of(true), of(false))
}
