//! Diagnostics as text, for people at a terminal.

use annotate_snippets::renderer::Renderer;
use annotate_snippets::{Annotation, AnnotationKind, Element, Group, Level, Origin, Snippet, normalize_untrusted_str};

use crate::{Diagnostic, Place, Severity, Source, Span};

/// Two places of a source are shown in one piece of it if at most this many lines lie between them.
const NEAR_LINES: usize = 4;
/// Of a place that covers more lines, only the first line is shown.
const MOST_LINES: usize = 8;
/// Of a longer line, in bytes, only the surroundings of the place are shown.
const LONG_LINE: u32 = 240;

/// Each diagnostic as a headline with its code, `file:line:column`, the lines concerned with carets under the places
/// (the related ones too), and the suggestion; each is followed by an empty line. `color` adds terminal escapes.
pub fn render_text<'a>(diagnostics: impl IntoIterator<Item = &'a Diagnostic>, color: bool) -> String {
    let renderer = if color { Renderer::styled() } else { Renderer::plain() };
    let mut text = String::new();
    for diagnostic in diagnostics {
        for line in renderer.render(&[report(diagnostic)]).lines().filter(|line| !is_empty_origin(line)) {
            text.push_str(line);
            text.push('\n');
        }
        text.push('\n');
    }
    text
}

/// The line `:::` above a piece of a source that has an [`Origin`] of its own, perhaps coloured.
fn is_empty_origin(line: &str) -> bool {
    let Some(at) = line.find(":::") else { return false };
    let escapes_only = |text: &str| {
        text.split('\u{1b}').enumerate().all(|(index, part)| match part.split_once('m') {
            Some((_, rest)) if index > 0 => rest.trim().is_empty(),
            _ => part.trim().is_empty(),
        })
    };
    escapes_only(&line[..at]) && escapes_only(&line[at + 3..])
}

fn report(diagnostic: &Diagnostic) -> Group<'_> {
    let level = match diagnostic.severity {
        Severity::Error => Level::ERROR,
        Severity::Warning => Level::WARNING,
    };
    // The message quotes what users wrote: nothing in it may control the terminal.
    let title = level.primary_title(normalize_untrusted_str(&diagnostic.message)).id(diagnostic.code.0);
    let mut elements: Vec<Element<'_>> = Vec::new();
    let mut shown = vec![false; diagnostic.related.len()];
    match &diagnostic.place {
        Place::Text { source, span } => {
            let mut marks = vec![(AnnotationKind::Primary, *span, None)];
            for ((place, message), shown) in diagnostic.related.iter().zip(&mut shown) {
                if let Place::Text { source: other, span } = place
                    && other.name() == source.name()
                    && fits(source, &marks, *span)
                {
                    marks.push((AnnotationKind::Context, *span, Some(message.as_str())));
                    *shown = true;
                }
            }
            elements.extend(snippet(source, &marks));
        }
        Place::File(name) | Place::Argument(name) => elements.push(origin(name)),
    }
    for ((place, message), _) in diagnostic.related.iter().zip(shown).filter(|(_, shown)| !shown) {
        elements.push(Level::NOTE.message(normalize_untrusted_str(message)).into());
        match place {
            Place::Text { source, span } => elements.extend(snippet(source, &[(AnnotationKind::Primary, *span, None)])),
            Place::File(name) | Place::Argument(name) => elements.push(origin(name)),
        }
    }
    if let Some(suggestion) = &diagnostic.suggestion {
        elements.push(Level::HELP.message(normalize_untrusted_str(suggestion)).into());
    }
    Group::with_title(title).elements(elements)
}

fn origin(name: &str) -> Element<'_> {
    Origin::path(normalize_untrusted_str(name)).into()
}

/// A marked span, and what is said about it.
type Mark<'a> = (AnnotationKind, Span, Option<&'a str>);

/// First and last line of a span that are shown.
fn lines(source: &Source, span: Span) -> (usize, usize) {
    let first = source.line_index(span.start);
    let last = source.line_index(span.end.max(span.start + 1) - 1).max(first);
    if last - first >= MOST_LINES { (first, first) } else { (first, last) }
}

/// Whether another span is so near to those marked that they are shown together.
fn fits(source: &Source, marks: &[Mark<'_>], span: Span) -> bool {
    let (first, last) = all_lines(source, marks);
    let (other_first, other_last) = lines(source, span);
    let apart = other_first.max(first).saturating_sub(other_last.min(last));
    apart <= NEAR_LINES && !is_long(source, first.min(other_first), last.max(other_last))
}

/// Whether the lines are on average longer than can be shown.
fn is_long(source: &Source, first: usize, last: usize) -> bool {
    let whole = source.line_span(first, last);
    whole.end - whole.start > LONG_LINE * (last - first + 1) as u32
}

fn all_lines(source: &Source, marks: &[Mark<'_>]) -> (usize, usize) {
    let every = marks.iter().map(|(_, span, _)| lines(source, *span));
    every.reduce(|a, b| (a.0.min(b.0), a.1.max(b.1))).unwrap_or((0, 0))
}

/// The lines of some spans with their marks, under the place of the primary one.
fn snippet<'a>(source: &'a Source, marks: &[Mark<'a>]) -> Vec<Element<'a>> {
    let (first, last) = all_lines(source, marks);
    let whole = source.line_span(first, last);
    if is_long(source, first, last) {
        return window(source, marks);
    }
    let snippet = marked(source, whole, marks).line_start(first + 1).path(normalize_untrusted_str(source.name()));
    vec![snippet.into()]
}

/// Of long lines, only the surroundings of the first mark, so that the work does not grow with the length of the line.
fn window<'a>(source: &'a Source, marks: &[Mark<'a>]) -> Vec<Element<'a>> {
    let (_, span, _) = marks[0];
    let line = source.line_index(span.start);
    let whole = source.line_span(line, line);
    let start = source.boundary(span.start.saturating_sub(LONG_LINE / 4).max(whole.start));
    let end = source.boundary((span.start + LONG_LINE / 2).min(whole.end));
    let (_, column) = source.line_column(span.start);
    let origin = Origin::path(normalize_untrusted_str(source.name())).line(line + 1).char_column(column as usize);
    vec![origin.into(), marked(source, Span { start, end }, &marks[..1]).line_start(line + 1).into()]
}

fn marked<'a>(source: &'a Source, shown: Span, marks: &[Mark<'a>]) -> Snippet<'a, Annotation<'a>> {
    Snippet::source(source.slice(shown)).annotations(marks.iter().map(|(kind, span, label)| {
        let start = span.start.clamp(shown.start, shown.end) - shown.start;
        let end = span.end.clamp(shown.start, shown.end) - shown.start;
        kind.span(start as usize..end as usize).label(label.map(normalize_untrusted_str))
    }))
}
