//! Plans on a GPU: device and adapter choice, resources, kernels, bind groups, frames, read-back, timing.
//!
//! This layer knows passes by index only. What a pass does is a [`Program`]; which program belongs to which pass says
//! whoever implements [`Programs`].

mod bindings;
mod cache;
mod device;
mod error;
mod executor;
mod freshness;
mod kernel;
pub mod memory;
mod port_data;
mod readback;
mod scene;
mod setup;
mod slots;
mod timing;
mod view;

pub use cache::PipelineCache;
pub use device::{AdapterSummary, Gpu, adapters};
pub use error::{GpuError, bytes};
pub use executor::{Executor, FRAMES_PER_SECOND, FrameOptions, FrameReport, PassCounters};
pub use kernel::{Kernel, Raster, RasterTargets};
pub use port_data::{Numbers, PortData};
pub use scene::SceneBuffers;
pub use setup::{Program, Programs, Recorder, Setup};
pub use timing::Timing;
pub use view::PlannedView;
pub use wgpu;
