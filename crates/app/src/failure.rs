//! Why a verb did not do its work, and the exit code that says so.

use tyndall_document::{Diagnostic, Diagnostics, render_text};
use tyndall_gpu::GpuError;

use crate::terminal;

/// Why a verb did not do its work.
#[derive(Debug)]
pub(crate) enum Failure {
    /// The input is wrong; each mistake has its place.
    Mistakes(Diagnostics),
    /// The command line is wrong.
    Usage(String),
    /// The machine cannot do it, or a pass cannot use a file.
    Gpu(GpuError),
    /// A file could not be read or written.
    File(tyndall_image::Error),
    /// Everything has been reported; only the exit code is left.
    Reported(u8),
}

impl Failure {
    /// 1 a comparison failed, 2 the input or the usage is wrong, 3 the machine cannot do it.
    pub fn exit_code(&self) -> u8 {
        match self {
            // Whatever else is wrong: with a shader that does not compile, no machine could run it.
            Failure::Mistakes(mistakes) if mistakes.iter().any(of_a_shader) => 3,
            Failure::Mistakes(_) | Failure::Usage(_) | Failure::Gpu(GpuError::Input { .. }) => 2,
            Failure::Gpu(_) => 3,
            Failure::File(error) => error.exit_code(),
            Failure::Reported(code) => *code,
        }
    }

    /// Prints it to standard error.
    pub fn print(&self) {
        match self {
            Failure::Mistakes(mistakes) => terminal::error(&render_text(mistakes, terminal::color())),
            Failure::Usage(text) => terminal::error(&format!("error: {text}")),
            Failure::Gpu(error) => terminal::error(&format!("error: {error}")),
            Failure::File(error) => terminal::error(&format!("error: {error}")),
            Failure::Reported(_) => {}
        }
    }
}

/// Whether a shader does not compile, or disagrees with its pass.
fn of_a_shader(mistake: &Diagnostic) -> bool {
    tyndall_shader::CODES.contains(&mistake.code)
}

impl From<GpuError> for Failure {
    fn from(error: GpuError) -> Self {
        Self::Gpu(error)
    }
}

impl From<tyndall_render::Error> for Failure {
    fn from(error: tyndall_render::Error) -> Self {
        match error {
            tyndall_render::Error::Mistakes(mistakes) => Self::Mistakes(mistakes),
            tyndall_render::Error::Gpu(error) => Self::Gpu(error),
        }
    }
}

impl From<tyndall_image::Error> for Failure {
    fn from(error: tyndall_image::Error) -> Self {
        Self::File(error)
    }
}

impl From<Diagnostics> for Failure {
    fn from(mistakes: Diagnostics) -> Self {
        Self::Mistakes(mistakes)
    }
}

impl From<Diagnostic> for Failure {
    fn from(mistake: Diagnostic) -> Self {
        Self::Mistakes(mistake.into())
    }
}

impl From<Vec<Diagnostic>> for Failure {
    fn from(mistakes: Vec<Diagnostic>) -> Self {
        Self::Mistakes(mistakes.into_iter().collect())
    }
}
