//! What must be known of a WGSL text before naga reads it: its `#import` and `#require` lines, the names that it declares, attributes
//! that the linker reserves for itself, and whether its comments and brackets close.
//!
//! Brackets are checked per file, because files are joined to one text: a `{` that is left open would be reported in
//! another author's file.

mod attributes;
mod brackets;
mod directive;
pub mod lexer;

use std::sync::Arc;

use tyndall_document::{Diagnostic, Source, Span};

use crate::codes;
use brackets::Brackets;
use directive::Directive;
use lexer::{Lexer, Token};

/// What an `#import` line asks for.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Target {
    /// `#import name`: a shared module.
    Module(String),
    /// `#import "file.wgsl"`: a file of the plugin's folder.
    File(String),
}

/// One `#import` line.
#[derive(Debug, Clone)]
pub struct Import {
    pub target: Target,
    /// The whole directive, from its `#`: it is blanked before naga reads the text.
    pub span: Span,
    /// The name alone.
    pub name_span: Span,
}

/// One `#require` line: a declaration that a module uses and leaves to the shader that imports it.
#[derive(Debug, Clone)]
pub struct Requirement {
    pub name: String,
    /// The head of the declaration: `fn name(…) -> …` or `struct Name`.
    pub declaration: String,
    /// The whole directive, from its `#`: it is blanked before naga reads the text.
    pub span: Span,
}

/// What a scan of one file found.
#[derive(Debug, Default)]
pub struct Scan {
    pub imports: Vec<Import>,
    pub requirements: Vec<Requirement>,
    /// Names declared at module scope, with their places.
    pub declared: Vec<(String, Span)>,
    /// Stage attributes (`@compute`, `@vertex`, `@fragment`).
    pub stages: Vec<Span>,
    /// Mistakes, in file order.
    pub problems: Vec<Diagnostic>,
    /// The text would mislead naga: report the problems and stop.
    pub broken: bool,
}

impl Scan {
    /// What naga does not read, in file order.
    pub fn directives(&self) -> Vec<Span> {
        let imports = self.imports.iter().map(|import| import.span);
        let mut spans: Vec<Span> = imports.chain(self.requirements.iter().map(|required| required.span)).collect();
        spans.sort_by_key(|span| span.start);
        spans
    }

    /// The place of a name that the file declares at module scope.
    pub fn place_of(&self, name: &str) -> Option<Span> {
        self.declared.iter().find(|(declared, _)| declared == name).map(|(_, span)| *span)
    }
}

/// Scans one file.
pub fn scan(source: &Arc<Source>) -> Scan {
    let mut found = Scan::default();
    let mut brackets = Brackets::default();
    let mut declaration = Declaration::default();
    let mut attributes = Vec::new();
    let mut lexer = Lexer::new(source.text());
    while let Some((token, span)) = lexer.next() {
        match token {
            Token::OpenComment => {
                let place = source.place(span);
                found.problems.push(Diagnostic::error(codes::SYNTAX, place, "this comment is never closed"));
                found.broken = true;
            }
            Token::Hash => match directive::read(source, &mut lexer, span) {
                Ok(Directive::Import(import)) => found.imports.push(import),
                Ok(Directive::Require(requirement)) => found.requirements.push(requirement),
                Err(problem) => {
                    found.problems.push(*problem);
                    found.broken = true;
                }
            },
            Token::Attribute(name) => attributes.push((name, span)),
            Token::Word(word) => {
                if let Some(name) = declaration.word(word, brackets.depth()) {
                    found.declared.push((name.to_owned(), span));
                }
            }
            Token::Mark(mark) => {
                declaration.mark(mark);
                if let Some(problem) = brackets.mark(source, mark, span) {
                    found.problems.push(problem);
                    found.broken = true;
                }
            }
        }
    }
    if let Some(problem) = brackets.end(source) {
        found.problems.push(problem);
        found.broken = true;
    }
    attributes::sort_out(source, &attributes, &mut found);
    found
}

/// Follows `fn NAME`, `struct NAME`, `var<…> NAME` and their like.
#[derive(Default)]
pub struct Declaration {
    /// A keyword that declares stands before.
    awaited: bool,
    /// Open `<` of a `var<…>`.
    angles: u32,
}

impl Declaration {
    /// Takes a word; gives it back where it is the name of a declaration at module scope.
    pub fn word<'t>(&mut self, word: &'t str, depth: usize) -> Option<&'t str> {
        if depth > 0 || self.angles > 0 {
            return None;
        }
        if self.awaited {
            self.awaited = false;
            return Some(word);
        }
        self.awaited = matches!(word, "fn" | "struct" | "const" | "override" | "alias" | "var");
        None
    }

    /// Takes a mark.
    pub fn mark(&mut self, mark: u8) {
        match mark {
            b'<' if self.awaited => self.angles += 1,
            b'>' => self.angles = self.angles.saturating_sub(1),
            _ => {}
        }
    }
}

#[cfg(test)]
mod tests;
