//! The tree that a document is read into.

use crate::Span;

/// A value and the text that it came from.
#[derive(Clone, Debug, PartialEq)]
pub struct Node {
    /// The text. Of `Some(x)` it is the text of `x`.
    pub span: Span,
    /// What it says.
    pub value: Value,
}

/// What a node says.
#[derive(Clone, Debug, PartialEq)]
pub enum Value {
    /// `()`
    Unit,
    /// `true`, `false`
    Bool(bool),
    /// `1`, `0xff`, `1.5e3`, `inf`, `NaN`
    Number(Number),
    /// `"…"`, `r#"…"#`, with its escapes resolved.
    Text(String),
    /// `'c'`
    Char(char),
    /// `[a, b]`
    List(Vec<Node>),
    /// `{ key: value }` in the order of the file. A key that appears twice was reported and is here twice.
    Map(Vec<(Node, Node)>),
    /// `(a, b)`, and `(a)`
    Tuple(Vec<Node>),
    /// `(name: value)` in the order of the file.
    Struct(Vec<Field>),
    /// `Name`, `Name(…)`; `None` too. `Some(x)` is read as `x`.
    Variant {
        /// The name.
        name: String,
        /// Where the name is.
        name_span: Span,
        /// The content of the parentheses after it: a [`Value::Unit`], [`Value::Tuple`] or [`Value::Struct`] whose span
        /// includes the parentheses.
        content: Option<Box<Node>>,
    },
}

/// A number as written.
#[derive(Copy, Clone, Debug, PartialEq)]
pub struct Number {
    /// The value, rounded to the nearest double.
    pub value: f64,
    /// The exact value where an integer was written (no point, no exponent) that fits.
    pub integer: Option<i64>,
}

/// One `name: value` of a struct.
#[derive(Clone, Debug, PartialEq)]
pub struct Field {
    /// The name.
    pub name: String,
    /// Where the name is.
    pub name_span: Span,
    /// The value given to it.
    pub value: Node,
}

impl Node {
    /// What this is, in words for a message: `the number 3`, `a list`, `` `Point(…)` ``.
    pub fn describe(&self) -> String {
        match &self.value {
            Value::Unit => "`()`".to_owned(),
            Value::Bool(value) => format!("`{value}`"),
            Value::Number(Number { integer: Some(value), .. }) => format!("the number {value}"),
            Value::Number(number) => format!("the number {}", number.value),
            Value::Text(text) => format!("the text \"{}\"", shortened(text)),
            Value::Char(value) => format!("the character '{}'", value.escape_debug()),
            Value::List(items) if items.is_empty() => "an empty list".to_owned(),
            Value::List(items) => format!("a list of {}", items.len()),
            Value::Map(entries) if entries.is_empty() => "an empty map".to_owned(),
            Value::Map(_) => "a map".to_owned(),
            Value::Tuple(items) => format!("a tuple of {}", items.len()),
            Value::Struct(_) => "a struct".to_owned(),
            Value::Variant { name, content: None, .. } => format!("`{}`", shortened(name)),
            Value::Variant { name, .. } => format!("`{}(…)`", shortened(name)),
        }
    }
}

/// At most 40 characters of a text, its control characters escaped.
pub(crate) fn shortened(text: &str) -> String {
    const MOST: usize = 40;
    let mut short: String = text.chars().take(MOST).flat_map(char::escape_debug).collect();
    short = short.replace("\\\"", "\"").replace("\\'", "'");
    if text.chars().nth(MOST).is_some() {
        short.push('…');
    }
    short
}
