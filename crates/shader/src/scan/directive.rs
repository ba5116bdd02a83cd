//! `#import name` and `#import "file.wgsl"`: the only directive there is.

use std::sync::Arc;

use tyndall_document::{Diagnostic, Source, Span};

use super::lexer::{Lexer, is_blank, is_line_break};
use super::{Import, Target};
use crate::codes;

/// Reads what stands after a `#`, whose span is given, to the end of the directive.
pub fn read(source: &Arc<Source>, lexer: &mut Lexer<'_>, hash: Span) -> Result<Import, Box<Diagnostic>> {
    let rest = lexer.rest();
    let line = &rest[..rest.find(is_line_break).unwrap_or(rest.len())];
    let wrong = |lexer: &mut Lexer<'_>, end: usize, message: String| {
        let span = Span { start: hash.start, end: hash.end + end as u32 };
        lexer.skip(line.len());
        Box::new(Diagnostic::error(codes::IMPORT, source.place(span), message))
    };
    let stop = line.trim_end().len();
    let word_end = line.find(|c: char| !c.is_alphanumeric() && c != '_').unwrap_or(line.len());
    let word = &line[..word_end];
    if word != "import" {
        return Err(Box::new(
            wrong(lexer, word_end, format!("`#{word}` is not known"))
                .suggest("the only directive is `#import name` or `#import \"file.wgsl\"`"),
        ));
    }
    if !lexer.line_before(hash.start).chars().all(is_blank) {
        return Err(wrong(lexer, stop, "`#import` must stand on a line of its own".to_owned()));
    }
    let name_start = word_end + (line[word_end..].len() - line[word_end..].trim_start().len());
    let Some((target, length)) = target(&line[name_start..]) else {
        return Err(Box::new(
            wrong(lexer, stop.max(word_end), "`#import` needs a module's name or a quoted file".to_owned())
                .suggest("write `#import name` or `#import \"file.wgsl\"`"),
        ));
    };
    let name_end = name_start + length;
    let after = line[name_end..].trim_start();
    if !(after.is_empty() || after.starts_with("//") || after.starts_with("/*")) {
        return Err(wrong(lexer, stop, format!("`{}` follows the import", after.trim_end())));
    }
    lexer.skip(name_end);
    let at = |offset: usize| hash.end + offset as u32;
    Ok(Import {
        target,
        span: Span { start: hash.start, end: at(name_end) },
        name_span: Span { start: at(name_start), end: at(name_end) },
    })
}

/// The name or the quoted file that a text begins with, and how many bytes it takes.
fn target(text: &str) -> Option<(Target, usize)> {
    if let Some(quoted) = text.strip_prefix('"') {
        let end = quoted.find('"').filter(|end| *end > 0)?;
        return Some((Target::File(quoted[..end].to_owned()), end + 2));
    }
    let end = text.find(|c: char| !c.is_ascii_alphanumeric() && c != '_').unwrap_or(text.len());
    (end > 0).then(|| (Target::Module(text[..end].to_owned()), end))
}
