//! The program from outside: what it is called with, what it writes, and how it ends. What its pictures hold is tested in
//! `whole`, without starting it.

#![allow(clippy::unwrap_used, reason = "a test may panic")]

mod analytic_casters;
mod assets;
mod bench;
mod check;
mod compare;
mod contributing;
mod exit_codes;
mod fuzz;
mod image_tests;
mod outputs;
mod plugins;
mod render;
mod run;
mod settings;
mod show;
mod tables;
mod watch;
