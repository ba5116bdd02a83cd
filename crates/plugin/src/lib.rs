//! What the author of a plugin sees: a folder with a manifest and WGSL, passes in Rust where one dispatch is not
//! enough, and the registry that the program reads them from.
//!
//! * A **data plugin** is a folder with `plugin.ron` and WGSL files, found at run time. No compiler is needed.
//! * A **crate plugin** is the same folder inside a crate, embedded with [`folder!`], plus [`RustPass`]es. Where the
//!   folder itself is found at run time too, its files win over the embedded ones, so WGSL can be edited without a build.
//!
//! Both declare passes by the same descriptor and go through the same checks: when a graph first uses a pass, the
//! [`Registry`] links its shaders and holds them against what is declared.

pub mod codes;
mod dispatch;
mod folder;
mod found;
pub mod keys;
mod layout;
mod limits;
mod linker;
mod manifest;
mod pass;
mod ports;
mod presets;
mod reference;
mod registry;
mod search;

pub use codes::CODES;
pub use folder::{Folder, Origin};
pub use limits::Limit;
pub use manifest::Version;
pub use pass::{Plugin, RustPass, Shaders};
pub use ports::Need;
pub use reference::{Outputs, Pixel, Reference, ReferenceInput, each_texel, rgb, rgba};
pub use registry::{Registry, RegistryPass};
pub use search::{SearchPath, find_folders, shader_modules};

// What a pass in Rust needs, under one roof.
pub use tyndall_gpu::{GpuError, Kernel, Numbers, PortData, Program, Raster, RasterTargets, Recorder, Setup, wgpu};
pub use tyndall_graph::{Handle, Resource, Table, descriptor};

// What scene data and scene fields need.
pub use tyndall_scene as scene;
