//! Words, marks and attributes of WGSL, without its comments and blanks.

use tyndall_document::Span;

/// A piece of WGSL text.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Token<'t> {
    /// Letters, digits and `_`; numbers too.
    Word(&'t str),
    /// `@name`, without the brackets after it.
    Attribute(&'t str),
    /// `#`.
    Hash,
    /// A byte of ASCII punctuation.
    Mark(u8),
    /// A block comment that runs to the end of the text; the span is that of its `/*`.
    OpenComment,
}

/// Cuts a text into [`Token`]s. Positions are byte offsets and always fall between characters.
pub struct Lexer<'t> {
    text: &'t str,
    at: usize,
}

/// WGSL's line breaks.
pub fn is_line_break(c: char) -> bool {
    matches!(c, '\n' | '\r' | '\u{b}' | '\u{c}' | '\u{85}' | '\u{2028}' | '\u{2029}')
}

/// WGSL's blanks, line breaks included.
pub fn is_blank(c: char) -> bool {
    is_line_break(c) || matches!(c, ' ' | '\t' | '\u{200e}' | '\u{200f}')
}

fn is_word(c: char) -> bool {
    c.is_alphanumeric() || c == '_'
}

impl<'t> Lexer<'t> {
    pub fn new(text: &'t str) -> Self {
        Self { text, at: 0 }
    }

    /// The text that has not been read.
    pub fn rest(&self) -> &'t str {
        &self.text[self.at..]
    }

    /// The text from the last line break to here.
    pub fn line_before(&self, offset: u32) -> &'t str {
        let before = &self.text[..offset as usize];
        let start = before.char_indices().rev().find(|(_, c)| is_line_break(*c)).map_or(0, |(i, c)| i + c.len_utf8());
        &before[start..]
    }

    /// Skips `bytes` of the rest, which must end between characters.
    pub fn skip(&mut self, bytes: usize) {
        self.at += bytes;
    }

    fn skip_while(&mut self, keep: impl Fn(char) -> bool) {
        let rest = self.rest();
        self.at += rest.find(|c| !keep(c)).unwrap_or(rest.len());
    }

    /// Skips a block comment, its nested ones included; returns false where it does not end.
    fn skip_block_comment(&mut self) -> bool {
        let bytes = self.text.as_bytes();
        let mut depth = 0_usize;
        while self.at < bytes.len() {
            match &bytes[self.at..] {
                [b'/', b'*', ..] => (depth, self.at) = (depth + 1, self.at + 2),
                [b'*', b'/', ..] => (depth, self.at) = (depth - 1, self.at + 2),
                _ => self.at += 1,
            }
            if depth == 0 {
                return true;
            }
        }
        false
    }

    fn word(&mut self) -> &'t str {
        let start = self.at;
        let number = self.rest().starts_with(|c: char| c.is_ascii_digit());
        self.skip_while(|c| is_word(c) || (number && c == '.'));
        &self.text[start..self.at]
    }
}

impl<'t> Iterator for Lexer<'t> {
    type Item = (Token<'t>, Span);

    fn next(&mut self) -> Option<Self::Item> {
        loop {
            self.skip_while(is_blank);
            let start = self.at;
            let c = self.rest().chars().next()?;
            let token = if self.rest().starts_with("//") {
                self.skip_while(|c| !is_line_break(c));
                continue;
            } else if self.rest().starts_with("/*") {
                if self.skip_block_comment() {
                    continue;
                }
                return Some((Token::OpenComment, Span { start: start as u32, end: start as u32 + 2 }));
            } else if is_word(c) {
                Token::Word(self.word())
            } else {
                self.at += c.len_utf8();
                match c {
                    '#' => Token::Hash,
                    '@' => {
                        self.skip_while(is_blank);
                        Token::Attribute(self.word())
                    }
                    c if c.is_ascii() => Token::Mark(c as u8),
                    _ => continue,
                }
            };
            return Some((token, Span { start: start as u32, end: self.at as u32 }));
        }
    }
}
