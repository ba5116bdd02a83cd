//! Sunlit air: its shader against its twin, and the pictures of its graph.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]
#![allow(clippy::print_stdout, reason = "the measured errors, which the README quotes")]

mod air;
mod sunlit_air;
