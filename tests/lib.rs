//! What tests of the whole share: a folder for files, pictures that are drawn in this process, and pictures that were
//! computed elsewhere to hold them against.

#![allow(clippy::unwrap_used, reason = "tests may panic")]

pub mod broken;
mod desk;
mod samples;
pub mod tint;

pub use desk::{Desk, SCENE, root, sessions, shipped, text};
pub use samples::{Samples, reference, sum_error};
