//! naga's errors, worded for authors and placed in their files.

mod reasons;

use std::error::Error;

use naga::front::wgsl::ParseError;
use naga::valid::ValidationError;
use naga::{Module, WithSpan};
use tyndall_document::{Diagnostic, Place, did_you_mean, near};

use crate::assemble::Assembly;
use crate::codes;
use crate::library::Library;

/// A text that naga cannot read.
pub fn syntax(assembly: &Assembly, library: &Library, error: &ParseError) -> Diagnostic {
    if let Some(problem) = declared_twice(assembly, error) {
        return problem;
    }
    let mut labels = error.labels();
    let (span, label) = labels.next().unwrap_or_default();
    let mut message = tidy(error.message());
    if assembly.map.is_between(span) {
        message =
            message.replace("`const_assert`", "the end of the file").replace("\"const_assert\"", "the end of the file");
    } else if !label.is_empty() && !says(&message, label) {
        message = format!("{message}: {label}");
    }
    let mut problem = Diagnostic::error(codes::SYNTAX, assembly.map.place(span), message);
    for (span, label) in labels {
        problem = problem.relate(assembly.map.place(span), tidy(label));
    }
    let notes: Vec<String> = error.notes().map(tidy).collect();
    match unknown_name(error.message()).and_then(|name| suggest(assembly, library, name)) {
        Some(suggestion) => problem.suggest(suggestion),
        None if !notes.is_empty() => problem.suggest(notes.join("; ")),
        None => problem,
    }
}

/// A name that two files declare is reported in the importing one, whose author did not write the other.
fn declared_twice(assembly: &Assembly, error: &ParseError) -> Option<Diagnostic> {
    let name = error.message().strip_prefix("redefinition of ")?;
    let mut places = error.labels().map(|(span, _)| assembly.map.place(span));
    let (second, first) = (places.next()?, places.next()?);
    let (place, other) = if first.file() == second.file() { (second, first) } else { (first, second) };
    let problem =
        Diagnostic::error(codes::SYNTAX, place, format!("{name} is declared twice")).relate(other, "also here");
    Some(problem.suggest("rename one of them"))
}

/// The name that naga does not know.
fn unknown_name(message: &str) -> Option<&str> {
    message.strip_prefix("no definition in scope for identifier: `")?.strip_suffix('`')
}

/// A module that declares the name and is not imported, or a near name.
fn suggest(assembly: &Assembly, library: &Library, name: &str) -> Option<String> {
    for module in library.module_names() {
        let source = library.module(module)?;
        let declares = || crate::scan::scan(source).place_of(name).is_some();
        if !assembly.map.sources().any(|known| std::sync::Arc::ptr_eq(known, source)) && declares() {
            return Some(format!("`{name}` is declared in a shared module: `#import {module}`"));
        }
    }
    let declared = assembly.scans.iter().flat_map(|(_, scan)| scan.declared.iter());
    near(name, declared.map(|(name, _)| name.as_str())).map(did_you_mean)
}

/// Whether all words of `part` are in `whole`.
fn says(whole: &str, part: &str) -> bool {
    let words = |text: &str| -> Vec<String> {
        text.split(|c: char| !c.is_alphanumeric()).filter(|w| !w.is_empty()).map(str::to_lowercase).collect()
    };
    let whole = words(whole);
    matches!(part, "unknown identifier" | "see msg")
        || part.starts_with("definition of")
        || words(part).iter().all(|word| whole.contains(word))
}

/// A module that naga finds invalid. Of the places that naga names the narrowest is the mistake's.
pub fn invalid(assembly: &Assembly, module: &Module, error: &WithSpan<ValidationError>) -> Diagnostic {
    let mut spans: Vec<_> = error.spans().filter(|(span, _)| span.is_defined()).collect();
    spans.sort_by_key(|(span, _)| span.to_range().map(|range| range.len()));
    let mut spans = spans.into_iter();
    let place = match (spans.next(), name(error.as_inner())) {
        (Some((span, context)), Some(name)) if !context.contains("Expression") => {
            assembly.map.place_of_name(*span, name)
        }
        (Some((span, _)), _) => assembly.map.place(*span),
        (None, Some(name)) => assembly.root_place(name).unwrap_or_else(|| assembly.map.place(naga::Span::UNDEFINED)),
        (None, None) => assembly.map.place(naga::Span::UNDEFINED),
    };
    let mut problem = Diagnostic::error(codes::INVALID, place, reason(module, error.as_inner()));
    for (span, context) in spans {
        let place = assembly.map.place(*span);
        if !context.contains("Function ") && !context.contains("EntryPoint") && place != problem.place {
            problem = problem.relate(place, label(context));
        }
    }
    problem
}

/// The name of the declaration that is at fault.
fn name(error: &ValidationError) -> Option<&str> {
    match error {
        ValidationError::Type { name, .. }
        | ValidationError::Constant { name, .. }
        | ValidationError::Override { name, .. }
        | ValidationError::GlobalVariable { name, .. }
        | ValidationError::Function { name, .. }
        | ValidationError::EntryPoint { name, .. } => Some(name).filter(|name| !name.is_empty()).map(String::as_str),
        _ => None,
    }
}

/// The declaration that is at fault, as the beginning of a message.
fn subject(error: &ValidationError) -> String {
    let kind = match error {
        ValidationError::Type { .. } => "type",
        ValidationError::Constant { .. } => "constant",
        ValidationError::Override { .. } => "override",
        ValidationError::GlobalVariable { .. } => "variable",
        ValidationError::Function { .. } => "function",
        ValidationError::EntryPoint { .. } => "entry point",
        _ => "",
    };
    name(error).map(|name| format!("{kind} `{name}`: ")).unwrap_or_default()
}

/// What is at fault, and the innermost causes.
fn reason(module: &Module, error: &ValidationError) -> String {
    let subject = subject(error);
    if let Some(known) = reasons::known(module, error) {
        return format!("{subject}{known}");
    }
    let mut causes = Vec::new();
    let mut cause: Option<&dyn Error> = Some(error);
    while let Some(error) = cause {
        causes.push(without_handles(&error.to_string()));
        cause = error.source();
    }
    let last = causes.len() - 1;
    let messages: Vec<String> = causes
        .into_iter()
        .enumerate()
        .filter(|(index, text)| *index == last || !text.ends_with(" is invalid"))
        .map(|(_, text)| tidy(&text))
        .collect();
    format!("{subject}{}", messages.join(": "))
}

/// naga prints the index of a thing in its arena as `[12]`, which means nothing to an author.
fn without_handles(text: &str) -> String {
    let mut out = String::new();
    let mut rest = text;
    while let Some(open) = rest.find('[') {
        let Some(length) = rest[open..].find(']') else { break };
        let digits = &rest[open + 1..open + length];
        let handle = !digits.is_empty() && digits.bytes().all(|byte| byte.is_ascii_digit());
        let kept = if handle { rest[..open].trim_end_matches(' ') } else { &rest[..open + length + 1] };
        out.push_str(kept);
        rest = &rest[open + length + 1..];
    }
    out.push_str(rest);
    out.replace(" Some()", "")
}

/// A place that naga names by one of its own types, in words.
fn label(context: &str) -> String {
    let kind = context.split([' ', '<']).next().unwrap_or_default().rsplit("::").next().unwrap_or_default();
    match kind {
        "Expression" => "this expression".to_owned(),
        "Type" => "this type".to_owned(),
        "GlobalVariable" | "LocalVariable" => "this variable".to_owned(),
        "Function" => "in this function".to_owned(),
        "Constant" => "this constant".to_owned(),
        "Override" => "this override".to_owned(),
        _ => tidy(&without_handles(context)),
    }
}

/// Makes the first letter lower-case, unless the text begins with a name, and removes the final dot.
fn tidy(text: &str) -> String {
    let text = text.replace("{AbstractFloat}", "AbstractFloat").replace("{AbstractInt}", "AbstractInt");
    let text = text.trim().trim_end_matches('.');
    let mut characters = text.chars();
    match (characters.next(), characters.clone().next()) {
        (Some(first), Some(second)) if first.is_uppercase() && second.is_lowercase() => {
            first.to_lowercase().chain(characters).collect()
        }
        _ => text.to_owned(),
    }
}

/// naga itself failed.
pub fn internal(assembly: &Assembly, step: &str, said: &str) -> Diagnostic {
    let (root, _) = assembly.root();
    let message = format!("naga failed while it {step} this shader: {said}");
    Diagnostic::error(codes::INTERNAL, Place::File(root.name().to_owned()), message)
        .suggest("undo the last change of the shader: this is a bug in naga, not in the shader")
}

#[cfg(test)]
mod tests {
    use tyndall_document::{Source, render_text};

    use super::*;

    /// The one code that no text is known to reach: 1,000,000 mutated shaders found none.
    #[test]
    fn a_failure_of_naga_is_reported() {
        let assembly = crate::assemble::assemble(&Source::new("pass.wgsl", ""), &Library::default())
            .unwrap_or_else(|_| unreachable!());
        assert_eq!(
            render_text(&[internal(&assembly, "validates", "index out of bounds")], false).trim_end(),
            "error[shader-internal]: naga failed while it validates this shader: index out of bounds\n--> pass.wgsl\n \
             = help: undo the last change of the shader: this is a bug in naga, not in the shader"
        );
    }

    #[test]
    fn handles_are_left_out() {
        assert_eq!(without_handles("Call to [12] is invalid"), "Call to is invalid");
        assert_eq!(without_handles("a[0] and [1"), "a and [1");
        assert_eq!(without_handles("the type Some([3]) of [u32]"), "the type of [u32]");
    }
}
