//! Graph files, from text to an immutable plan, without a GPU.
//!
//! A graph goes through four steps, and each has a type of its own:
//!
//! | step | function | gives |
//! | --- | --- | --- |
//! | text to spanned tree | [`read`] | [`GraphFile`] |
//! | tree to typed graph, every mistake collected | [`validate`] | [`Graph`] |
//! | graph to order, slots and sizes | [`plan`](plan()) | [`Plan`] |
//! | plan to something for people | [`show`], [`explain`](explain()) | text, SVG, dot, JSON |
//!
//! Passes are known by their [`descriptor`]s, which a [`Catalogue`] holds. Scene data are opaque names here, and no GPU
//! type occurs.

mod catalogue;
pub mod codes;
pub mod descriptor;
mod digest;
mod explain;
mod file;
mod graph;
mod handle;
mod names;
mod overrides;
mod plan;
mod provenance;
pub mod show;
mod signature;
mod validate;
mod wiring;

pub use catalogue::{Catalogue, Kind, PictureSize};
pub use codes::CODES;
pub use digest::Digest;
pub use explain::explain;
pub use file::{GraphFile, InputEntry, OutputEntry, ParamEntry, PassEntry, Spanned, Switch, Text, read};
pub use graph::{Connection, Graph, GraphParam, ParamRef, ParamSetting, Pass, PortRef, Values};
pub use handle::{Handle, Handles, Segment, Slice, Table};
pub use overrides::{Override, Overrides};
pub use plan::{
    Bytes, ClassBytes, CullReason, Culled, Keep, Order, Plan, PlanOptions, PlannedPass, PlannedPort, Resource, Roots,
    Slot, SlotKind, Step, Until, plan,
};
pub use provenance::{MadeFrom, Origin, Provenance};
pub use signature::DescriptorError;
pub use validate::{validate, validate_with};
