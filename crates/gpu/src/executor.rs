//! Runs a plan, frame after frame.
//!
//! All that can be decided once is decided when the executor is made: textures, pipelines, bindings, the fixed part of
//! every fingerprint. A frame walks the plan's steps by index; it allocates nothing of its own and creates no GPU
//! object but its command encoder.

use std::sync::Arc;
use std::time::Instant;

use tyndall_graph::descriptor::{ParamDescriptor, ParamValue};
use tyndall_graph::{Handle, ParamSetting, Plan, PlannedPass, PlannedPort, Slot, SlotKind, Step, Table};

use crate::bindings::{Bound, Values};
use crate::cache::PipelineCache;
use crate::device::Gpu;
use crate::error::GpuError;
use crate::freshness::Freshness;
use crate::port_data::PortData;
use crate::readback::{read, read_bytes};
use crate::scene::SceneBuffers;
use crate::setup::{Program, Programs, Recorder, Setup};
use crate::slots::{Physical, create_all, fill, fill_stated, upload};
use crate::timing::{Stamps, Stopwatch, Timing};
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

/// Counts and times of one pass.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct PassCounters {
    /// Frames in which it ran.
    pub runs: u64,
    /// CPU time to record it in the last frame that measured, in microseconds.
    pub cpu_us: f64,
    /// Time from submission to completion in the last frame that timed each pass, in microseconds.
    pub alone_us: f64,
}

/// A plan on a device.
pub struct Executor {
    gpu: Arc<Gpu>,
    plan: Arc<Plan>,
    slots: Table<Slot, Physical>,
    programs: Table<PlannedPass, Box<dyn Program>>,
    values: Table<PlannedPass, Values>,
    live: Vec<Live>,
    samplers: [wgpu::Sampler; 3],
    stamps: Option<Stamps>,
    freshness: Freshness,
    counters: Table<PlannedPass, PassCounters>,
    /// The scene's buffers; set them before the first frame.
    pub scene: SceneBuffers,
}

/// A parameter that changes with the frame.
struct Live {
    pass: Handle<PlannedPass>,
    param: Handle<ParamDescriptor>,
    setting: ParamSetting,
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
        let slots = create_all(gpu, &plan)?;
        fill_stated(gpu, &plan, &slots)?;
        let at_start = |position| plan.params(position).iter().map(at_start).collect();
        let values: Table<PlannedPass, Values> = plan.passes.handles().map(at_start).collect();
        let mut ready = Table::with_capacity(plan.passes.len());
        for (position, values) in values.entries() {
            let pass = PlannedView { plan: &plan, position };
            let mut setup = Setup { gpu, pass, values, scene: &mut scene, cache };
            ready.push(programs.program(&mut setup)?);
        }
        let live = live_settings(&plan);
        let freshness = Freshness::new(&plan, programs, &mut scene);
        let samplers = samplers(gpu)?;
        let stamps = Stamps::new(gpu)?;
        let counters = plan.passes.column(PassCounters::default());
        let gpu = gpu.clone();
        Ok(Self { gpu, plan, slots, programs: ready, values, live, samplers, stamps, freshness, counters, scene })
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
        &self.counters
    }

    /// Gives the scene's buffers back, for the executor of another plan.
    pub fn into_scene(self) -> SceneBuffers {
        self.scene
    }

    /// Changes a parameter from the next frame on: `pass` and `param` as in the plan.
    ///
    /// # Errors
    /// [`GpuError::Pass`] where there is no such parameter, where it is a part of the pipeline, or where the value is not
    /// of its type. Ranges are not checked.
    pub fn set_param(&mut self, pass: &str, param: &str, value: ParamValue) -> Result<(), GpuError> {
        let refuse = |reason: &str| GpuError::Pass { pass: pass.to_owned(), reason: format!("`{param}` {reason}") };
        let at = self.plan.passes.handles().find(|position| self.plan.pass_name(*position) == pass);
        let at = at.ok_or_else(|| refuse("belongs to no pass of the plan"))?;
        let descriptor = self.plan.descriptor(at);
        let index = descriptor.param_named(param);
        let index = index.ok_or_else(|| refuse("is no parameter of it"))?;
        if descriptor.params[index].fixed {
            return Err(refuse("is a part of the pipeline: plan anew to change it"));
        }
        if !is_of_type(&descriptor.params[index], &value) {
            return Err(refuse("cannot have a value of this type"));
        }
        self.values[at][index] = value;
        self.live.retain(|live| (live.pass, live.param) != (at, index));
        Ok(())
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
        self.set_live(options.frame);
        let passes_run =
            self.freshness.decide(&self.plan, &self.values, &self.scene, &self.programs, options.everything);
        let mut watch = self.record(options)?;
        let cpu_us = start.elapsed().as_secs_f64() * 1e6;
        self.freshness.remember(&self.plan);
        let gpu_us = match (&self.stamps, options.timing) {
            (None, _) | (_, Timing::Off | Timing::Each) => None,
            (Some(_), _) if self.gpu.is_software() => watch.microseconds(&self.gpu)?,
            (Some(stamps), _) => stamps.microseconds(&self.gpu)?,
        };
        self.gpu.check()?;
        Ok(FrameReport { passes_run, cpu_us, gpu_us })
    }

    fn record(&mut self, options: FrameOptions) -> Result<Stopwatch, GpuError> {
        let Self { gpu, plan, slots, programs, values, samplers, stamps, freshness, counters, scene, .. } = self;
        if let Some(stamps) = stamps.as_mut() {
            stamps.reset();
        }
        let mut encoder = new_encoder(gpu);
        let mut watch = Stopwatch::default();
        if let (Some(stamps), Timing::Frame) = (stamps.as_mut(), options.timing) {
            stamps.mark(&mut encoder);
        }
        for step in &plan.steps {
            match *step {
                Step::Run { pass } if freshness.runs(pass) => {
                    let timed = options.timing == Timing::Pass(pass);
                    let each = options.timing == Timing::Each;
                    if timed || each {
                        // Alone on the GPU: else a driver that works ahead or behind counts other passes too.
                        submit(gpu, &mut encoder);
                        gpu.wait()?;
                    }
                    let start = options.cpu_times.then(Instant::now);
                    let mut recorder = Recorder {
                        encoder: &mut encoder,
                        bound: Bound { gpu, slots, scene, samplers },
                        pass: PlannedView { plan, position: pass },
                        values: &values[pass],
                        stamps: if timed { stamps.as_mut() } else { None },
                    };
                    programs[pass].record(&mut recorder)?;
                    counters[pass].runs += 1;
                    if let Some(start) = start {
                        counters[pass].cpu_us = start.elapsed().as_secs_f64() * 1e6;
                    }
                    if timed {
                        watch.start();
                        submit(gpu, &mut encoder);
                        watch.stop(gpu)?;
                    }
                    if each {
                        let start = Instant::now();
                        submit(gpu, &mut encoder);
                        gpu.wait()?;
                        counters[pass].alone_us = start.elapsed().as_secs_f64() * 1e6;
                    }
                }
                Step::Run { .. } => {}
                Step::Copy { pass, from, to } => {
                    if freshness.runs(pass) {
                        copy(&mut encoder, &slots[from], &slots[to]);
                    }
                }
                Step::Carry { from, to } => copy(&mut encoder, &slots[from], &slots[to]),
            }
        }
        if let Some(stamps) = stamps.as_mut() {
            if options.timing == Timing::Frame {
                stamps.mark(&mut encoder);
            }
            stamps.resolve(&mut encoder);
        }
        if options.timing == Timing::Frame {
            watch.start();
        }
        gpu.queue.submit([encoder.finish()]);
        Ok(watch)
    }

    /// The content of a port after the last frame. Waits for the GPU.
    ///
    /// # Errors
    /// [`GpuError::Pass`] where other ports have used the port's memory since (it was no root of the plan); a lost
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

    fn set_live(&mut self, frame: u32) {
        for Live { pass, param, setting } in &self.live {
            let value = &mut self.values[*pass][*param];
            *value = match (setting, &*value) {
                (ParamSetting::Frame, ParamValue::Integer(_)) => ParamValue::Integer(i64::from(frame)),
                (ParamSetting::Frame, _) => ParamValue::Float(f64::from(frame)),
                (_, _) => ParamValue::Float(f64::from(frame) / FRAMES_PER_SECOND),
            };
        }
    }
}

fn new_encoder(gpu: &Gpu) -> wgpu::CommandEncoder {
    gpu.device.create_command_encoder(&wgpu::CommandEncoderDescriptor { label: Some("frame") })
}

/// Submits what was recorded so far, and starts anew.
fn submit(gpu: &Gpu, encoder: &mut wgpu::CommandEncoder) {
    let recorded = std::mem::replace(encoder, new_encoder(gpu));
    gpu.queue.submit([recorded.finish()]);
}

/// Frame n shows time n over this.
pub const FRAMES_PER_SECOND: f64 = 24.0;

/// Whether a parameter can have this value, ranges apart.
fn is_of_type(param: &ParamDescriptor, value: &ParamValue) -> bool {
    match (&param.default, value) {
        (ParamValue::Vector(default), ParamValue::Vector(value)) => default.len() == value.len(),
        (ParamValue::Choice(_), ParamValue::Choice(word)) => param.choices.contains(word),
        (default, value) => std::mem::discriminant(default) == std::mem::discriminant(value),
    }
}

fn at_start(setting: &ParamSetting) -> ParamValue {
    match setting {
        ParamSetting::Value(value) => value.clone(),
        ParamSetting::Frame => ParamValue::Integer(0),
        ParamSetting::Time => ParamValue::Float(0.0),
    }
}

fn live_settings(plan: &Plan) -> Vec<Live> {
    let mut live = Vec::new();
    for pass in plan.passes.handles() {
        for (param, setting) in plan.params(pass).entries() {
            if !matches!(setting, ParamSetting::Value(_)) {
                live.push(Live { pass, param, setting: setting.clone() });
            }
        }
    }
    live
}

fn copy(encoder: &mut wgpu::CommandEncoder, from: &Physical, to: &Physical) {
    match (from, to) {
        (Physical::Texture { texture: from, .. }, Physical::Texture { texture: to, .. }) => {
            encoder.copy_texture_to_texture(from.as_image_copy(), to.as_image_copy(), from.size());
        }
        (Physical::Buffer(from), Physical::Buffer(to)) => {
            encoder.copy_buffer_to_buffer(from, 0, to, 0, from.size());
        }
        // The planner copies between slots of equal resources only.
        _ => {}
    }
}

fn samplers(gpu: &Gpu) -> Result<[wgpu::Sampler; 3], GpuError> {
    let sampler = |device: &wgpu::Device, label, address, filter| {
        device.create_sampler(&wgpu::SamplerDescriptor {
            label: Some(label),
            address_mode_u: address,
            address_mode_v: address,
            address_mode_w: address,
            mag_filter: filter,
            min_filter: filter,
            ..Default::default()
        })
    };
    let (clamp, repeat) = (wgpu::AddressMode::ClampToEdge, wgpu::AddressMode::Repeat);
    gpu.create("samplers", 3, |device| {
        [
            sampler(device, "linear_clamp", clamp, wgpu::FilterMode::Linear),
            sampler(device, "nearest_clamp", clamp, wgpu::FilterMode::Nearest),
            sampler(device, "linear_repeat", repeat, wgpu::FilterMode::Linear),
        ]
    })
}
