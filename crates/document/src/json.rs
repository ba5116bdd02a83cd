//! Diagnostics as JSON, for programs.

use std::fmt::Write;

use crate::{Diagnostic, Place, Severity};

/// Most characters of the offending text.
const MOST_TEXT: usize = 80;

/// A JSON array with one object for each diagnostic, each on a line of its own.
///
/// Members: `code`, `severity` (`error`, `warning`), `file`, `line`, `column` (from 1, in characters), `text` (the
/// first line of the offending text, at most 80 characters), `message`, `suggestion`, and `related`, an array of the
/// other places with `file`, `line`, `column`, `text` and `message`. What does not exist is `null`. A place on the
/// command line has `argument` instead of a file.
pub fn render_json<'a>(diagnostics: impl IntoIterator<Item = &'a Diagnostic>) -> String {
    let mut json = String::from("[");
    for (index, diagnostic) in diagnostics.into_iter().enumerate() {
        json.push_str(if index == 0 { "\n  {" } else { ",\n  {" });
        write_diagnostic(&mut json, diagnostic);
        json.push('}');
    }
    json.push_str(if json.len() == 1 { "]\n" } else { "\n]\n" });
    json
}

fn write_diagnostic(json: &mut String, diagnostic: &Diagnostic) {
    let severity = match diagnostic.severity {
        Severity::Error => "error",
        Severity::Warning => "warning",
    };
    member(json, "code", Some(diagnostic.code.0));
    member(json, "severity", Some(severity));
    write_place(json, &diagnostic.place);
    member(json, "message", Some(&diagnostic.message));
    member(json, "suggestion", diagnostic.suggestion.as_deref());
    json.push_str("\"related\": [");
    for (index, (place, message)) in diagnostic.related.iter().enumerate() {
        json.push_str(if index == 0 { "{" } else { ", {" });
        write_place(json, place);
        member(json, "message", Some(message));
        json.truncate(json.len() - 2);
        json.push('}');
    }
    json.push(']');
}

/// Writes the members of a place, each followed by a comma.
fn write_place(json: &mut String, place: &Place) {
    member(json, "file", place.file());
    match place.line_column() {
        // Writing to a string cannot fail.
        Some((line, column)) => drop(write!(json, "\"line\": {line}, \"column\": {column}, ")),
        None => json.push_str("\"line\": null, \"column\": null, "),
    }
    match place {
        Place::Text { source, span } => member(json, "text", Some(&first_line(source.slice(*span)))),
        Place::File(_) => member(json, "text", None),
        Place::Argument(argument) => {
            member(json, "text", Some(&first_line(argument)));
            member(json, "argument", Some(argument));
        }
    }
}

fn first_line(text: &str) -> String {
    text.lines().next().unwrap_or("").chars().take(MOST_TEXT).collect()
}

fn member(json: &mut String, name: &str, value: Option<&str>) {
    json.push('"');
    json.push_str(name);
    json.push_str("\": ");
    match value {
        Some(value) => string(json, value),
        None => json.push_str("null"),
    }
    json.push_str(", ");
}

fn string(json: &mut String, text: &str) {
    json.push('"');
    for character in text.chars() {
        match character {
            '"' => json.push_str("\\\""),
            '\\' => json.push_str("\\\\"),
            '\n' => json.push_str("\\n"),
            '\r' => json.push_str("\\r"),
            '\t' => json.push_str("\\t"),
            // The controls, and the two line separators that break JavaScript.
            c if c.is_control() || matches!(c, '\u{2028}' | '\u{2029}') => drop(write!(json, "\\u{:04x}", c as u32)),
            c => json.push(c),
        }
    }
    json.push('"');
}
