//! Standard output and standard error, without a panic if the reader goes away.

use std::io::{ErrorKind, IsTerminal, Result, Write, stderr, stdout};
use std::sync::atomic::{AtomicBool, Ordering};

/// Writes a line to standard output.
pub(crate) fn line(text: &str) {
    note(writeln!(stdout(), "{text}").and_then(|()| stdout().flush()));
}

/// Writes a text to standard output as it is.
pub(crate) fn text(text: &str) {
    note(write!(stdout(), "{text}").and_then(|()| stdout().flush()));
}

static LOST: AtomicBool = AtomicBool::new(false);

/// If the reader has closed the pipe, nobody is left to read; every other failure is remembered.
fn note(written: Result<()>) {
    if written.is_err_and(|error| error.kind() != ErrorKind::BrokenPipe) {
        LOST.store(true, Ordering::Relaxed);
    }
}

/// Whether output was lost, because its disk is full, for example.
pub(crate) fn output_lost() -> bool {
    LOST.load(Ordering::Relaxed)
}

/// Writes a text to standard error, followed by a line break.
pub(crate) fn error(text: &str) {
    let _ = writeln!(stderr(), "{}", text.trim_end());
}

/// Whether errors may be coloured: standard error is a terminal, and colours are not switched off.
pub(crate) fn color() -> bool {
    stderr().is_terminal() && std::env::var_os("NO_COLOR").is_none_or(|value| value.is_empty())
}

/// Where there is no desktop, Mesa's device-select layer writes an error about `XDG_RUNTIME_DIR` to standard error at every
/// start. It has nothing to select then, unless somebody asked it to.
#[allow(unsafe_code, reason = "setting a variable is sound while the program has one thread, which is so at its start")]
pub(crate) fn quieten_device_select() {
    let is_set = |name: &str| std::env::var_os(name).is_some();
    let asked = is_set("MESA_VK_DEVICE_SELECT") || is_set("DRI_PRIME") || is_set("NODEVICE_SELECT");
    if cfg!(target_os = "linux") && !is_set("XDG_RUNTIME_DIR") && !asked {
        // SAFETY: `App::run` calls this before anything has started a thread.
        unsafe { std::env::set_var("NODEVICE_SELECT", "1") };
    }
}
