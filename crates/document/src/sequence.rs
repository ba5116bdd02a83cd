//! Items between brackets, separated by commas, and how reading goes on after a mistake.

use crate::reader::{Held, Open, Reader};
use crate::{
    Diagnostic, MAX_DEPTH, MISPLACED_ENTRY, MISSING_COMMA, MISSING_VALUE, Span, TOO_DEEP, UNEXPECTED_CHARACTER,
};

impl Reader<'_> {
    /// Notes an item that does not suit its bracket. It is reported once the bracket turns out to be closed.
    pub fn hold(&mut self, item: usize, place: Span, message: impl Into<String>, suggestion: Option<&str>) {
        let mut diagnostic = Diagnostic::error(MISPLACED_ENTRY, self.source.place(place), message);
        diagnostic.suggestion = suggestion.map(str::to_owned);
        self.errors += 1;
        self.held.push(Held { diagnostic, item });
    }

    /// Reads the opening bracket, items with commas between them, and the closing bracket. `item` returns `None`
    /// where it reported a mistake and has lost its position.
    pub fn sequence(&mut self, close: u8, item: &mut dyn FnMut(&mut Self) -> Option<()>) -> Option<()> {
        let start = self.at;
        if self.open.len() >= MAX_DEPTH {
            let message = format!("brackets are nested more than {MAX_DEPTH} deep");
            let error = self.error(TOO_DEEP, start, start + 1, message);
            self.brackets_broken = true;
            self.skip_brackets();
            self.report(error);
            return None;
        }
        self.at += 1;
        self.open.push(Open { at: start, close });
        let held = self.held.len();
        while self.goes_on(held) {
            let item_start = self.at;
            if item(self).is_none() {
                self.recover();
                self.skip_space();
                if self.byte() == Some(b',') {
                    self.at += 1;
                }
            } else {
                self.comma(item_start);
            }
        }
        self.open.pop();
        Some(())
    }

    /// Whether another item follows. Reads the closing bracket where none does, and what should not be there.
    fn goes_on(&mut self, held: usize) -> bool {
        loop {
            self.skip_space();
            let Some(Open { at: opened, close }) = self.open.last().map(|open| Open { ..*open }) else { return false };
            match self.byte() {
                None => {
                    self.report_end_within(opened, held);
                    return false;
                }
                Some(byte) if byte == close => {
                    let suspect = self.note_suspect(opened);
                    self.at += 1;
                    let held: Vec<_> = self.held.drain(held..).collect();
                    if suspect {
                        self.suspect_held = held;
                    } else {
                        held.into_iter().for_each(|held| self.report_held(held));
                    }
                    return false;
                }
                Some(byte @ (b')' | b']' | b'}')) => {
                    if self.open.iter().any(|open| open.close == byte) {
                        self.report_unclosed(opened, held);
                        return false;
                    }
                    if self.report_wrong_closing(opened, close) {
                        self.held.drain(held..).collect::<Vec<_>>().into_iter().for_each(|held| self.report_held(held));
                        return false;
                    }
                }
                Some(b',') => {
                    let error = self.error(MISSING_VALUE, self.at, self.at + 1, "there is nothing before this comma");
                    self.at += 1;
                    self.report(error);
                }
                Some(_) => return true,
            }
        }
    }

    /// Reads the comma after an item, or reports what is there instead.
    fn comma(&mut self, item: usize) {
        let end = self.at;
        self.skip_space();
        let here = self.at;
        match self.byte() {
            Some(b',') => self.at += 1,
            None | Some(b')' | b']' | b'}') => {}
            Some(byte) if self.begins_value(byte) && (here > end || !matches!(byte, b'.' | b'+' | b'-')) => {
                let error = self.missing_comma(item, end, here);
                self.errors += 1;
                self.held.push(Held { diagnostic: error, item: here });
            }
            Some(b';') => {
                let error = self.error(UNEXPECTED_CHARACTER, here, here + 1, "expected a comma, found `;`");
                self.at += 1;
                self.report(error.suggest("write `,`"));
            }
            Some(_) => {
                let message = format!("expected a comma or the closing bracket, found {}", self.token(here));
                let error = self.error(UNEXPECTED_CHARACTER, here, self.token_end(here), message);
                self.report(error);
                self.recover();
                if self.byte() == Some(b',') {
                    self.at += 1;
                }
            }
        }
    }

    /// The place is where the comma belongs: at what follows in the same line, else at the end of the item before.
    fn missing_comma(&self, item: usize, end: usize, here: usize) -> Diagnostic {
        let message = format!("a comma is missing before {}", self.token(here));
        if self.bytes[end..here].contains(&b'\n') {
            let last = self.text[item..end].char_indices().next_back().map_or(item, |(at, _)| item + at);
            let next = self.place(here, self.token_end(here));
            let error = self.error(MISSING_COMMA, last, end, message);
            return error.relate(next, "the next item").suggest("put `,` at the end of the item");
        }
        self.error(MISSING_COMMA, here, self.token_end(here), message)
    }

    /// Whether a value may begin with this byte.
    pub fn begins_value(&self, byte: u8) -> bool {
        match byte {
            b'(' | b'[' | b'{' | b'"' | b'\'' | b'+' | b'-' | b'.' | b'$' | b'0'..=b'9' => true,
            _ => self.identifier_at(self.at).is_some() || matches!(byte, b'r' | b'b'),
        }
    }

    /// Moves past the bracket that closes the next one, whatever is between them.
    fn skip_brackets(&mut self) {
        self.at += 1;
        self.skip_to(false, 1);
    }

    /// Moves to the comma or closing bracket that ends the item here.
    pub fn recover(&mut self) {
        self.skip_to(true, 0);
    }

    /// Moves over tokens: to the end of an item, or past the bracket that leaves no bracket open.
    fn skip_to(&mut self, stop_at_item_end: bool, mut open: usize) {
        while self.at < self.bytes.len() {
            self.skip_space();
            match self.byte() {
                None => return,
                Some(b'"') => self.skip_string(),
                Some(b'\'') => self.at += self.quoted_character_length(),
                Some(b'(' | b'[' | b'{') => {
                    open += 1;
                    self.at += 1;
                }
                Some(b')' | b']' | b'}') => {
                    if open == 0 {
                        return;
                    }
                    open -= 1;
                    self.at += 1;
                    if open == 0 && !stop_at_item_end {
                        return;
                    }
                }
                Some(b',') if open == 0 && stop_at_item_end => return,
                Some(_) => self.at = self.token_end(self.at).max(self.at + 1),
            }
        }
    }

    /// Length of a character literal that may hold a bracket or a quote, else of the apostrophe alone.
    fn quoted_character_length(&self) -> usize {
        match self.bytes[self.at..] {
            [_, b'\\', _, b'\'', ..] => 4,
            [_, byte, b'\'', ..] if byte.is_ascii() => 3,
            _ => 1,
        }
    }
}
