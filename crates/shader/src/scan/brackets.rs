//! Checks that the brackets of a file are closed in it, and that no expression is too deep.
//!
//! naga reads an expression by recursion, one step for each operator, and runs out of stack where there are some
//! thousand of them (a 2 MiB stack: between 3,000 and 5,000). So their number is bounded here.

use std::sync::Arc;

use tyndall_document::{Diagnostic, Source, Span};

use crate::codes;

/// The deepest expression allowed, in operators, from its root to any leaf.
const DEEPEST: u32 = 1_000;

/// The brackets that are open; only the first mistake is reported.
#[derive(Default)]
pub struct Brackets {
    open: Vec<(u8, Span)>,
    /// The depth of the expression that is being read: outside all brackets, and in each open one.
    outside: Depth,
    inside: Vec<Depth>,
    failed: bool,
}

/// Bounds of the depth of an expression in one pair of brackets.
#[derive(Default, Clone, Copy)]
struct Depth {
    /// Operators and brackets since the last `,` or `;`.
    operators: u32,
    /// The deepest expression in brackets since then.
    inner: u32,
    /// The deepest before, since the last `;`.
    before: u32,
}

impl Depth {
    fn total(self) -> u32 {
        self.operators.saturating_add(self.inner).max(self.before)
    }
}

impl Brackets {
    /// How many are open.
    pub fn depth(&self) -> usize {
        self.open.len()
    }

    /// Takes a mark; returns the mistake where it closes what is not open, or makes an expression too deep.
    pub fn mark(&mut self, source: &Arc<Source>, mark: u8, span: Span) -> Option<Diagnostic> {
        self.deepen(mark);
        if self.inside.last().unwrap_or(&self.outside).total() > DEEPEST && !self.failed {
            self.failed = true;
            let message = format!("the operators of this expression are nested more than {DEEPEST} deep");
            return Some(Diagnostic::error(codes::SYNTAX, source.place(span), message).suggest("compute it in parts"));
        }
        let opening = match mark {
            b'{' | b'(' | b'[' => {
                self.open.push((mark, span));
                return None;
            }
            b'}' => b'{',
            b')' => b'(',
            b']' => b'[',
            _ => return None,
        };
        let open = self.open.pop();
        if self.failed || open.is_some_and(|(open, _)| open == opening) {
            return None;
        }
        self.failed = true;
        let place = |span| source.place(span);
        let closing = char::from(mark);
        Some(match open {
            None => Diagnostic::error(codes::SYNTAX, place(span), format!("`{closing}` has no opening bracket")),
            Some((open, open_span)) => {
                let open = char::from(open);
                let message = format!("`{closing}` does not close `{open}`");
                Diagnostic::error(codes::SYNTAX, place(span), message)
                    .relate(place(open_span), format!("`{open}` is opened here"))
            }
        })
    }

    /// Follows the depth of expressions.
    fn deepen(&mut self, mark: u8) {
        let here = self.inside.last_mut().unwrap_or(&mut self.outside);
        match mark {
            b';' | b'{' | b'}' => *here = Depth::default(),
            b',' => *here = Depth { operators: 0, inner: 0, before: here.total() },
            b')' | b']' => {}
            _ => here.operators = here.operators.saturating_add(1),
        }
        match mark {
            b'{' | b'(' | b'[' => self.inside.push(Depth::default()),
            b'}' => drop(self.inside.pop()),
            b')' | b']' => {
                let closed = self.inside.pop().unwrap_or_default();
                let here = self.inside.last_mut().unwrap_or(&mut self.outside);
                here.inner = here.inner.max(closed.total());
            }
            _ => {}
        }
    }

    /// At the end of the file: returns the mistake where a bracket is still open.
    pub fn end(self, source: &Arc<Source>) -> Option<Diagnostic> {
        let (open, span) = self.open.into_iter().next_back().filter(|_| !self.failed)?;
        let place = source.place(span);
        Some(Diagnostic::error(codes::SYNTAX, place, format!("`{}` is not closed", char::from(open))))
    }
}
