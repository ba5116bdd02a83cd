//! GPU times: pairs of timestamps around wgpu passes, resolved after the frame.

use std::time::{Duration, Instant};

use tyndall_graph::{Handle, Plan, PlannedPass, Table};

use crate::commands::Commands;
use crate::device::Gpu;
use crate::error::GpuError;
use crate::executor::FrameOptions;
use crate::readback::read_bytes;

/// Pairs of timestamps that one frame can hold.
const PAIRS: u32 = 32;

/// What is timed on the GPU in a frame. Timestamps around every pass distort what they measure, so it is the whole
/// frame, or one pass of it.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Timing {
    /// Nothing.
    #[default]
    Off,
    /// From the frame's first command to its last.
    Frame,
    /// One pass, by its position in the plan.
    Pass(Handle<PlannedPass>),
    /// Every pass that runs, each submitted by itself and waited for: from submission to completion, into the counters.
    /// No more than an estimate, which holds what a submission costs as well.
    Each,
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

/// Measures frames and passes, each frame in the way that is asked for.
pub(crate) struct Clock {
    /// None where the adapter has no timestamps.
    stamps: Option<Stamps>,
    counters: Table<PlannedPass, PassCounters>,
    options: FrameOptions,
    watch: Stopwatch,
    /// When the recording of the pass began.
    began: Option<Instant>,
}

impl Clock {
    pub fn new(gpu: &Gpu, plan: &Plan) -> Result<Self, GpuError> {
        Ok(Self {
            stamps: Stamps::new(gpu)?,
            counters: plan.passes.column(PassCounters::default()),
            options: FrameOptions::default(),
            watch: Stopwatch::default(),
            began: None,
        })
    }

    pub fn counters(&self) -> &Table<PlannedPass, PassCounters> {
        &self.counters
    }

    /// Before the first command of a frame.
    pub fn begin_frame(&mut self, options: FrameOptions, commands: &mut Commands<'_>) {
        (self.options, self.watch) = (options, Stopwatch::default());
        if let Some(stamps) = &mut self.stamps {
            stamps.reset();
            if options.timing == Timing::Frame {
                stamps.mark(&mut commands.encoder);
            }
        }
    }

    /// Before a pass is recorded. One that is timed is alone on the GPU: else a driver that works ahead or behind counts other
    /// passes too.
    pub fn begin_pass(&mut self, pass: Handle<PlannedPass>, commands: &mut Commands<'_>) -> Result<(), GpuError> {
        if self.options.timing == Timing::Each || self.is_timed(pass) {
            commands.submit();
            commands.gpu.wait()?;
        }
        self.began = self.options.cpu_times.then(Instant::now);
        Ok(())
    }

    /// What the dispatches and draws of a pass are stamped with, if they are.
    pub fn stamps(&mut self, pass: Handle<PlannedPass>) -> Option<&mut Stamps> {
        if self.is_timed(pass) { self.stamps.as_mut() } else { None }
    }

    /// After a pass was recorded.
    pub fn end_pass(&mut self, pass: Handle<PlannedPass>, commands: &mut Commands<'_>) -> Result<(), GpuError> {
        let counters = &mut self.counters[pass];
        counters.runs += 1;
        if let Some(began) = self.began {
            counters.cpu_us = began.elapsed().as_secs_f64() * 1e6;
        }
        if self.options.timing == Timing::Each {
            let start = Instant::now();
            commands.submit();
            commands.gpu.wait()?;
            counters.alone_us = start.elapsed().as_secs_f64() * 1e6;
        }
        if self.is_timed(pass) {
            self.watch.start();
            commands.submit();
            self.watch.stop(commands.gpu)?;
        }
        Ok(())
    }

    /// Submits the last commands of a frame.
    pub fn end_frame(&mut self, mut commands: Commands<'_>) {
        let whole = self.options.timing == Timing::Frame;
        if let Some(stamps) = &mut self.stamps {
            if whole {
                stamps.mark(&mut commands.encoder);
            }
            stamps.resolve(&mut commands.encoder);
        }
        if whole {
            self.watch.start();
        }
        commands.finish();
    }

    /// GPU time of what was timed in the last frame. Waits for the GPU.
    pub fn microseconds(&mut self, gpu: &Gpu) -> Result<Option<f64>, GpuError> {
        match (&self.stamps, self.options.timing) {
            (None, _) | (_, Timing::Off | Timing::Each) => Ok(None),
            (Some(_), _) if gpu.is_software() => self.watch.microseconds(gpu),
            (Some(stamps), _) => stamps.microseconds(gpu),
        }
    }

    fn is_timed(&self, pass: Handle<PlannedPass>) -> bool {
        self.options.timing == Timing::Pass(pass)
    }
}

/// Time from submission to completion, for software adapters: the processor does the work there, and their timestamps
/// are taken when the driver flushes its bins, which says nothing of dispatches.
#[derive(Default)]
pub(crate) struct Stopwatch {
    started: Option<Instant>,
    took: Option<Duration>,
}

impl Stopwatch {
    /// Just before the work is submitted.
    pub(crate) fn start(&mut self) {
        self.started = Some(Instant::now());
    }

    /// Waits for the work.
    pub(crate) fn stop(&mut self, gpu: &Gpu) -> Result<(), GpuError> {
        gpu.wait()?;
        self.took = self.took.or(self.started.map(|started| started.elapsed()));
        Ok(())
    }

    /// What it measured, after waiting for the work where nobody has.
    pub(crate) fn microseconds(&mut self, gpu: &Gpu) -> Result<Option<f64>, GpuError> {
        self.stop(gpu)?;
        Ok(self.took.map(|took| took.as_secs_f64() * 1e6))
    }
}

/// Timestamps of one frame.
pub struct Stamps {
    set: wgpu::QuerySet,
    resolved: wgpu::Buffer,
    used: u32,
    nanoseconds_per_tick: f64,
}

impl Stamps {
    /// `None` where the adapter has no timestamps.
    pub(crate) fn new(gpu: &Gpu) -> Result<Option<Self>, GpuError> {
        if !gpu.has_timestamps() {
            return Ok(None);
        }
        let nanoseconds_per_tick = f64::from(gpu.queue.get_timestamp_period());
        gpu.create("timestamps", 2, |device| Self {
            set: device.create_query_set(&wgpu::QuerySetDescriptor {
                label: Some("timestamps"),
                ty: wgpu::QueryType::Timestamp,
                count: 2 * PAIRS,
            }),
            resolved: device.create_buffer(&wgpu::BufferDescriptor {
                label: Some("timestamps"),
                size: u64::from(2 * PAIRS) * 8,
                usage: wgpu::BufferUsages::QUERY_RESOLVE | wgpu::BufferUsages::COPY_SRC,
                mapped_at_creation: false,
            }),
            used: 0,
            nanoseconds_per_tick,
        })
        .map(Some)
    }

    pub(crate) fn reset(&mut self) {
        self.used = 0;
    }

    /// The next pair: the set, and the index of its first stamp. Beyond the last pair the last one is used again,
    /// so that the end of a pass with many dispatches is not lost.
    pub(crate) fn next(&mut self) -> Option<(&wgpu::QuerySet, u32)> {
        let pair = self.used.min(PAIRS - 1);
        self.used = pair + 1;
        Some((&self.set, 2 * pair))
    }

    /// An empty compute pass that takes a pair, to mark the start or the end of a frame.
    pub(crate) fn mark(&mut self, encoder: &mut wgpu::CommandEncoder) {
        if let Some((set, at)) = self.next() {
            encoder.begin_compute_pass(&wgpu::ComputePassDescriptor {
                label: Some("timestamp"),
                timestamp_writes: Some(wgpu::ComputePassTimestampWrites {
                    query_set: set,
                    beginning_of_pass_write_index: Some(at),
                    end_of_pass_write_index: Some(at + 1),
                }),
            });
        }
    }

    pub(crate) fn resolve(&self, encoder: &mut wgpu::CommandEncoder) {
        if self.used > 0 {
            encoder.resolve_query_set(&self.set, 0..2 * self.used, &self.resolved, 0);
        }
    }

    /// Microseconds from the first stamp to the last, after the frame was submitted. Waits for the GPU.
    pub(crate) fn microseconds(&self, gpu: &Gpu) -> Result<Option<f64>, GpuError> {
        if self.used == 0 {
            return Ok(None);
        }
        let size = u64::from(2 * self.used) * 8;
        let bytes = read_bytes(gpu, "timestamps", size, |encoder, staging| {
            encoder.copy_buffer_to_buffer(&self.resolved, 0, staging, 0, size);
        })?;
        let ticks = bytes.as_chunks().0.iter().map(|eight| u64::from_le_bytes(*eight));
        let (first, last) = (ticks.clone().min().unwrap_or_default(), ticks.max().unwrap_or_default());
        Ok(Some((last - first) as f64 * self.nanoseconds_per_tick / 1000.0))
    }
}
