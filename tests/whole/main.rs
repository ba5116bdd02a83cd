//! What every shipped plugin and graph is needed for, in one process.

#![allow(clippy::unwrap_used, reason = "a test may panic")]

mod accuracy;
mod architecture;
mod broken_plugins;
mod codes;
mod conformance;
mod elsewhere;
mod extremes;
mod folders;
mod image_coverage;
mod kept;
mod models;
mod modes;
mod mutants;
mod orders;
mod physics;
mod pictures;
mod ports;
mod provenance;
mod sharing;
mod support;
mod tables;
