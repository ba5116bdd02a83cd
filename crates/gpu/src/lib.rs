//! Plans on a GPU: device and adapter choice, resources, kernels, bind groups, frames, read-back, timing.
//!
//! This layer knows passes by index only. What a pass does is a [`Program`]; which program belongs to which pass says
//! whoever implements [`Programs`].

mod bindings;
mod cache;
mod commands;
mod device;
mod error;
mod executor;
mod freshness;
mod kernel;
pub mod memory;
mod parameters;
mod port_data;
mod program;
mod readback;
mod recorder;
mod samplers;
mod scene;
mod slots;
mod timing;
mod view;

pub use cache::PipelineCache;
pub use device::{AdapterSummary, Gpu, adapters};
pub use error::{GpuError, bytes};
pub use executor::{Executor, FrameOptions, FrameReport};
pub use kernel::{Kernel, Raster, RasterTargets};
pub use parameters::FRAMES_PER_SECOND;
pub use port_data::{Numbers, PortData};
pub use program::{Program, Programs, Setup};
pub use recorder::Recorder;
pub use scene::SceneBuffers;
pub use timing::{PassCounters, Timing};
pub use view::PlannedView;
pub use wgpu;
