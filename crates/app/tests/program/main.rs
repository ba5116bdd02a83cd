//! The program from outside: what it is called with, what it writes, and how it ends.

#![allow(clippy::unwrap_used, reason = "a test may panic")]

mod accuracy;
mod bench;
mod check;
mod contributing;
mod exit_codes;
mod physics;
mod pictures;
mod render;
mod run;
mod show;
mod tables;
