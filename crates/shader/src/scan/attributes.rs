//! Attributes that mean something to the linker.

use std::sync::Arc;

use tyndall_document::{Diagnostic, Place, Source, Span};

use super::Scan;
use super::lexer::is_blank;
use crate::codes;

/// Reports `@group`, `@binding` and `@id`; notes the stages. `attributes` are names with the spans of `@name`.
pub fn sort_out(source: &Arc<Source>, attributes: &[(&str, Span)], found: &mut Scan) {
    let mut binding: Option<Span> = None;
    for (name, span) in attributes {
        let whole = with_arguments(source.text(), *span);
        match *name {
            "compute" | "vertex" | "fragment" => found.stages.push(*span),
            "group" | "binding" => {
                binding = Some(match binding.take() {
                    Some(before) if touches(source.text(), before, whole) => Span { start: before.start, ..whole },
                    before => {
                        found.problems.extend(before.map(|span| written_binding(source, span)));
                        whole
                    }
                });
            }
            "id" => found.problems.push(written_id(source, whole)),
            _ => {}
        }
    }
    found.problems.extend(binding.map(|span| written_binding(source, span)));
    found.problems.sort_by_key(|problem| match &problem.place {
        Place::Text { span, .. } => span.start,
        _ => 0,
    });
}

/// The span of `@name(…)`, given that of `@name`. Its arguments are numbers or names: no bracket nests in them.
fn with_arguments(text: &str, span: Span) -> Span {
    let rest = &text[span.end as usize..];
    let blanks = rest.find(|c| !is_blank(c)).unwrap_or(rest.len());
    match rest[blanks..].starts_with('(').then(|| rest.find(')')).flatten() {
        Some(close) => Span { start: span.start, end: span.end + close as u32 + 1 },
        None => span,
    }
}

/// Whether only blanks are between them.
fn touches(text: &str, before: Span, after: Span) -> bool {
    text.get(before.end as usize..after.start as usize).is_some_and(|between| between.chars().all(is_blank))
}

fn written_binding(source: &Arc<Source>, span: Span) -> Diagnostic {
    let place = source.place(span);
    let written = source.slice(span).split_whitespace().collect::<Vec<_>>().join(" ");
    let message = format!("`{written}` is written, but bindings are assigned when the shader is linked");
    Diagnostic::error(codes::BINDING, place, message).suggest("remove it: a variable is found by its name")
}

fn written_id(source: &Arc<Source>, span: Span) -> Diagnostic {
    let place = source.place(span);
    let message = format!("`{}` is written, but a parameter is set by its name", source.slice(span));
    Diagnostic::error(codes::PARAM, place, message).suggest("remove it")
}
