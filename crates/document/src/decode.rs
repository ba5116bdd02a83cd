//! From nodes to typed values; what does not fit is reported.

use std::sync::Arc;

use crate::node::shortened;
use crate::{
    BAD_VERSION, Diagnostic, Diagnostics, Field, MISSING_FIELD, NEWER_VERSION, NOT_FINITE, Node, Place, Source, Span,
    UNKNOWN_FIELD, UNKNOWN_VARIANT, Value, WRONG_TYPE,
};

/// Reads typed values out of the nodes of one source. Each method returns `None` after it has reported a mistake.
pub struct Decoder<'a> {
    /// The source that the nodes came from.
    pub source: &'a Arc<Source>,
    /// Where mistakes go.
    pub out: &'a mut Diagnostics,
}

impl<'a> Decoder<'a> {
    /// A decoder of one source's nodes.
    pub fn new(source: &'a Arc<Source>, out: &'a mut Diagnostics) -> Self {
        Self { source, out }
    }

    /// The place of a span of this source.
    pub fn place(&self, span: Span) -> Place {
        self.source.place(span)
    }

    /// Reports a mistake.
    pub fn report(&mut self, diagnostic: Diagnostic) {
        self.out.push(diagnostic);
    }

    /// Reports that a node should be something else ([`WRONG_TYPE`]); `expected` with its article: `a number`.
    pub fn wrong_type(&mut self, node: &Node, expected: &str) {
        let diagnostic = self.wrong_type_diagnostic(node, expected);
        self.out.push(diagnostic);
    }

    fn wrong_type_diagnostic(&self, node: &Node, expected: &str) -> Diagnostic {
        let message = format!("expected {expected}, found {}", node.describe());
        Diagnostic::error(WRONG_TYPE, self.place(node.span), message)
    }

    /// `true` or `false`.
    pub fn bool(&mut self, node: &Node) -> Option<bool> {
        match node.value {
            Value::Bool(value) => Some(value),
            _ => {
                self.wrong_type(node, "`true` or `false`");
                None
            }
        }
    }

    /// A finite number ([`NOT_FINITE`] otherwise); integers are numbers too.
    pub fn float(&mut self, node: &Node) -> Option<f64> {
        match node.value {
            Value::Number(number) if number.value.is_finite() => Some(number.value),
            Value::Number(number) => {
                let message = format!("expected a finite number, found {}", number.value);
                self.out.push(Diagnostic::error(NOT_FINITE, self.place(node.span), message));
                None
            }
            _ => {
                self.wrong_type(node, "a number");
                None
            }
        }
    }

    /// A number without a point or an exponent that fits 64 bits.
    pub fn integer(&mut self, node: &Node) -> Option<i64> {
        match node.value {
            Value::Number(number) if number.integer.is_some() => number.integer,
            Value::Number(number) if !number.value.is_finite() => self.float(node).map(|_| 0),
            _ => {
                self.wrong_type(node, "an integer");
                None
            }
        }
    }

    /// The version of the file's format, of which versions 1 to `newest` are known; reported where it is another
    /// ([`BAD_VERSION`], [`NEWER_VERSION`]).
    pub fn version(&mut self, node: &Node, newest: i64) {
        let Some(version) = self.integer(node) else { return };
        let place = self.place(node.span);
        if version > newest {
            let message = format!("this file has version {version}, but this program reads versions up to {newest}");
            self.report(Diagnostic::error(NEWER_VERSION, place, message).suggest("use a newer program"));
        } else if version < 1 {
            let message = format!("there is no version {version}");
            self.report(Diagnostic::error(BAD_VERSION, place, message).suggest(format!("write version: {newest}")));
        }
    }

    /// A string.
    pub fn text<'n>(&mut self, node: &'n Node) -> Option<&'n str> {
        match &node.value {
            Value::Text(text) => Some(text),
            Value::Variant { name, content: None, .. } => {
                let diagnostic = self.wrong_type_diagnostic(node, "a string");
                self.out.push(diagnostic.suggest(format!("write it in quotes: \"{}\"", shortened(name))));
                None
            }
            _ => {
                self.wrong_type(node, "a string");
                None
            }
        }
    }

    /// `[a, b, …]`.
    pub fn list<'n>(&mut self, node: &'n Node) -> Option<&'n [Node]> {
        match &node.value {
            Value::List(items) => Some(items),
            _ => {
                self.wrong_type(node, "a list `[…]`");
                None
            }
        }
    }

    /// `{ "key": value, … }` as keys, their places, and values, in the order of the file. Keys that are not strings are
    /// reported and left out.
    pub fn map<'n>(&mut self, node: &'n Node) -> Option<Vec<(&'n str, Span, &'n Node)>> {
        match &node.value {
            Value::Map(entries) => Some(
                entries.iter().filter_map(|(key, value)| self.text(key).map(|text| (text, key.span, value))).collect(),
            ),
            _ => {
                let mut diagnostic = self.wrong_type_diagnostic(node, "a map `{ \"name\": … }`");
                if matches!(node.value, Value::Struct(_)) {
                    diagnostic = diagnostic.suggest("write `{ \"name\": … }` instead of `(name: …)`");
                }
                self.out.push(diagnostic);
                None
            }
        }
    }

    /// `(a, b, …)`: a tuple of `N` finite numbers.
    pub fn floats<const N: usize>(&mut self, node: &Node) -> Option<[f64; N]> {
        let expected = || format!("a tuple of {N} numbers");
        match &node.value {
            Value::Tuple(items) if items.len() == N => {
                let values: Vec<_> = items.iter().map(|item| self.float(item)).collect();
                let values: Option<Vec<f64>> = values.into_iter().collect();
                values.and_then(|values| values.try_into().ok())
            }
            Value::List(items) if items.len() == N => {
                let diagnostic = self.wrong_type_diagnostic(node, &expected());
                self.out.push(diagnostic.suggest("write `(…)` instead of `[…]`"));
                None
            }
            _ => {
                self.wrong_type(node, &expected());
                None
            }
        }
    }

    /// `(name: value, …)`, or `()` for one without fields. `what` names it in messages, with its article (`a pass`).
    /// Fields that are not among the known ones are reported ([`UNKNOWN_FIELD`]).
    pub fn fields<'n>(&mut self, node: &'n Node, what: &str, known: &[&str]) -> Option<Fields<'n>> {
        let fields: &[Field] = match &node.value {
            Value::Struct(fields) => fields,
            Value::Unit => &[],
            _ => {
                let mut diagnostic = self.wrong_type_diagnostic(node, &format!("{what} `(name: …)`"));
                if matches!(node.value, Value::Map(_)) {
                    diagnostic = diagnostic.suggest("write `(name: …)` instead of `{ \"name\": … }`");
                }
                self.out.push(diagnostic);
                return None;
            }
        };
        for field in fields.iter().filter(|field| !known.contains(&field.name.as_str())) {
            let message = format!("{what} has no field `{}`", shortened(&field.name));
            let diagnostic = Diagnostic::error(UNKNOWN_FIELD, self.place(field.name_span), message);
            self.out.push(diagnostic.suggest_near(&field.name, known.iter().copied()));
        }
        Some(Fields { fields, span: node.span, what: what.to_owned() })
    }

    /// `Name` or `Name(…)` with a known name ([`UNKNOWN_VARIANT`] otherwise), and the content of its parentheses.
    /// `what` names it in messages, with its article (`a light`).
    pub fn variant<'n>(&mut self, node: &'n Node, what: &str, known: &[&str]) -> Option<(&'n str, Option<&'n Node>)> {
        let Value::Variant { name, name_span, content } = &node.value else {
            let diagnostic = self.wrong_type_diagnostic(node, what);
            self.out.push(diagnostic.suggest_available(known));
            return None;
        };
        if known.contains(&name.as_str()) {
            return Some((name, content.as_deref()));
        }
        let message = format!("`{}` is not {what}", shortened(name));
        let diagnostic = Diagnostic::error(UNKNOWN_VARIANT, self.place(*name_span), message);
        self.out.push(diagnostic.suggest_near(name, known.iter().copied()));
        None
    }
}

/// The fields of a struct.
#[derive(Clone, Debug)]
pub struct Fields<'n> {
    fields: &'n [Field],
    span: Span,
    what: String,
}

impl<'n> Fields<'n> {
    /// The struct, its parentheses included.
    pub fn span(&self) -> Span {
        self.span
    }

    /// All fields, in the order of the file; unknown ones too.
    pub fn iter(&self) -> std::slice::Iter<'n, Field> {
        self.fields.iter()
    }

    /// The value of a field; the first one where it is given twice.
    pub fn get(&self, name: &str) -> Option<&'n Node> {
        self.field(name).map(|field| &field.value)
    }

    /// A field with the place of its name.
    pub fn field(&self, name: &str) -> Option<&'n Field> {
        self.fields.iter().find(|field| field.name == name)
    }

    /// The value of a required field; reported at the struct ([`MISSING_FIELD`]) where it is not given.
    pub fn required(&self, decoder: &mut Decoder<'_>, name: &str) -> Option<&'n Node> {
        let node = self.get(name);
        if node.is_none() {
            let message = format!("{} needs the field `{name}`", self.what);
            let place = decoder.place(self.span);
            decoder.report(Diagnostic::error(MISSING_FIELD, place, message));
        }
        node
    }
}
