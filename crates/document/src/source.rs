//! A text that was read, and positions in it.

use std::fmt;
use std::fs::File;
use std::io::{ErrorKind, Read};
use std::path::Path;
use std::sync::Arc;

use crate::{Diagnostic, MISSING_FILE, Place, UNREADABLE_FILE};

/// Larger files are not read: 1 GiB.
const MOST_BYTES: u64 = 1 << 30;

/// Bytes `start..end` of a [`Source`]'s text; both lie on character boundaries.
#[derive(Copy, Clone, PartialEq, Eq, PartialOrd, Ord, Hash, Debug, Default)]
pub struct Span {
    /// Offset of the first byte.
    pub start: u32,
    /// Offset after the last byte.
    pub end: u32,
}

impl Span {
    /// The bytes `start..end`.
    pub const fn new(start: u32, end: u32) -> Self {
        Self { start, end }
    }

    /// From the start of this span to the end of another one.
    pub const fn to(self, other: Span) -> Span {
        Span { start: self.start, end: other.end }
    }
}

/// A text with a name: a file that was read, or an argument of the command line.
///
/// A byte order mark at its start is not part of the text.
pub struct Source {
    name: String,
    text: String,
    /// Offset of the first byte of every line.
    lines: Vec<u32>,
    argument: bool,
}

impl Source {
    /// A text under the name that diagnostics show: a file's path as the user gave it.
    pub fn new(name: impl Into<String>, text: impl Into<String>) -> Arc<Self> {
        Arc::new(Self::build(name.into(), text.into(), false))
    }

    /// The value of a command-line argument. `argument` is how the user wrote it (`--set exposure=2`) and `text` the
    /// part to be read (`2`). Places in such a source name the argument instead of a line and a column.
    pub fn argument(argument: impl Into<String>, text: impl Into<String>) -> Arc<Self> {
        Arc::new(Self::build(argument.into(), text.into(), true))
    }

    /// Reads a file whole. It must be UTF-8.
    ///
    /// # Errors
    /// [`MISSING_FILE`] where it does not exist, [`UNREADABLE_FILE`] where it is a folder, is not UTF-8, is larger than
    /// 1 GiB, or may not be read. The place names the path as it was given.
    pub fn read(path: &Path) -> Result<Arc<Self>, Diagnostic> {
        let name = path.display().to_string();
        let unreadable =
            |why: &str| Diagnostic::error(UNREADABLE_FILE, Place::File(name.clone()), format!("`{name}` {why}"));
        match std::fs::metadata(path) {
            Err(error) if matches!(error.kind(), ErrorKind::NotFound | ErrorKind::NotADirectory) => {
                let message = format!("there is no file `{name}`");
                return Err(Diagnostic::error(MISSING_FILE, Place::File(name), message));
            }
            Ok(data) if data.is_dir() => return Err(unreadable("is a folder, not a file")),
            _ => {}
        }
        // The system's length is not used: that of a device is 0.
        let mut bytes = Vec::new();
        File::open(path)
            .and_then(|file| file.take(MOST_BYTES + 1).read_to_end(&mut bytes))
            .map_err(|error| unreadable(&format!("cannot be read: {error}")))?;
        if bytes.len() as u64 > MOST_BYTES {
            return Err(unreadable("is larger than 1 GiB"));
        }
        match String::from_utf8(bytes) {
            Ok(text) => Ok(Self::new(name, text)),
            Err(error) => {
                let good = error.utf8_error().valid_up_to();
                let line = error.as_bytes()[..good].iter().filter(|byte| **byte == b'\n').count() + 1;
                Err(unreadable(&format!(
                    "is not UTF-8 text: byte {good}, in line {line}, is not part of a valid character"
                )))
            }
        }
    }

    fn build(name: String, mut text: String, argument: bool) -> Self {
        if text.starts_with('\u{feff}') {
            text.drain(..3);
        }
        let lines = std::iter::once(0)
            .chain(text.bytes().enumerate().filter(|(_, byte)| *byte == b'\n').map(|(at, _)| at as u32 + 1))
            .collect();
        Self { name, text, lines, argument }
    }

    /// The name that diagnostics show.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// The whole text.
    pub fn text(&self) -> &str {
        &self.text
    }

    /// The value of a command-line argument, see [`Source::argument`].
    pub fn is_argument(&self) -> bool {
        self.argument
    }

    /// The text of a span; empty where the span does not lie in this text.
    pub fn slice(&self, span: Span) -> &str {
        self.text.get(span.start as usize..span.end as usize).unwrap_or("")
    }

    /// The place of a span: in the text, or the argument that the text came from.
    pub fn place(self: &Arc<Self>, span: Span) -> Place {
        if self.argument { Place::Argument(self.name.clone()) } else { Place::Text { source: Arc::clone(self), span } }
    }

    /// Line and column of a byte offset; both count from 1, columns in characters.
    pub fn line_column(&self, offset: u32) -> (u32, u32) {
        let line = self.line_index(offset);
        let start = self.lines[line] as usize;
        let before = self.text.as_bytes().get(start..(offset as usize).min(self.text.len())).unwrap_or(&[]);
        // Every byte that does not continue a character starts one.
        let column = before.iter().filter(|byte| **byte & 0xc0 != 0x80).count();
        (line as u32 + 1, column as u32 + 1)
    }

    /// Index, from 0, of the line that holds an offset.
    pub(crate) fn line_index(&self, offset: u32) -> usize {
        self.lines.partition_point(|start| *start <= offset) - 1
    }

    /// The character boundary at or before an offset.
    pub(crate) fn boundary(&self, offset: u32) -> u32 {
        self.text.floor_char_boundary(offset as usize) as u32
    }

    /// The bytes of lines `first..=last`, counted from 0, without the last line's end.
    pub(crate) fn line_span(&self, first: usize, last: usize) -> Span {
        let start = self.lines[first];
        let end = self.lines.get(last + 1).map_or(self.text.len() as u32, |next| next - 1);
        let line = self.text.as_bytes();
        let carriage = end > start && line[end as usize - 1] == b'\r';
        Span { start, end: end - u32::from(carriage) }
    }
}

impl fmt::Debug for Source {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "Source({:?}, {} bytes)", self.name, self.text.len())
    }
}
