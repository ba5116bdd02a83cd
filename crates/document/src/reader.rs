//! The state of a reading: its position, what it has reported, and the space between tokens.

use std::sync::Arc;

use unicode_ident::{is_xid_continue, is_xid_start};

use crate::{Code, Diagnostic, Place, Source, Span, TOO_MANY_ERRORS, UNTERMINATED_COMMENT};

/// After this many syntax errors the rest of a document is not read.
const MOST_ERRORS: usize = 100;

/// One reading of one source.
pub(crate) struct Reader<'a> {
    pub source: &'a Arc<Source>,
    pub text: &'a str,
    pub bytes: &'a [u8],
    /// Offset of the next byte to be read.
    pub at: usize,
    /// Brackets that are open here, outermost first.
    pub open: Vec<Open>,
    /// Mistakes that only follow from another one if the bracket around them turns out to be unclosed.
    pub held: Vec<Held>,
    pub out: Vec<Diagnostic>,
    /// How many syntax errors there were, the held ones included.
    pub errors: usize,
    /// A bracket was unclosed, unopened or too deep: text after the value follows from that.
    pub brackets_broken: bool,
    /// Index in `out` of the report that the text ends within brackets.
    pub ended_within: Option<usize>,
    /// An opening bracket and its closing one that is indented differently.
    pub suspect: Option<(usize, usize)>,
    /// What was held when the suspect was closed: mistakes in their own right only if the text does not end within
    /// brackets.
    pub suspect_held: Vec<Held>,
    /// No raw string with this many `#` or more ends in the rest of the text.
    pub raw_without_end: usize,
    /// The text ends within a comment, which may hold brackets that close those open.
    pub ends_in_comment: bool,
    given_up: bool,
}

/// A bracket that is open.
pub(crate) struct Open {
    /// Offset of the opening bracket.
    pub at: usize,
    /// The bracket that closes it.
    pub close: u8,
}

/// A held mistake.
pub(crate) struct Held {
    pub diagnostic: Diagnostic,
    /// Where the item concerned begins.
    pub item: usize,
}

impl<'a> Reader<'a> {
    pub fn new(source: &'a Arc<Source>) -> Self {
        Self {
            source,
            text: source.text(),
            bytes: source.text().as_bytes(),
            at: 0,
            open: Vec::new(),
            held: Vec::new(),
            out: Vec::new(),
            errors: 0,
            brackets_broken: false,
            ended_within: None,
            suspect: None,
            suspect_held: Vec::new(),
            raw_without_end: usize::MAX,
            ends_in_comment: false,
            given_up: false,
        }
    }

    /// The next byte.
    pub fn byte(&self) -> Option<u8> {
        self.bytes.get(self.at).copied()
    }

    /// The byte this far ahead.
    pub fn ahead(&self, count: usize) -> Option<u8> {
        self.bytes.get(self.at + count).copied()
    }

    pub fn place(&self, start: usize, end: usize) -> Place {
        self.source.place(span(start, end))
    }

    /// A syntax error that has not been reported yet.
    pub fn error(&self, code: Code, start: usize, end: usize, message: impl Into<String>) -> Diagnostic {
        Diagnostic::error(code, self.place(start, end), message)
    }

    /// Reports a syntax error. Too many end the reading.
    pub fn report(&mut self, diagnostic: Diagnostic) {
        if self.given_up {
            return;
        }
        self.errors += 1;
        self.out.push(diagnostic);
        if self.errors >= MOST_ERRORS {
            let message = format!("after {MOST_ERRORS} syntax errors the rest of the file is not read");
            self.out.push(self.error(TOO_MANY_ERRORS, self.at, self.at, message));
            self.given_up = true;
            self.at = self.bytes.len();
        }
    }

    /// Moves over space and comments.
    pub fn skip_space(&mut self) {
        match space_end(self.bytes, self.at) {
            Ok(end) => self.at = end,
            Err(comment) => {
                self.at = self.bytes.len();
                self.ends_in_comment = true;
                let error = self.error(UNTERMINATED_COMMENT, comment, comment + 2, "this comment is not closed");
                self.report(error.suggest("close it with `*/`; a comment within a comment needs its own"));
            }
        }
    }

    /// Name and end of the identifier that begins at an offset; the name of a raw one (`r#a-b`) omits the `r#`.
    pub fn identifier_at(&self, at: usize) -> Option<(&'a str, usize)> {
        let rest = &self.bytes[at..];
        match *rest.first()? {
            b'r' if matches!(rest.get(1), Some(b'"')) => return None,
            b'r' if matches!(rest.get(1), Some(b'#')) => {
                let end = self.run_end(at + 2, |c| is_xid_continue(c) || matches!(c, '.' | '+' | '-'));
                return (end > at + 2).then(|| (&self.text[at + 2..end], end));
            }
            b'b' if matches!(rest.get(1), Some(b'"' | b'\'')) => return None,
            b'b' if matches!(rest.get(1..3), Some(b"r\"" | b"r#")) => return None,
            byte if byte.is_ascii_alphabetic() || byte == b'_' => {}
            byte if byte.is_ascii() => return None,
            _ if self.text[at..].starts_with(is_xid_start) => {}
            _ => return None,
        }
        let end = self.run_end(at, is_xid_continue);
        Some((&self.text[at..end], end))
    }

    /// The end of the run of characters from an offset on for which `holds` is true.
    pub fn run_end(&self, at: usize, holds: impl Fn(char) -> bool) -> usize {
        let mut end = at;
        loop {
            // Nearly all are ASCII, which needs no table.
            match self.bytes.get(end) {
                Some(byte) if byte.is_ascii_alphanumeric() || *byte == b'_' => end += 1,
                Some(byte) if byte.is_ascii() && !holds(char::from(*byte)) => return end,
                None => return end,
                _ => match self.text[end..].chars().next() {
                    Some(character) if holds(character) => end += character.len_utf8(),
                    _ => return end,
                },
            }
        }
    }

    /// End of the token that begins here, for showing it: a word, a string, or one character.
    pub fn token_end(&self, at: usize) -> usize {
        match self.bytes.get(at) {
            None => at,
            Some(b'"') => {
                let line = &self.bytes[at + 1..];
                let end = line.iter().position(|byte| matches!(byte, b'"' | b'\n')).unwrap_or(line.len());
                at + 1 + end + usize::from(line.get(end) == Some(&b'"'))
            }
            _ => {
                let end = self.run_end(at, is_word);
                if end > at { end } else { at + self.text[at..].chars().next().map_or(0, char::len_utf8) }
            }
        }
    }

    /// The token that begins here, for a message.
    pub fn token(&self, at: usize) -> String {
        if at >= self.bytes.len() {
            return "the end".to_owned();
        }
        format!("`{}`", crate::node::shortened(&self.text[at..self.token_end(at)]))
    }

    /// The end of the text without trailing space.
    pub fn last(&self) -> usize {
        self.text.trim_end().len()
    }
}

/// Whether a character may be part of a number, or of a word that was probably meant to be a string.
pub(crate) fn is_word(character: char) -> bool {
    is_xid_continue(character) || matches!(character, '.' | '+' | '-' | '$')
}

/// A span of offsets; texts are shorter than 4 GiB.
pub(crate) fn span(start: usize, end: usize) -> Span {
    Span { start: start as u32, end: end as u32 }
}

/// The end of space and comments; an error is the start of a comment that is not closed.
pub(crate) fn space_end(bytes: &[u8], mut at: usize) -> Result<usize, usize> {
    loop {
        match bytes.get(at) {
            Some(b' ' | b'\n' | b'\t' | b'\r' | 0x0b | 0x0c) => at += 1,
            Some(b'/') => match bytes.get(at + 1) {
                Some(b'/') => {
                    at += bytes[at..].iter().position(|byte| *byte == b'\n').unwrap_or(bytes.len() - at);
                }
                Some(b'*') => at = comment_end(bytes, at)?,
                _ => return Ok(at),
            },
            // U+0085; U+200E, U+200F, U+2028, U+2029.
            Some(0xc2) if bytes.get(at + 1) == Some(&0x85) => at += 2,
            Some(0xe2) if matches!(bytes.get(at + 1..at + 3), Some([0x80, 0x8e | 0x8f | 0xa8 | 0xa9])) => at += 3,
            _ => return Ok(at),
        }
    }
}

/// The end of the block comment that begins at an offset; comments nest.
fn comment_end(bytes: &[u8], start: usize) -> Result<usize, usize> {
    let mut level = 0;
    let mut at = start;
    while at < bytes.len() {
        match bytes[at..] {
            [b'/', b'*', ..] => {
                level += 1;
                at += 2;
            }
            [b'*', b'/', ..] => {
                level -= 1;
                at += 2;
                if level == 0 {
                    return Ok(at);
                }
            }
            _ => at += 1,
        }
    }
    Err(start)
}
