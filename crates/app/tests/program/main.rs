//! The program from outside: what it is called with, what it writes, and how it ends.

#![allow(clippy::unwrap_used, reason = "a test may panic")]

mod accuracy;
mod aerial;
mod analytic_casters;
mod architecture;
mod assets;
mod bench;
mod biri;
mod casters;
mod check;
mod codes;
mod compare;
mod contributing;
mod exit_codes;
mod froxels;
mod fuzz;
mod image_coverage;
mod image_tests;
mod models;
mod modes;
mod orders;
mod outputs;
mod physics;
mod pictures;
mod plugins;
mod render;
mod run;
mod settings;
mod shadows;
mod show;
mod tables;
mod watch;
