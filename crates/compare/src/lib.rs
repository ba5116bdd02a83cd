//! Comparisons: the same scenes by several methods, each against double precision; error, time and memory, as tables and as
//! a page with pictures, maps of the error, and plots of error over time.
//!
//! | step | function | gives |
//! | --- | --- | --- |
//! | a `.compare.ron` file to its entries | [`read`] | [`CompareFile`] |
//! | entries to checked scenes and planned graphs, without a GPU | [`prepare`] | [`PreparedScene`] |
//! | pictures, truth, errors, times | [`compare`] | [`Comparison`] |
//!
//! The truth is computed by the twins of the shaders (`tyndall_shaders`), whatever the methods are.

mod casters;
pub mod codes;
mod color;
mod errors;
mod figures;
mod file;
mod measure;
mod page;
mod prepare;
mod report;
mod round;
mod run;
mod table;
#[cfg(test)]
mod tests;
mod truth;

pub use codes::CODES;
pub use file::{CompareFile, Entry, read};
pub use prepare::{PreparedScene, prepare};
pub use report::Comparison;
pub use run::{Error, Progress, compare, steps};
