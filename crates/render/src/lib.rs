//! From files to frames: a graph file and its scene are read and checked together, planned, and run on a device.
//!
//! What every program over the layers below does in the same way: the command line, image tests, whoever renders from
//! Rust. Knows no command line: whoever has one fills a [`Request`].
//!
//! ```no_run
//! # use std::path::PathBuf;
//! # use tyndall_document::Diagnostics;
//! # use tyndall_gpu::{FrameOptions, Gpu, PipelineCache};
//! # use tyndall_graph::Roots;
//! # use tyndall_render::{Request, Running, Wanted, load, plan, registry};
//! # fn main() -> Result<(), tyndall_render::Error> {
//! let registry = registry(vec![/* plugins */], &[])?;
//! let mut out = Diagnostics::new();
//! let request = Request { graph: PathBuf::from("fog.graph.ron"), ..Request::default() };
//! let Some(loaded) = load(&request, &registry, &mut out) else { return Err(out.into()) };
//! let plan = plan(&loaded, Wanted { roots: Roots::Outputs, keep: false, live: &[] })?;
//! let mut cache = PipelineCache::default();
//! let mut running = Running::new(&Gpu::open(None)?, plan, loaded.scene.as_ref(), &registry, &mut cache)?;
//! running.frame(FrameOptions::default())?;
//! # Ok(()) }
//! ```

pub mod codes;
mod error;
mod load;
mod picture;
mod plugins;
mod running;
#[cfg(test)]
mod tests;

pub use codes::CODES;
pub use error::Error;
pub use load::{Loaded, Request, Setting, Wanted, load, plan};
pub use picture::{image, meaning, shape};
pub use plugins::registry;
pub use running::Running;
