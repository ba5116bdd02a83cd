//! Standard output and standard error: a reader that goes away is no reason to panic.

use std::io::{IsTerminal, Write, stderr, stdout};

/// Writes a line to standard output.
pub(crate) fn line(text: &str) {
    // Whoever reads may have closed the pipe; there is nobody left to tell.
    let _ = writeln!(stdout(), "{text}");
}

/// Writes a text as it is to standard output.
pub(crate) fn text(text: &str) {
    let _ = write!(stdout(), "{text}").and_then(|()| stdout().flush());
}

/// Writes a text to standard error, ended by a new line.
pub(crate) fn error(text: &str) {
    let _ = writeln!(stderr(), "{}", text.trim_end());
}

/// Whether errors may be coloured: standard error is a terminal and nobody has asked for none.
pub(crate) fn color() -> bool {
    stderr().is_terminal() && std::env::var_os("NO_COLOR").is_none_or(|value| value.is_empty())
}
