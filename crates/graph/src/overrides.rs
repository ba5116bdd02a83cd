//! Values from the command line that replace those of the file.

use std::sync::Arc;

use tyndall_document::{Code, Diagnostic, Diagnostics, Node, Place, Source, parse_value};

use crate::codes;

/// Values from the command line that replace those of the file.
#[derive(Debug, Clone, Default)]
pub struct Overrides {
    /// Values of parameters; the last one for a name wins, and `pass.parameter` takes precedence over `$name`.
    pub params: Vec<Override>,
    /// Size of the frame in pixels.
    pub size: Option<(u32, u32)>,
    /// Another scene, relative to the working directory; then that of the file need not exist.
    pub scene: Option<String>,
}

/// A value for a parameter.
#[derive(Debug, Clone)]
pub struct Override {
    /// A parameter of the graph, or `pass.parameter`.
    pub name: String,
    /// The text of the value.
    pub source: Arc<Source>,
    /// The value.
    pub value: Node,
    /// The argument as typed, for messages: `--set exposure=2`.
    pub argument: String,
}

impl Override {
    /// Reads `NAME=VALUE`, as it was typed in `argument`.
    ///
    /// # Errors
    /// `bad-argument` where there is no `=`; otherwise what is wrong with the value.
    pub fn parse(text: &str, argument: &str) -> Result<Self, Diagnostics> {
        let mut out = Diagnostics::default();
        let Some((name, value)) = text.split_once('=') else {
            let message = format!("`{text}` has no value");
            out.push(at_argument(codes::BAD_ARGUMENT, argument, message).suggest("write NAME=VALUE"));
            return Err(out);
        };
        let source = Source::new(argument, value);
        match parse_value(&source, &mut out) {
            Some(value) if !out.has_errors() => {
                Ok(Self { name: name.trim().to_owned(), source, value, argument: argument.to_owned() })
            }
            _ => Err(moved_to_argument(out, argument)),
        }
    }
}

fn at_argument(code: Code, argument: &str, message: String) -> Diagnostic {
    Diagnostic::error(code, Place::Argument(argument.to_owned()), message)
}

/// The same mistakes, at the argument instead of a position in its value.
pub(crate) fn moved_to_argument(diagnostics: Diagnostics, argument: &str) -> Diagnostics {
    let mut moved = Diagnostics::default();
    for mut diagnostic in diagnostics {
        diagnostic.place = Place::Argument(argument.to_owned());
        moved.push(diagnostic);
    }
    moved
}
