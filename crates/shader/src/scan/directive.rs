//! The directives: `#import name`, `#import "file.wgsl"` and `#require fn name(…) -> …`, each on a line of its own.

use std::sync::Arc;

use tyndall_document::{Diagnostic, Source, Span};

use super::lexer::{Lexer, is_blank, is_line_break};
use super::{Import, Requirement, Target};
use crate::codes;

/// What a line that begins with `#` says.
pub enum Directive {
    Import(Import),
    Require(Requirement),
}

/// Reads what stands after a `#`, whose span is given, to the end of the directive.
pub fn read(source: &Arc<Source>, lexer: &mut Lexer<'_>, hash: Span) -> Result<Directive, Box<Diagnostic>> {
    let rest = lexer.rest();
    let text = &rest[..rest.find(is_line_break).unwrap_or(rest.len())];
    let keyword = text.find(|c: char| !c.is_alphanumeric() && c != '_').unwrap_or(text.len());
    let line = Line { source, hash, text, keyword };
    let read = match &text[..keyword] {
        "import" | "require" if !lexer.line_before(hash.start).chars().all(is_blank) => {
            let message = format!("`#{}` must stand on a line of its own", &text[..keyword]);
            Err(Box::new(line.wrong(line.stop(), message)))
        }
        "import" => line.import(),
        "require" => line.require(),
        word => {
            let problem = line.wrong(keyword, format!("`#{word}` is not known"));
            Err(Box::new(
                problem.suggest("the directives are `#import name`, `#import \"file.wgsl\"` and `#require fn …`"),
            ))
        }
    };
    lexer.skip(read.as_ref().map_or(text.len(), |(_, end)| *end));
    read.map(|(directive, _)| directive)
}

/// A directive, and where in its line it ends.
type Read = Result<(Directive, usize), Box<Diagnostic>>;

/// The line of a directive behind its `#`; offsets are in that text.
struct Line<'t> {
    source: &'t Arc<Source>,
    hash: Span,
    text: &'t str,
    /// Where `import` or `require` ends.
    keyword: usize,
}

impl Line<'_> {
    fn import(&self) -> Read {
        let start = self.argument();
        let Some((target, length)) = target(&self.text[start..]) else {
            let problem = self.wrong(self.stop(), "`#import` needs a module's name or a quoted file".to_owned());
            return Err(Box::new(problem.suggest("write `#import name` or `#import \"file.wgsl\"`")));
        };
        let end = start + length;
        let after = self.text[end..].trim_start();
        if !(after.is_empty() || after.starts_with("//") || after.starts_with("/*")) {
            let message = format!("`{}` follows the import", after.trim_end());
            return Err(Box::new(self.wrong(self.stop(), message)));
        }
        let import =
            Import { target, span: self.span(end), name_span: Span { start: self.at(start), end: self.at(end) } };
        Ok((Directive::Import(import), end))
    }

    fn require(&self) -> Read {
        let start = self.argument();
        let comment = self.text.find("//").into_iter().chain(self.text.find("/*")).min();
        let declaration = self.text[start..comment.unwrap_or(self.text.len()).max(start)].trim_end();
        let Some(name) = declared_name(declaration) else {
            let problem = self.wrong(self.stop(), "`#require` needs the head of a declaration".to_owned());
            return Err(Box::new(problem.suggest("write `#require fn name(…) -> …` or `#require struct Name`")));
        };
        let end = start + declaration.len();
        let requirement =
            Requirement { name: name.to_owned(), declaration: declaration.to_owned(), span: self.span(end) };
        Ok((Directive::Require(requirement), end))
    }

    /// Where the word behind the keyword begins.
    fn argument(&self) -> usize {
        self.text.len() - self.text[self.keyword..].trim_start().len()
    }

    /// The end of what is written.
    fn stop(&self) -> usize {
        self.text.trim_end().len()
    }

    fn at(&self, offset: usize) -> u32 {
        self.hash.end + offset as u32
    }

    /// From the `#` to here.
    fn span(&self, end: usize) -> Span {
        Span { start: self.hash.start, end: self.at(end) }
    }

    fn wrong(&self, end: usize, message: String) -> Diagnostic {
        Diagnostic::error(codes::IMPORT, self.source.place(self.span(end)), message)
    }
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

/// The name in `fn name(…) -> …` or `struct Name`.
fn declared_name(declaration: &str) -> Option<&str> {
    let (keyword, rest) = declaration.split_once(is_blank)?;
    let rest = rest.trim_start();
    let end = rest.find(|c: char| !c.is_alphanumeric() && c != '_').unwrap_or(rest.len());
    let complete = match keyword {
        "fn" => rest[end..].starts_with('('),
        "struct" => end == rest.len(),
        _ => false,
    };
    (end > 0 && complete).then(|| &rest[..end])
}
