//! What a mistake is, and where it is.

use std::collections::{HashMap, HashSet};
use std::fmt;
use std::sync::Arc;

use crate::{Source, Span};

/// The stable name of one class of mistakes, in kebab case: `unknown-pass`.
#[derive(Copy, Clone, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
pub struct Code(pub &'static str);

impl fmt::Display for Code {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.0)
    }
}

/// How bad it is.
#[derive(Copy, Clone, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
pub enum Severity {
    /// The input cannot be used.
    Error,
    /// The input can be used, but is probably not what was meant.
    Warning,
}

/// Where something is.
#[derive(Clone, Debug)]
pub enum Place {
    /// A part of a text.
    Text {
        /// The text.
        source: Arc<Source>,
        /// The part.
        span: Span,
    },
    /// A file as a whole, by its path as the user gave it.
    File(String),
    /// An argument of the command line, as the user wrote it.
    Argument(String),
}

impl Place {
    /// The file's path; `None` for an argument.
    pub fn file(&self) -> Option<&str> {
        match self {
            Place::Text { source, .. } => Some(source.name()),
            Place::File(name) => Some(name),
            Place::Argument(_) => None,
        }
    }

    /// Line and column where it starts, both counted from 1, columns in characters; only a part of a text has them.
    pub fn line_column(&self) -> Option<(u32, u32)> {
        match self {
            Place::Text { source, span } => Some(source.line_column(span.start)),
            _ => None,
        }
    }

    fn offset(&self) -> u32 {
        match self {
            Place::Text { span, .. } => span.start,
            _ => 0,
        }
    }
}

impl PartialEq for Place {
    /// Texts are equal by name: a file that was read twice is the same file.
    fn eq(&self, other: &Self) -> bool {
        match (self, other) {
            (Place::Text { source: a, span: x }, Place::Text { source: b, span: y }) => x == y && a.name() == b.name(),
            (Place::File(a), Place::File(b)) | (Place::Argument(a), Place::Argument(b)) => a == b,
            _ => false,
        }
    }
}

/// One mistake: its class, its place, what is wrong, and how to correct it.
#[derive(Clone, Debug, PartialEq)]
pub struct Diagnostic {
    /// How bad it is.
    pub severity: Severity,
    /// The class of the mistake.
    pub code: Code,
    /// Where it is.
    pub place: Place,
    /// What is wrong, with the values concerned: one sentence without a full stop.
    pub message: String,
    /// What to do.
    pub suggestion: Option<String>,
    /// The other places involved, each with a remark.
    pub related: Vec<(Place, String)>,
}

impl Diagnostic {
    /// A mistake with which the input cannot be used.
    pub fn error(code: Code, place: Place, message: impl Into<String>) -> Self {
        let message = message.into();
        Self { severity: Severity::Error, code, place, message, suggestion: None, related: Vec::new() }
    }

    /// Something that can be used, but is probably not what was meant.
    pub fn warning(code: Code, place: Place, message: impl Into<String>) -> Self {
        Self { severity: Severity::Warning, ..Self::error(code, place, message) }
    }

    /// Says what to do.
    #[must_use]
    pub fn suggest(mut self, suggestion: impl Into<String>) -> Self {
        self.suggestion = Some(suggestion.into());
        self
    }

    /// Adds another place that is involved, with a remark.
    #[must_use]
    pub fn relate(mut self, place: Place, message: impl Into<String>) -> Self {
        self.related.push((place, message.into()));
        self
    }
}

/// Mistakes in the order in which they were found.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Diagnostics(Vec<Diagnostic>);

impl Diagnostics {
    /// None yet.
    pub fn new() -> Self {
        Self::default()
    }

    /// Adds one.
    pub fn push(&mut self, diagnostic: Diagnostic) {
        self.0.push(diagnostic);
    }

    /// Whether there are none, not even warnings.
    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    /// How many there are, warnings included.
    pub fn len(&self) -> usize {
        self.0.len()
    }

    /// Whether at least one is an error.
    pub fn has_errors(&self) -> bool {
        self.0.iter().any(|diagnostic| diagnostic.severity == Severity::Error)
    }

    /// All of them, in order.
    pub fn iter(&self) -> std::slice::Iter<'_, Diagnostic> {
        self.0.iter()
    }

    /// All of them, in order.
    pub fn as_slice(&self) -> &[Diagnostic] {
        &self.0
    }

    /// Brings them into the order of the files: files in the order in which they were first named, in a file by
    /// position, arguments of the command line last. Those at the same place keep their order.
    pub fn sort(&mut self) {
        let mut files: HashMap<String, usize> = HashMap::new();
        let mut keyed: Vec<_> = std::mem::take(&mut self.0)
            .into_iter()
            .map(|diagnostic| {
                let file = diagnostic.place.file().map_or(usize::MAX, |name| match files.get(name) {
                    Some(index) => *index,
                    None => {
                        let index = files.len();
                        files.insert(name.to_owned(), index);
                        index
                    }
                });
                ((file, diagnostic.place.offset()), diagnostic)
            })
            .collect();
        keyed.sort_by_key(|(key, _)| *key);
        self.0 = keyed.into_iter().map(|(_, diagnostic)| diagnostic).collect();
    }

    /// Removes repetitions, which have the same code, place and message. The first one stays.
    pub fn dedup(&mut self) {
        let mut seen = HashSet::new();
        self.0.retain(|diagnostic| {
            let (name, span) = match &diagnostic.place {
                Place::Text { source, span } => (source.name().to_owned(), Some(*span)),
                Place::File(name) | Place::Argument(name) => (name.clone(), None),
            };
            seen.insert((diagnostic.code, name, span, diagnostic.message.clone()))
        });
    }

    pub(crate) fn as_mut_slice(&mut self) -> &mut [Diagnostic] {
        &mut self.0
    }
}

impl Extend<Diagnostic> for Diagnostics {
    fn extend<T: IntoIterator<Item = Diagnostic>>(&mut self, iter: T) {
        self.0.extend(iter);
    }
}

impl From<Diagnostic> for Diagnostics {
    fn from(diagnostic: Diagnostic) -> Self {
        Self(vec![diagnostic])
    }
}

impl FromIterator<Diagnostic> for Diagnostics {
    fn from_iter<T: IntoIterator<Item = Diagnostic>>(iter: T) -> Self {
        Self(iter.into_iter().collect())
    }
}

impl IntoIterator for Diagnostics {
    type Item = Diagnostic;
    type IntoIter = std::vec::IntoIter<Diagnostic>;
    fn into_iter(self) -> Self::IntoIter {
        self.0.into_iter()
    }
}

impl<'a> IntoIterator for &'a Diagnostics {
    type Item = &'a Diagnostic;
    type IntoIter = std::slice::Iter<'a, Diagnostic>;
    fn into_iter(self) -> Self::IntoIter {
        self.0.iter()
    }
}
