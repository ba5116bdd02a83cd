//! Runs a plan, frame after frame.
//!
//! All that can be decided once is decided when the executor is made: pipelines, bindings, and textures that allow exactly
//! what these need. A frame walks the plan's steps by index; it allocates nothing of its own and creates no GPU
//! object but its command encoder.

use std::sync::Arc;
use std::time::Instant;

use tyndall_graph::descriptor::ParamValue;
use tyndall_graph::{Handle, Plan, PlannedPass, PlannedPort, Slot, SlotKind, Step, Table};

use crate::bindings::Bound;
use crate::cache::PipelineCache;
use crate::commands::Commands;
use crate::device::Gpu;
use crate::error::GpuError;
use crate::freshness::Freshness;
use crate::parameters::Parameters;
use crate::port_data::PortData;
use crate::program::{Program, Programs, Setup};
use crate::readback::{read, read_bytes};
use crate::recorder::Recorder;
use crate::samplers::samplers;
use crate::scene::SceneBuffers;
use crate::slots::{Physical, create_all, fill, fill_stated, least_usages, upload};
use crate::timing::{Clock, PassCounters, Timing};
use crate::view::PlannedView;

/// What is wanted of one frame.
#[derive(Debug, Clone, Copy, Default)]
pub struct FrameOptions {
    /// Number of the frame; its time is this over 24 s.
    pub frame: u32,
    /// Run every pass, also those whose results are still there.
    pub everything: bool,
    /// What is timed on the GPU.
    pub timing: Timing,
    /// Also measure the CPU time of each pass.
    pub cpu_times: bool,
}

/// What one frame did.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct FrameReport {
    /// Passes that ran.
    pub passes_run: usize,
    /// CPU time to decide, record and submit, in microseconds.
    pub cpu_us: f64,
    /// GPU time of what [`Timing`] names, in microseconds.
    pub gpu_us: Option<f64>,
}

/// A plan on a device.
pub struct Executor {
    gpu: Arc<Gpu>,
    plan: Arc<Plan>,
    slots: Table<Slot, Physical>,
    programs: Table<PlannedPass, Box<dyn Program>>,
    parameters: Parameters,
    samplers: [wgpu::Sampler; 3],
    clock: Clock,
    freshness: Freshness,
    /// The scene's buffers; set them before the first frame.
    pub scene: SceneBuffers,
}

impl Executor {
    /// Allocates the plan's resources and makes its passes ready. Call [`crate::memory::check`] first, and set the scene's
    /// data: pipelines may be made for the element counts of its lists.
    ///
    /// # Errors
    /// What the device or a pass reports; nothing is kept then.
    pub fn new(
        gpu: &Arc<Gpu>,
        plan: Arc<Plan>,
        programs: &dyn Programs,
        cache: &mut PipelineCache,
        mut scene: SceneBuffers,
    ) -> Result<Self, GpuError> {
        scene.release_counts();
        let parameters = Parameters::new(&plan);
        let mut usages = least_usages(&plan);
        let mut ready = Table::with_capacity(plan.passes.len());
        for (position, values) in parameters.values().entries() {
            let pass = PlannedView { plan: &plan, position };
            let mut setup = Setup { gpu, pass, values, scene: &mut scene, cache, usages: &mut usages };
            ready.push(programs.program(&mut setup)?);
        }
        let slots = create_all(gpu, &plan, &usages)?;
        fill_stated(gpu, &plan, &slots)?;
        Ok(Self {
            samplers: samplers(gpu)?,
            clock: Clock::new(gpu, &plan)?,
            freshness: Freshness::new(&plan, programs, &mut scene),
            gpu: gpu.clone(),
            programs: ready,
            plan,
            slots,
            parameters,
            scene,
        })
    }

    /// The plan that runs.
    pub fn plan(&self) -> &Plan {
        &self.plan
    }

    /// The device it runs on.
    pub fn gpu(&self) -> &Arc<Gpu> {
        &self.gpu
    }

    /// Counts and times of the passes.
    pub fn counters(&self) -> &Table<PlannedPass, PassCounters> {
        self.clock.counters()
    }

    /// Gives the scene's buffers back, for the executor of another plan.
    pub fn into_scene(self) -> SceneBuffers {
        self.scene
    }

    /// Changes a parameter from the next frame on: `pass` and `param` as in the plan.
    ///
    /// # Errors
    /// [`GpuError::Pass`] where there is no such parameter, where it is used when the pass is made ready (a part of the
    /// pipeline, a file), or where it does not accept the value.
    pub fn set_param(&mut self, pass: &str, param: &str, value: ParamValue) -> Result<(), GpuError> {
        self.parameters.set(&self.plan, (pass, param), value)
    }

    /// Fills every transient slot with this value (NaN, say), as if something else had been there.
    ///
    /// # Errors
    /// A lost device.
    pub fn poison(&mut self, value: f32) -> Result<(), GpuError> {
        for (slot, physical) in self.plan.slots.iter().zip(&self.slots) {
            if matches!(slot.kind, SlotKind::Transient | SlotKind::Kept) {
                fill(&self.gpu, &slot.resource, physical, [value; 4])?;
            }
        }
        self.freshness.forget();
        Ok(())
    }

    /// Forgets what a pass has written: it runs in the next frame though nothing has changed. What others have written is
    /// still there, as far as the plan keeps it.
    pub fn forget(&mut self, pass: Handle<PlannedPass>) {
        self.freshness.forget_pass(&self.plan, pass);
    }

    /// Records and submits one frame. Does not wait for it unless it is timed on the GPU.
    ///
    /// # Errors
    /// A lost device, or what a pass reports.
    pub fn frame(&mut self, options: FrameOptions) -> Result<FrameReport, GpuError> {
        self.gpu.check()?;
        let start = Instant::now();
        self.parameters.follow(options.frame);
        let values = self.parameters.values();
        let passes_run = self.freshness.decide(&self.plan, values, &self.scene, options.everything);
        self.record(options)?;
        let cpu_us = start.elapsed().as_secs_f64() * 1e6;
        self.freshness.remember(&self.plan);
        let gpu_us = self.clock.microseconds(&self.gpu)?;
        self.gpu.check()?;
        Ok(FrameReport { passes_run, cpu_us, gpu_us })
    }

    fn record(&mut self, options: FrameOptions) -> Result<(), GpuError> {
        let Self { gpu, plan, slots, programs, parameters, samplers, clock, freshness, scene, .. } = self;
        let mut commands = Commands::new(gpu);
        clock.begin_frame(options, &mut commands);
        for step in &plan.steps {
            match *step {
                Step::Run { pass } if freshness.runs(pass) => {
                    clock.begin_pass(pass, &mut commands)?;
                    programs[pass].record(&mut Recorder {
                        encoder: &mut commands.encoder,
                        bound: Bound { gpu, slots, scene, samplers },
                        pass: PlannedView { plan, position: pass },
                        values: &parameters.values()[pass],
                        stamps: clock.stamps(pass),
                    })?;
                    clock.end_pass(pass, &mut commands)?;
                }
                Step::Copy { pass, from, to } if freshness.runs(pass) => {
                    slots[from].copy(&slots[to], &mut commands.encoder);
                }
                Step::Carry { from, to } => slots[from].copy(&slots[to], &mut commands.encoder),
                Step::Run { .. } | Step::Copy { .. } => {}
            }
        }
        clock.end_frame(commands);
        Ok(())
    }

    /// The content of a port after the last frame. Waits for the GPU.
    ///
    /// # Errors
    /// [`GpuError::Pass`] if other ports have used the port's memory since (it was not a root of the plan); a lost
    /// device.
    pub fn read(&self, port: Handle<PlannedPort>) -> Result<PortData, GpuError> {
        let name = self.plan.port_name(port);
        if !self.freshness.holds(&self.plan, port) {
            let reason = "its memory was used again: ask for it when planning".to_owned();
            return Err(GpuError::Pass { pass: name, reason });
        }
        let slot = self.plan.ports[port].slot;
        let resource = *self.plan.resource(port);
        let scalar = resource.scalar(self.plan.port_descriptor(port));
        read(&self.gpu, &name, (resource, scalar), &self.slots[slot])
    }

    /// What the texture of a port allows: to be read and copied, and what passes do with it. `None` of a buffer.
    pub fn texture_usages(&self, port: Handle<PlannedPort>) -> Option<wgpu::TextureUsages> {
        self.slots[self.plan.ports[port].slot].texture().map(wgpu::Texture::usage)
    }

    /// Passes some of whose threads did not get to the end of their loops, because the driver ended them, and how many
    /// threads that were in all frames so far. Waits for the GPU.
    ///
    /// # Errors
    /// A lost device.
    pub fn unfinished(&self) -> Result<Vec<(Handle<PlannedPass>, u32)>, GpuError> {
        let mut unfinished = Vec::new();
        for (pass, program) in self.programs.entries() {
            let Some(count) = program.unfinished() else { continue };
            let bytes = read_bytes(&self.gpu, self.plan.pass_name(pass), 4, |encoder, staging| {
                encoder.copy_buffer_to_buffer(count, 0, staging, 0, 4);
            })?;
            let threads = bytes.first_chunk().map_or(0, |bytes| u32::from_le_bytes(*bytes));
            if threads > 0 {
                unfinished.push((pass, threads));
            }
        }
        Ok(unfinished)
    }

    /// Puts content into a port in the place of what its pass would compute: `texels` in the port's own format, rows
    /// from the top, without padding, as [`PortData::bytes`] has them. A pass runs from now on only where something
    /// that it computes was not given. Holds until [`Executor::poison`].
    ///
    /// # Errors
    /// [`GpuError::Pass`] where the content has another size than the port, where the port is a rasteriser's depth
    /// buffer (nothing can be copied into one), or where other ports use its memory: plan without sharing.
    pub fn give(&mut self, port: Handle<PlannedPort>, texels: &[u8]) -> Result<(), GpuError> {
        let planned = &self.plan.ports[port];
        let shared = |other| other != port && !self.plan.ports[other].in_place;
        if self.plan.ports_in(planned.slot).any(shared) {
            let reason = "other ports use its memory, so nothing can be given to it: plan without sharing".to_owned();
            return Err(GpuError::Pass { pass: self.plan.port_name(port), reason });
        }
        let name = self.plan.port_name(port);
        upload(&self.gpu, &name, self.plan.resource(port), &self.slots[planned.slot], texels)?;
        self.freshness.give(&self.plan, port);
        Ok(())
    }
}
