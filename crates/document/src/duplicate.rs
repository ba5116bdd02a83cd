//! Names that appear twice.

use std::collections::HashMap;

use crate::node::shortened;
use crate::reader::Reader;
use crate::{DUPLICATE_NAME, Field, Node, Span, Value};

/// Up to this many, comparing every pair is faster than a table.
const FEW: usize = 12;

/// Reports fields of one struct that share a name.
pub(crate) fn report_fields(reader: &mut Reader<'_>, fields: &[Field]) {
    for (second, first) in repeated(fields, |field| Some(field.name.as_str())) {
        let (second, first) = (&fields[second], &fields[first]);
        let message = format!("the field `{}` appears twice", shortened(&second.name));
        reader.report_duplicate(DUPLICATE_NAME, second.name_span, first.name_span, message);
    }
}

/// Reports keys of one map that are equal. Keys that are lists, maps or the like are not compared.
pub(crate) fn report_keys(reader: &mut Reader<'_>, entries: &[(Node, Node)]) {
    let texts = entries.iter().all(|(key, _)| matches!(key.value, Value::Text(_)));
    let pairs = if texts {
        repeated(entries, |(key, _)| match &key.value {
            Value::Text(text) => Some(text.as_str()),
            _ => None,
        })
    } else {
        let names: Vec<_> = entries.iter().map(|(key, _)| simple(key)).collect();
        repeated(&names, |name| name.as_deref())
    };
    for (second, first) in pairs {
        let (second, first): (Span, Span) = (entries[second].0.span, entries[first].0.span);
        let message = format!("the key `{}` appears twice", shortened(reader.source.slice(second)));
        reader.report_duplicate(DUPLICATE_NAME, second, first, message);
    }
}

/// A key as a text that equal keys share, prefixed with its kind.
fn simple(key: &Node) -> Option<String> {
    match &key.value {
        Value::Text(text) => Some(format!("\"{text}")),
        Value::Char(character) => Some(format!("'{character}")),
        Value::Number(number) => Some(match number.integer {
            Some(integer) => format!("i{integer}"),
            None => format!("f{}", number.value),
        }),
        Value::Bool(value) => Some(value.to_string()),
        Value::Variant { name, content: None, .. } => Some(format!("v{name}")),
        _ => None,
    }
}

/// Pairs of a later item and the first one of the same name.
fn repeated<T>(items: &[T], name: impl Fn(&T) -> Option<&str>) -> Vec<(usize, usize)> {
    let mut pairs = Vec::new();
    let mut seen = HashMap::new();
    for (second, item) in items.iter().enumerate() {
        let Some(text) = name(item) else { continue };
        let first = if items.len() <= FEW {
            items[..second].iter().position(|other| name(other) == Some(text))
        } else {
            match seen.entry(text) {
                std::collections::hash_map::Entry::Occupied(first) => Some(*first.get()),
                std::collections::hash_map::Entry::Vacant(free) => {
                    free.insert(second);
                    None
                }
            }
        };
        pairs.extend(first.map(|first| (second, first)));
    }
    pairs
}
