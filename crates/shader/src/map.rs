//! From offsets in the linked text back to the files that it was made of.

use std::sync::Arc;

use tyndall_document::{Place, Source, Span};

use crate::scan::lexer::{Lexer, Token};

/// Separates two files of the linked text. It cannot continue an unfinished declaration, and it changes nothing; so an
/// error of naga in it concerns the end of the file before.
pub const SEPARATOR: &str = "\nconst_assert true;\n";

/// Where each file of the linked text begins. Each is as long there as on disk.
#[derive(Debug, Clone, Default)]
pub struct Map {
    files: Vec<(u32, Arc<Source>)>,
}

impl Map {
    /// Adds a file that begins at this offset, which is beyond the end of the one before.
    pub fn push(&mut self, start: u32, source: Arc<Source>) {
        self.files.push((start, source));
    }

    /// The files, in the order of the linked text: the root first.
    pub fn sources(&self) -> impl Iterator<Item = &Arc<Source>> {
        self.files.iter().map(|(_, source)| source)
    }

    /// The file and the span in it of a span of the linked text. What lies between two files is the end of the first.
    pub fn locate(&self, span: naga::Span) -> Option<(Arc<Source>, Span)> {
        let range = span.to_range()?;
        let (start, end) = (range.start as u32, range.end as u32);
        let (base, source) = &self.files[self.files.partition_point(|(base, _)| *base <= start).checked_sub(1)?];
        let length = source.text().len() as u32;
        if start - base >= length {
            return Some((Arc::clone(source), last_character(source.text())));
        }
        let span = Span { start: start - base, end: end.max(start).saturating_sub(*base).min(length) };
        Some((Arc::clone(source), span))
    }

    /// Like [`Map::locate`], as a place for a diagnostic; the whole root where the span is undefined.
    pub fn place(&self, span: naga::Span) -> Place {
        match self.locate(span) {
            Some((source, span)) => source.place(span),
            None => Place::File(self.files.first().map(|(_, root)| root.name().to_owned()).unwrap_or_default()),
        }
    }

    /// The place of a name in a declaration, whose span is given: of the variable, or of a struct's member.
    pub fn place_of_name(&self, span: naga::Span, name: &str) -> Place {
        let Some((source, whole)) = self.locate(span) else { return self.place(span) };
        let mut tokens = Lexer::new(source.slice(whole)).peekable();
        let mut first = None;
        while let Some((token, found)) = tokens.next() {
            if token == Token::Word(name) {
                let typed = matches!(tokens.peek(), Some((Token::Mark(b':'), _)));
                first = if typed { Some(found) } else { first.or(Some(found)) };
                if typed {
                    break;
                }
            }
        }
        source.place(first.map_or(whole, |found| Span::new(whole.start + found.start, whole.start + found.end)))
    }

    /// Whether the span lies between two files, or after the last one.
    pub fn is_between(&self, span: naga::Span) -> bool {
        let Some(range) = span.to_range() else { return false };
        let before = self.files.partition_point(|(base, _)| *base as usize <= range.start);
        let Some((base, source)) = before.checked_sub(1).map(|index| &self.files[index]) else { return false };
        range.start - *base as usize >= source.text().len()
    }
}

/// The last character that is not blank.
fn last_character(text: &str) -> Span {
    let end = text.trim_end().len();
    let start = text[..end].char_indices().next_back().map_or(0, |(start, _)| start);
    Span { start: start as u32, end: end as u32 }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn offsets_go_back_to_their_files() {
        let (first, second) = (Source::new("a", "const é = 1 \n"), Source::new("b", "fn f() {}"));
        let mut map = Map::default();
        map.push(0, Arc::clone(&first));
        map.push(33, Arc::clone(&second));
        let at =
            |start, end| map.locate(naga::Span::new(start, end)).map(|(source, span)| (source.name().to_owned(), span));
        assert_eq!(at(6, 8), Some(("a".to_owned(), Span { start: 6, end: 8 })));
        assert_eq!(at(36, 37), Some(("b".to_owned(), Span { start: 3, end: 4 })));
        assert_eq!(at(15, 20), Some(("a".to_owned(), Span { start: 11, end: 12 })), "the 1 before the separator");
        assert_eq!(at(40, 90).unwrap().1.end, 9, "a span never leaves its file");
        assert!(map.is_between(naga::Span::new(15, 20)) && !map.is_between(naga::Span::new(36, 37)));
        assert!(map.locate(naga::Span::UNDEFINED).is_none());
    }
}
