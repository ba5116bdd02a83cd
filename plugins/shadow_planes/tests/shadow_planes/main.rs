//! Volumetric shadows: the walk of their shader against brute force, and pictures of the graphs that draw them.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]
#![allow(clippy::print_stdout, reason = "the measured errors, which the README quotes")]

mod biri;
mod casters;
mod shadows;
mod soup;
mod walk;
