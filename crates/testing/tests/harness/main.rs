//! The harness tests itself: what is broken on purpose must be noticed, and laid at the right door.

#![allow(clippy::unwrap_used, reason = "a test may panic")]

mod attribution;
mod browser;
mod chain;
mod goldens;
mod history;
mod report;
mod robustness;
mod unordered;
