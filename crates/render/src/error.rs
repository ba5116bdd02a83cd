//! Why nothing could be rendered.

use tyndall_document::{Diagnostic, Diagnostics, render_text};
use tyndall_gpu::GpuError;

/// Why nothing could be rendered.
#[derive(Debug, Clone, thiserror::Error)]
pub enum Error {
    /// The input is wrong; each mistake has its place.
    #[error("{}", render_text(.0, false).trim_end())]
    Mistakes(Diagnostics),
    /// The machine cannot do it, or a pass found a file wrong.
    #[error(transparent)]
    Gpu(#[from] GpuError),
}

impl From<Diagnostics> for Error {
    fn from(mistakes: Diagnostics) -> Self {
        Self::Mistakes(mistakes)
    }
}

impl From<Vec<Diagnostic>> for Error {
    fn from(mistakes: Vec<Diagnostic>) -> Self {
        Self::Mistakes(mistakes.into_iter().collect())
    }
}
