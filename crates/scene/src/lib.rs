//! Scenes: scene files, glTF 2.0, primitives, and their encoding as bytes for the GPU. Knows no graph, no GPU and no
//! technique: what only a technique needs, its plugin adds in an [`Extension`].
//!
//! * [`SceneData`]: buffers that passes read by name, made on the CPU from the scene of a frame.
//! * [`SceneField`]: fields of the scene file.
//! * [`Feature`] and [`Refusal`]: what scenes can have that some passes do not do justice to, or are wrong with.
//!
//! ```no_run
//! use std::path::Path;
//! use std::sync::Arc;
//! use tyndall_scene::{Extensions, Overrides, Scene};
//!
//! # fn main() -> Result<(), tyndall_document::Diagnostics> {
//! let extensions = Arc::new(Extensions::default());
//! let path = Path::new("graphs/scenes/pavilion.scene.ron");
//! let (scene, warnings) = Scene::load(path, &Overrides::new(), &extensions)?;
//! let mut encoded = scene.encode(0.0, 16.0 / 9.0);
//! for (name, bytes) in &encoded.items { /* upload */ }
//! let changed = encoded.update(&scene, 1.0 / 24.0, 16.0 / 9.0); // a subset of `scene.animated_place()`
//! # Ok(()) }
//! ```
//!
//! Lengths are metres, angles radians (degrees in files), colours linear RGB, space right-handed with +y up.

pub mod adjacency;
pub mod animate;
pub mod codes;
mod core_data;
mod decode;
mod encoded;
mod extensions;
mod feature;
mod field;
mod frame;
mod geometry;
mod gltf;
pub mod layout;
mod mesh;
pub mod microfacets;
pub mod model;
mod moment;
mod overrides;
mod part;
mod phase_file;
mod primitives;
pub mod read;
mod resolve;
mod scene;
mod scene_data;
mod twin;

pub use self::codes::CODES;
pub use self::core_data::{cosine_of_cutoff, phase_table};
pub use self::encoded::Encoded;
pub use self::extensions::{Extension, Extensions};
pub use self::feature::{Feature, Refusal};
pub use self::field::{FieldValue, Fields, Holder, HoldsFields, MediumFields, SceneField};
pub use self::frame::{Bounds, Frame, FrameLight, View};
pub use self::mesh::Mesh;
pub use self::moment::Moment;
pub use self::overrides::{Override, Overrides};
pub use self::part::Part;
pub use self::primitives::Primitive;
pub use self::scene::Scene;
pub use self::scene_data::{Buffers, Encoder, SceneData, list};
pub use tyndall_shaders::scene::{HeightFog, Phase};
