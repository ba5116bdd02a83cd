//! Strings, characters and their escapes.

use crate::reader::{Reader, space_end, span};
use crate::{BAD_CHARACTER, BAD_ESCAPE, Node, UNTERMINATED_STRING, Value};

/// Where a string that begins with a quote ends.
enum End {
    /// The offset of its closing quote, and whether escapes stand before it.
    At(usize, bool),
    /// It has none: the offset where it was probably meant to end.
    Missing(usize),
}

impl Reader<'_> {
    /// Reads the string whose opening quote is next.
    pub fn string(&mut self) -> Node {
        let start = self.at;
        let text = match self.string_end(start) {
            End::At(end, escaped) => {
                self.at = end + 1;
                if escaped { self.unescape(start + 1, end) } else { self.text[start + 1..end].to_owned() }
            }
            End::Missing(end) => {
                self.at = end;
                let error = self.error(UNTERMINATED_STRING, start, end, "the string has no closing quote");
                self.report(error.suggest("close it with `\"`"));
                String::new()
            }
        };
        Node { span: span(start, self.at), value: Value::Text(text) }
    }

    /// Moves over the string whose opening quote is next, without a report.
    pub fn skip_string(&mut self) {
        self.at = match self.string_end(self.at) {
            End::At(end, _) => end + 1,
            End::Missing(end) => end,
        };
    }

    /// A string may hold line breaks. So a missing quote shows late: the string ends where the next one was meant to
    /// begin. What follows that quote gives it away.
    fn string_end(&self, start: usize) -> End {
        let mut at = start + 1;
        let mut several_lines = false;
        let mut escaped = false;
        while let Some(byte) = self.bytes.get(at) {
            match byte {
                b'"' if several_lines && !self.may_follow_string(at + 1) => break,
                b'"' => return End::At(at, escaped),
                b'\\' => {
                    several_lines |= self.bytes.get(at + 1) == Some(&b'\n');
                    escaped = true;
                    at += 2;
                }
                byte => {
                    several_lines |= *byte == b'\n';
                    at += 1;
                }
            }
        }
        End::Missing(self.probable_end(start + 1))
    }

    /// Where a string without an end was probably meant to end: in the same line, before what closes things there.
    fn probable_end(&self, first: usize) -> usize {
        let line = self.text[first..].lines().next().unwrap_or("");
        first + line.trim_end_matches([' ', '\t', ',', ')', ']', '}']).len()
    }

    /// Whether the text at an offset may follow a string, a forgotten comma allowed for.
    fn may_follow_string(&self, at: usize) -> bool {
        let Ok(at) = space_end(self.bytes, at) else { return true };
        match self.bytes.get(at) {
            None | Some(b',' | b':' | b')' | b']' | b'}') => true,
            Some(_) => self
                .identifier_at(at)
                .is_some_and(|(_, end)| space_end(self.bytes, end).is_ok_and(|end| self.bytes.get(end) == Some(&b':'))),
        }
    }

    /// Reads the raw string that begins here, at its `r`.
    pub fn raw_string(&mut self) -> Option<Node> {
        let start = self.at;
        let first = self.text[start + 1..].bytes().take_while(|byte| *byte == b'#').count() + start + 1;
        let hashes = first - start - 1;
        if self.bytes.get(first) != Some(&b'"') {
            let error = self.error(UNTERMINATED_STRING, start, first, "a raw string needs a quote after its `#`");
            self.at = first;
            self.report(error);
            return None;
        }
        let ending = format!("\"{}", "#".repeat(hashes));
        let known_missing = hashes >= self.raw_without_end;
        match if known_missing { None } else { self.text[first + 1..].find(&ending) } {
            Some(length) => {
                let content = &self.text[first + 1..first + 1 + length];
                self.at = first + 1 + length + ending.len();
                Some(Node { span: span(start, self.at), value: Value::Text(content.to_owned()) })
            }
            None => {
                self.raw_without_end = self.raw_without_end.min(hashes);
                self.at = self.probable_end(first + 1);
                let error = self.error(UNTERMINATED_STRING, start, self.at, "the raw string is not closed");
                self.report(error.suggest(format!("close it with `{ending}`")));
                None
            }
        }
    }

    /// The text between two offsets with its escapes resolved; wrong ones are reported and left out.
    fn unescape(&mut self, start: usize, end: usize) -> String {
        let mut text = String::with_capacity(end - start);
        let mut at = start;
        while at < end {
            if self.bytes[at] != b'\\' {
                let plain = &self.text[at..end];
                let plain = &plain[..plain.find('\\').unwrap_or(plain.len())];
                text.push_str(plain);
                at += plain.len();
            } else if let Some(next) = self.continuation_end(at, end) {
                at = next;
            } else {
                let (character, next) = self.escape(at, end, true);
                text.extend(character);
                at = next;
            }
        }
        text
    }

    /// A backslash before a line break swallows the space up to the next word.
    fn continuation_end(&self, at: usize, end: usize) -> Option<usize> {
        let rest = &self.text[at + 1..end];
        (rest.starts_with('\n') || rest.starts_with("\r\n"))
            .then(|| end - rest.trim_start_matches([' ', '\t', '\n', '\r']).len())
    }

    /// Reads the escape whose backslash is at an offset; gives its character and its end.
    fn escape(&mut self, at: usize, end: usize, in_string: bool) -> (Option<char>, usize) {
        let rest = &self.text[at + 1..end];
        let kind = rest.chars().next();
        let simple = match kind {
            Some(c @ ('\'' | '"' | '\\')) => Some(c),
            Some('n') => Some('\n'),
            Some('r') => Some('\r'),
            Some('t') => Some('\t'),
            Some('0') => Some('\0'),
            _ => None,
        };
        let (read, length) = match kind {
            _ if simple.is_some() => (simple, 1),
            Some('x') => bytes_escape(rest, in_string),
            Some('u') => unicode_escape(rest),
            other => (None, other.map_or(0, char::len_utf8)),
        };
        let next = at + 1 + length;
        if read.is_none() {
            let why = match kind {
                Some('x') => "`\\x` needs two hexadecimal digits that make a character",
                Some('u') => "`\\u` needs 1 to 6 hexadecimal digits of a character in braces: `\\u{263a}`",
                _ => "unknown escape sequence",
            };
            let error = self.error(BAD_ESCAPE, at, next, why);
            self.report(match kind {
                Some('x' | 'u') => error,
                _ => error.suggest("write `\\\\` for a backslash, or a raw string `r\"…\"`; paths may use `/`"),
            });
        }
        (read, next)
    }

    /// Reads the character literal whose opening apostrophe is next.
    pub fn character(&mut self) -> Option<Node> {
        let start = self.at;
        let line = self.bytes[start..].iter().position(|byte| *byte == b'\n').unwrap_or(self.bytes.len() - start);
        let errors = self.errors;
        let (character, end) = match self.text[start + 1..].chars().next() {
            Some('\\') => self.escape(start + 1, self.bytes.len().min(start + line.max(2)), false),
            Some(character) => (Some(character), start + 1 + character.len_utf8()),
            None => (None, start + 1),
        };
        if self.errors == errors && self.bytes.get(end) == Some(&b'\'') {
            self.at = end + 1;
            return character.map(|value| Node { span: span(start, self.at), value: Value::Char(value) });
        }
        // Up to the next apostrophe of the line, or this apostrophe alone.
        let close = self.bytes[start + 1..start + line.max(1)].iter().position(|byte| *byte == b'\'');
        self.at = close.map_or(start + 1, |close| start + close + 2);
        if self.errors == errors {
            let error = self.error(BAD_CHARACTER, start, self.at, "`'…'` holds exactly one character");
            self.report(if close.is_some() { error.suggest("write strings in `\"…\"`") } else { error });
        }
        None
    }
}

/// Reads `x41`, or in a string `xe2\x82\xac`: the bytes of one character in UTF-8. The length is what was read.
fn bytes_escape(rest: &str, in_string: bool) -> (Option<char>, usize) {
    let mut bytes = [0; 4];
    let mut length = 0;
    for count in 0..if in_string { 4 } else { 1 } {
        let Some(two) = rest[length..].strip_prefix(if count == 0 { "x" } else { "\\x" }) else { break };
        let digits = two.bytes().take(2).take_while(u8::is_ascii_hexdigit).count();
        if digits < 2 {
            return (None, length.max(1));
        }
        let Ok(byte) = u8::from_str_radix(&two[..2], 16) else { break };
        bytes[count] = byte;
        length = rest.len() - two.len() + 2;
        if let Ok(text) = std::str::from_utf8(&bytes[..=count]) {
            return (text.chars().next(), length);
        }
    }
    (None, length.max(1))
}

/// Reads `u{263a}`.
fn unicode_escape(rest: &str) -> (Option<char>, usize) {
    let digits = rest[1..].strip_prefix('{').map_or("", |rest| {
        let end = rest.bytes().take_while(u8::is_ascii_hexdigit).count();
        &rest[..end]
    });
    let closed = rest[1..].len() > digits.len() + 1 && rest.as_bytes()[digits.len() + 2] == b'}';
    if !(1..=6).contains(&digits.len()) || !closed {
        return (None, 1);
    }
    let character = u32::from_str_radix(digits, 16).ok().and_then(char::from_u32);
    (character, digits.len() + 3)
}
