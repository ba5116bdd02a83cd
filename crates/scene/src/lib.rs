//! Scenes: scene files, glTF 2.0, primitives, and their encoding as bytes for the GPU. Knows no graph and no GPU.
//!
//! ```no_run
//! use std::path::Path;
//! use tyndall_scene::{Overrides, Scene};
//!
//! # fn main() -> Result<(), tyndall_document::Diagnostics> {
//! let (scene, warnings) = Scene::load(Path::new("graphs/scenes/pavilion.scene.ron"), &Overrides::new())?;
//! let mut encoded = scene.encode(0.0, 16.0 / 9.0);
//! for (name, bytes) in &encoded.items { /* upload */ }
//! let changed = encoded.update(&scene, 1.0 / 24.0, 16.0 / 9.0); // a subset of `scene.animated()`
//! # Ok(()) }
//! ```
//!
//! Lengths are metres, angles radians (degrees in files), colours linear RGB, space right-handed with +y up.

pub mod adjacency;
pub mod animate;
pub mod codes;
mod cosine_lobes;
mod decode;
mod encode;
mod frame;
mod gltf;
pub mod layout;
mod mesh;
pub mod model;
mod occluders;
mod overrides;
mod phase_file;
mod primitives;
mod resolve;
mod scene;
mod shadows;
mod twin;

pub use self::codes::CODES;
pub use self::cosine_lobes::{COSINE_LOBES_MAX, SHININESSES_MAX, SPOTS_MAX};
pub use self::encode::{Encoded, SCENE_DATA, phase_table};
pub use self::frame::{Bounds, Frame, FrameLight, View};
pub use self::mesh::Mesh;
pub use self::overrides::{Override, Overrides};
pub use self::primitives::Primitive;
pub use self::scene::Scene;
pub use tyndall_shaders::scene::{HeightFog, Phase};
