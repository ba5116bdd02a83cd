//! WGSL shaders: modules with imports, validation, reflection, and the check against what a pass declares.
//!
//! [`link`] joins a shader with the modules that it imports, validates the whole with naga, assigns the bindings that
//! authors do not write, and reflects what the shader needs: [`Resource`]s, [`Param`]s, [`EntryPoint`]s. The
//! [`naga::Module`] in [`Linked`] is what the GPU layer hands to wgpu. [`check`] compares a shader with a pass
//! descriptor, and [`reflect_ports`] makes the part of a descriptor that WGSL knows. Every mistake is a
//! [`tyndall_document::Diagnostic`] that points into the file that its author wrote.
//!
//! # What an author writes
//! ```wgsl
//! #import scene                                   // a shared module: shaders/scene.wgsl
//! #import "march.wgsl"                            // a file of the same plugin's folder
//! #require fn from_light(light: Light) -> vec3<f32>   // in a module: declared by the shader that imports it
//! struct Params { exposure: f32 }
//! var<uniform> params: Params;                    // parameters by member name
//! override nodes: u32 = 12;                       // a parameter too: part of the pipeline
//! var<uniform> camera: Camera;                    // scene data by name
//! var depth: texture_2d<f32>;                     // input port
//! var radiance: texture_storage_2d<rgba32float, write>;   // output port
//! ```
//! No `@group`, no `@binding`, no `@id`: [`link`] assigns `@group(0) @binding(n)` to the variables that some entry
//! point uses, in the order of their names; all others are dropped from the module. The value of an
//! `override` is given when the pipeline is made, as wgpu's pipeline constant of the same name. One named after a list of
//! the scene (`override lights_count: u32`) is its element count, see [`counted`].
//!
//! This crate knows naga and no wgpu; nothing here touches a GPU or (but for [`Library::read_folder`]) a file.

mod assemble;
mod check;
pub mod codes;
mod errors;
mod guard;
mod library;
mod link;
mod map;
mod meaning;
mod mutate;
mod naming;
mod params;
mod ports;
mod reflect;
mod require;
mod scan;
mod types;
mod usage;

pub use check::{check, check_all};
pub use codes::CODES;
pub use library::Library;
pub use link::{CAPABILITIES, Linked, Unused, link};
pub use mutate::{Mutation, MutationKind};
pub use naming::{PARAMS, SAMPLERS, Sampler, UNFINISHED, counted, sampler};
pub use params::{Param, ParamDefault, ParamKind, ParamSource};
pub use ports::{ReflectedPort, derive_port, reflect_ports};
pub use reflect::{EntryPoint, Resource, ResourceKind, SampleClass, Target, storage_format};
pub use types::{Member, members};
