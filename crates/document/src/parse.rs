//! The reader: from text to a tree. It reports every syntax error that it can tell apart.
//!
//! It accepts what the `ron` crate (0.12) accepts with implicit `Some`, with these differences:
//! * keys and fields that appear twice are reported (in ron the last one wins, or the error comes late);
//! * byte strings, byte literals and ranges are refused: nothing in our files has their type;
//! * of the extensions only `implicit_some` is accepted: the others would change what parentheses mean;
//! * a byte order mark is skipped (ron refuses it);
//! * `Name()` and `( )` are a name and a unit (ron's `Value` distinguishes `( )` from `()`).

use std::sync::Arc;

use crate::reader::{Reader, is_word, span};
use crate::{
    BAD_ATTRIBUTE, BAD_NUMBER, Diagnostic, Diagnostics, MISPLACED_ENTRY, MISSING_VALUE, Node, Number, Place, Source,
    TRAILING_TEXT, UNEXPECTED_CHARACTER, UNREADABLE_FILE, UNSUPPORTED_SYNTAX, Value, number,
};

/// Brackets may be nested this deep; so in the `ron` crate, which counts some of them twice.
pub const MAX_DEPTH: usize = 128;

/// Reads a document. Every syntax error that can be told apart is reported, in the order of the text.
///
/// Returns `None` after a syntax error, because what is missing from the tree would be reported a second time.
/// Names that appear twice are reported, but leave the tree whole.
pub fn parse(source: &Arc<Source>, out: &mut Diagnostics) -> Option<Node> {
    if u32::try_from(source.text().len()).is_err() {
        let message = "texts of 4 GiB or more are not supported";
        out.push(Diagnostic::error(UNREADABLE_FILE, Place::File(source.name().to_owned()), message));
        return None;
    }
    let mut reader = Reader::new(source);
    let node = reader.document();
    let errors = reader.errors;
    let mut found: Diagnostics = reader.out.into_iter().collect();
    found.sort();
    out.extend(found);
    node.filter(|_| errors == 0)
}

/// Reads a value of the command line. Like [`parse`], but mistakes name the argument (the source's name), whether the
/// source was made as an argument or not.
pub fn parse_value(source: &Arc<Source>, out: &mut Diagnostics) -> Option<Node> {
    let first = out.len();
    let node = parse(source, out);
    for diagnostic in &mut out.as_mut_slice()[first..] {
        diagnostic.place = Place::Argument(source.name().to_owned());
        // All parts of an argument are one place.
        diagnostic.related.clear();
    }
    node
}

impl Reader<'_> {
    fn document(&mut self) -> Option<Node> {
        self.skip_space();
        while self.byte() == Some(b'#') {
            self.attribute();
            self.skip_space();
        }
        while matches!(self.byte(), Some(b')' | b']' | b'}')) {
            self.report_unopened();
            self.skip_space();
        }
        let node = self.value()?;
        self.report_suspect_held();
        self.skip_space();
        while !self.brackets_broken && matches!(self.byte(), Some(b')' | b']' | b'}')) {
            self.report_unopened();
            self.skip_space();
        }
        if self.at < self.bytes.len() && !self.brackets_broken {
            let message = format!("the document ends before {}", self.token(self.at));
            let error = self.error(TRAILING_TEXT, self.at, self.token_end(self.at), message);
            self.report(error.suggest("a file holds one value"));
        }
        Some(node)
    }

    /// Reads `#![…]`.
    fn attribute(&mut self) {
        let start = self.at;
        let line = self.bytes[start..].iter().position(|byte| matches!(byte, b'\n' | b']'));
        let end = line.map_or(self.last(), |length| start + length + 1);
        let words: String = self.text[start..end].split_whitespace().collect();
        self.at = end;
        let inner = words.strip_prefix("#![").and_then(|rest| rest.strip_suffix(']'));
        let names = inner.and_then(|inner| inner.strip_prefix("enable(")?.strip_suffix(')'));
        let end = start + self.text[start..end].trim_end().len();
        match (names, inner) {
            (Some(names), _) => {
                let names = names.strip_suffix(',').unwrap_or(names);
                if let Some(other) = names.split(',').find(|name| *name != "implicit_some") {
                    let message = format!("the extension `{}` is not supported", crate::node::shortened(other));
                    let error = self.error(UNSUPPORTED_SYNTAX, start, end, message);
                    self.report(error.suggest("leave it out; `implicit_some` is always on"));
                }
            }
            (None, Some(inner)) if is_note(inner) => {}
            _ => {
                let error = self.error(BAD_ATTRIBUTE, start, end, "this `#…` line is not supported");
                self.report(error.suggest("write `#![enable(implicit_some)]` or leave it out"));
            }
        }
    }

    /// Reads a value; space before it was skipped.
    pub fn value(&mut self) -> Option<Node> {
        let start = self.at;
        let Some(byte) = self.byte() else {
            let last = self.last();
            let error = self.error(MISSING_VALUE, last, last, "the text ends where a value belongs");
            self.report(error);
            return None;
        };
        match byte {
            b'(' => self.parentheses(),
            b'[' => self.list(),
            b'{' => self.map(),
            b'"' => Some(self.string()),
            b'\'' => self.character(),
            b'0'..=b'9' | b'+' | b'-' | b'.' => self.number(),
            b'r' if self.ahead(1) == Some(b'"') => self.raw_string(),
            b'r' if self.ahead(1) == Some(b'#') && matches!(self.ahead(2), Some(b'"' | b'#')) => self.raw_string(),
            b'b' if matches!(self.ahead(1), Some(b'"' | b'\'')) => self.refuse_bytes(),
            b'b' if self.ahead(1) == Some(b'r') && matches!(self.ahead(2), Some(b'"' | b'#')) => self.refuse_bytes(),
            b',' | b':' | b')' | b']' | b'}' => {
                let message = format!("a value is missing before {}", self.token(start));
                let error = self.error(MISSING_VALUE, start, start + 1, message);
                self.report(error);
                None
            }
            b'$' => self.refuse_word(start),
            _ => match self.identifier_at(start) {
                Some((name, end)) => self.named(name, end),
                None => {
                    let message = format!("{} cannot begin a value", self.token(start));
                    let error = self.error(UNEXPECTED_CHARACTER, start, self.token_end(start), message);
                    self.at = self.token_end(start);
                    self.report(error);
                    None
                }
            },
        }
    }

    fn number(&mut self) -> Option<Node> {
        let start = self.at;
        let end = self.number_end();
        let token = &self.text[start..end];
        self.at = end;
        if token.contains("..") {
            let error = self.error(UNSUPPORTED_SYNTAX, start, end, "ranges are not supported");
            self.report(error.suggest("write a tuple of two numbers"));
            return None;
        }
        match number::read(token) {
            Ok(number) => Some(Node { span: span(start, end), value: Value::Number(number) }),
            Err(why) => {
                let message = format!("`{}` is not a number: {why}", crate::node::shortened(token));
                let error = self.error(BAD_NUMBER, start, end, message);
                self.report(error);
                None
            }
        }
    }

    /// The end of the number that begins here, whatever is wrong with it.
    fn number_end(&self) -> usize {
        let mut end = self.at;
        if matches!(self.byte(), Some(b'+' | b'-')) {
            end += 1;
        }
        let hexadecimal = self.bytes[end..].starts_with(b"0x");
        loop {
            end = self.run_end(end, |c| c == '.' || (!c.is_ascii() && unicode_ident::is_xid_continue(c)));
            let exponent = !hexadecimal && end > self.at && matches!(self.bytes[end - 1], b'e' | b'E');
            let signed_exponent = exponent && matches!(self.bytes.get(end), Some(b'+' | b'-'));
            if !signed_exponent {
                return end;
            }
            end += 1;
        }
    }

    /// Reads what begins with a name that ends at `end`.
    fn named(&mut self, name: &str, end: usize) -> Option<Node> {
        let start = self.at;
        let raw = self.bytes[start..end].len() != name.len();
        if matches!(self.bytes.get(end), Some(b'.' | b'+' | b'-' | b'$')) {
            return self.refuse_word(start);
        }
        self.at = end;
        let name_span = span(start, end);
        let plain = |value| Some(Node { span: name_span, value });
        match name {
            _ if raw => {}
            "true" => return plain(Value::Bool(true)),
            "false" => return plain(Value::Bool(false)),
            "None" => return plain(Value::Variant { name: name.to_owned(), name_span, content: None }),
            "Some" => return self.some(start),
            _ => {
                if let Some(value) = number::read_literal(name) {
                    return plain(Value::Number(Number { value, integer: None }));
                }
            }
        }
        self.skip_space();
        if self.byte() != Some(b'(') {
            self.at = end;
            return plain(Value::Variant { name: name.to_owned(), name_span, content: None });
        }
        let content = Some(Box::new(self.parentheses()?));
        let span = span(start, self.at);
        Some(Node { span, value: Value::Variant { name: name.to_owned(), name_span, content } })
    }

    /// Reads `(x)` after `Some`.
    fn some(&mut self, start: usize) -> Option<Node> {
        let end = self.at;
        self.skip_space();
        if self.byte() != Some(b'(') {
            self.at = end;
            let error = self.error(MISSING_VALUE, start, end, "`Some` needs a value in parentheses");
            self.report(error.suggest("write the value alone: `Some` is implied"));
            return None;
        }
        let errors = self.errors;
        let content = self.parentheses()?;
        match content.value {
            Value::Tuple(mut items) if items.len() == 1 => items.pop(),
            _ if self.errors > errors => None,
            Value::Unit => {
                let error = self.error(MISSING_VALUE, start, self.at, "`Some()` is empty");
                self.report(error);
                None
            }
            _ => {
                let error = self.error(MISPLACED_ENTRY, start, self.at, "`Some(…)` holds exactly one value");
                self.report(error.suggest("write a struct or a tuple alone: `Some` is implied"));
                None
            }
        }
    }

    /// Reports a word like `surfaces.depth` or `$exposure` that should be a string.
    fn refuse_word(&mut self, start: usize) -> Option<Node> {
        let end = self.run_end(start, is_word);
        let word = &self.text[start..end];
        let message = format!("`{}` is neither a name nor a string", crate::node::shortened(word));
        let error = self.error(UNEXPECTED_CHARACTER, start, end, message);
        self.at = end;
        self.report(error.suggest(format!("write it in quotes: \"{}\"", crate::node::shortened(word))));
        None
    }

    /// Reports `b"…"`, `br"…"` or `b'…'`, and moves past it.
    fn refuse_bytes(&mut self) -> Option<Node> {
        let start = self.at;
        let errors = self.errors;
        self.at += 1;
        match self.byte() {
            Some(b'"') => drop(self.string()),
            Some(b'\'') => drop(self.character()),
            _ => drop(self.raw_string()),
        }
        if self.errors == errors {
            let error = self.error(UNSUPPORTED_SYNTAX, start, self.at, "byte strings are not supported");
            self.report(error.suggest("write a string `\"…\"`, or numbers in a list"));
        }
        None
    }
}

/// `type="…"` or `schema="…"`, which ron skips.
fn is_note(inner: &str) -> bool {
    ["type=\"", "schema=\""].into_iter().any(|prefix| {
        inner
            .strip_prefix(prefix)
            .is_some_and(|rest| rest.len() > 1 && rest.ends_with('"') && rest.matches('"').count() == 1)
    })
}
