//! `--set scene.<path>=VALUE`: values of the command line put into the tree of a scene file before it is decoded.
//!
//! The decoder reads one source; so the arguments are appended to the scene file's text, their spans moved there, and
//! [`Merged::restore`] turns places in the appended part back into the arguments that they came from.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use tyndall_document::{Diagnostic, Diagnostics, Field, Node, Place, Source, Span, Value};

use crate::codes::UNKNOWN_PATH;

/// One value that replaces, or adds, a field of the scene file.
#[derive(Clone, Debug)]
pub struct Override {
    /// Names of fields and indices into lists, separated by dots: `medium.extinction`, `lights.0.intensity`,
    /// `objects.1.material.diffuse`, `medium.phase.g`.
    pub path: String,
    /// What to put there.
    pub value: Node,
    /// The source of `value`, made by [`Source::argument`], so that its name is the argument as the user wrote it.
    pub source: Arc<Source>,
}

/// In the order of the command line: of several for one path the last wins.
pub type Overrides = Vec<Override>;

impl Override {
    /// Reads a value as RON. `argument` is how the user wrote it (`--set scene.medium.albedo=1`), `value` the part
    /// behind the `=`. Mistakes of its syntax are reported at the argument.
    pub fn read(path: &str, value: &str, argument: &str, out: &mut Diagnostics) -> Option<Override> {
        let source = Source::argument(argument, value);
        let value = tyndall_document::parse_value(&source, out)?;
        Some(Override { path: path.to_owned(), value, source })
    }
}

/// The scene file's source with the arguments behind its text.
pub(crate) struct Merged {
    pub source: Arc<Source>,
    original: Arc<Source>,
    /// Where each argument's text starts, and the argument.
    arguments: Vec<(u32, String)>,
}

impl Merged {
    /// Puts the overrides into the tree.
    pub fn new(original: &Arc<Source>, root: &mut Node, overrides: &Overrides, out: &mut Diagnostics) -> Merged {
        let mut text = original.text().to_owned();
        let mut arguments = Vec::new();
        for entry in overrides {
            text.push('\n');
            let start = text.len() as u32;
            arguments.push((start, entry.source.name().to_owned()));
            text.push_str(&entry.path);
            text.push('=');
            let mut value = entry.value.clone();
            shift(&mut value, text.len() as u32);
            text.push_str(entry.source.text());
            let path = segments(&entry.path, start);
            // On a copy: a path that leads nowhere must not leave its first half in the tree.
            let mut changed = root.clone();
            match set(&mut changed, &path, value) {
                Ok(()) => *root = changed,
                Err(message) => {
                    let place = Place::Argument(entry.source.name().to_owned());
                    out.push(Diagnostic::error(UNKNOWN_PATH, place, message));
                }
            }
        }
        let source = if overrides.is_empty() { Arc::clone(original) } else { Source::new(original.name(), text) };
        Merged { source, original: Arc::clone(original), arguments }
    }

    /// Where a path that the text names leads: from the scene file's folder, or from the working directory where it was
    /// given on the command line.
    pub fn path(&self, folder: &Path, text: &str, span: Span) -> PathBuf {
        let is_argument = self.arguments.first().is_some_and(|first| span.start >= first.0);
        if is_argument { PathBuf::from(text) } else { folder.join(text) }
    }

    /// Diagnostics with places in the scene file or at arguments.
    pub fn restore(&self, diagnostics: Diagnostics) -> Diagnostics {
        let restored = diagnostics.into_iter().map(|mut diagnostic| {
            diagnostic.place = self.place(diagnostic.place);
            let related = diagnostic.related.into_iter().map(|(place, text)| (self.place(place), text));
            diagnostic.related = related.collect();
            diagnostic
        });
        restored.collect()
    }

    fn place(&self, place: Place) -> Place {
        match place {
            Place::Text { source, span } if Arc::ptr_eq(&source, &self.source) => {
                match self.arguments.iter().rfind(|(start, _)| *start <= span.start) {
                    Some((_, argument)) => Place::Argument(argument.clone()),
                    None => Place::Text { source: Arc::clone(&self.original), span },
                }
            }
            place => place,
        }
    }
}

/// A part of a path and where it stands in the merged text.
type Segment<'a> = (&'a str, Span);

fn segments(path: &str, start: u32) -> Vec<Segment<'_>> {
    let mut at = start;
    let segment = |name| {
        let span = Span::new(at, at + str::len(name) as u32);
        at = span.end + 1;
        (name, span)
    };
    path.split('.').map(segment).collect()
}

/// Replaces what a path leads to; adds fields that are not there. Unknown field names are left to the decoder, which
/// knows near ones.
fn set(node: &mut Node, path: &[Segment], value: Node) -> Result<(), String> {
    let Some((&(name, span), rest)) = path.split_first() else {
        *node = value;
        return Ok(());
    };
    let index = name.parse::<usize>().ok().filter(|_| name.bytes().all(|b| b.is_ascii_digit()));
    let what = node.describe();
    match &mut node.value {
        Value::Variant { content, .. } => {
            let empty = || Box::new(Node { span, value: Value::Unit });
            set(content.get_or_insert_with(empty), path, value)
        }
        Value::List(items) | Value::Tuple(items) => match index.map(|index| (index, items.get_mut(index))) {
            Some((_, Some(item))) => set(item, rest, value),
            Some((index, None)) => Err(format!("there is no element {index} in {what}; they count from 0")),
            None => Err(format!("`{name}` stands where the index of an element of {what} belongs")),
        },
        Value::Unit | Value::Struct(_) if index.is_some() => {
            Err(format!("there is no element {name}: the scene file gives no list here"))
        }
        Value::Unit | Value::Struct(_) if name.is_empty() => Err("the path has an empty name".to_owned()),
        Value::Unit => {
            node.value = Value::Struct(Vec::new());
            set(node, path, value)
        }
        Value::Struct(fields) => {
            let at = fields.iter().position(|field| field.name == name).unwrap_or_else(|| {
                let value = Node { span, value: Value::Unit };
                fields.push(Field { name: name.to_owned(), name_span: span, value });
                fields.len() - 1
            });
            set(&mut fields[at].value, rest, value)
        }
        _ => Err(format!("{what} has no part `{name}`")),
    }
}

/// Moves every span of a tree.
fn shift(node: &mut Node, by: u32) {
    let moved = |span: Span| Span::new(span.start + by, span.end + by);
    node.span = moved(node.span);
    match &mut node.value {
        Value::List(items) | Value::Tuple(items) => items.iter_mut().for_each(|item| shift(item, by)),
        Value::Map(entries) => entries.iter_mut().for_each(|(key, value)| {
            shift(key, by);
            shift(value, by);
        }),
        Value::Struct(fields) => fields.iter_mut().for_each(|field| {
            field.name_span = moved(field.name_span);
            shift(&mut field.value, by);
        }),
        Value::Variant { name_span, content, .. } => {
            *name_span = moved(*name_span);
            if let Some(content) = content {
                shift(content, by);
            }
        }
        Value::Unit | Value::Bool(_) | Value::Number(_) | Value::Text(_) | Value::Char(_) => {}
    }
}
