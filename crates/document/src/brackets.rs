//! Lists, maps, structs and tuples: the contents of their brackets.

use crate::node::shortened;
use crate::reader::{Reader, span};
use crate::{Code, Diagnostic, Field, MISSING_COLON, Node, Span, Value, duplicate};

impl Reader<'_> {
    /// Reads `[…]`.
    pub fn list(&mut self) -> Option<Node> {
        let start = self.at;
        let mut items = Vec::new();
        self.sequence(b']', &mut |reader| {
            let item = reader.at;
            items.push(reader.value()?);
            reader.refuse_entry(item)
        })?;
        Some(Node { span: span(start, self.at), value: Value::List(items) })
    }

    /// Reads `{…}`.
    pub fn map(&mut self) -> Option<Node> {
        let start = self.at;
        let mut entries = Vec::new();
        self.sequence(b'}', &mut |reader| {
            let item = reader.at;
            let key = reader.value()?;
            reader.skip_space();
            match reader.byte() {
                Some(b':') => reader.at += 1,
                None | Some(b',' | b')' | b']' | b'}') => {
                    reader.hold(item, key.span, "an entry of a map is `key: value`, but this one has no value", None);
                    return Some(());
                }
                Some(_) => reader.report_missing_colon(key.span),
            }
            reader.skip_space();
            let value = reader.value()?;
            entries.push((key, value));
            Some(())
        })?;
        duplicate::report_keys(self, &entries);
        Some(Node { span: span(start, self.at), value: Value::Map(entries) })
    }

    /// Reads `(…)`: a struct where its items have names, else a tuple.
    pub fn parentheses(&mut self) -> Option<Node> {
        let start = self.at;
        let mut fields = Vec::new();
        let mut items = Vec::new();
        self.sequence(b')', &mut |reader| {
            let item = reader.at;
            let Some((name, name_span)) = reader.field_name(!fields.is_empty()) else {
                let value = reader.value()?;
                reader.skip_space();
                if reader.byte() == Some(b':') {
                    reader.at += 1;
                    fields.push(reader.quoted_field(item, &value)?);
                } else if fields.is_empty() {
                    items.push(value);
                } else {
                    reader.hold(item, value.span, "a plain value is among the fields of a struct", None);
                }
                return Some(());
            };
            if !items.is_empty() {
                let message = format!("the field `{name}` is among the plain values of a tuple");
                reader.hold(item, name_span, message, None);
            }
            reader.skip_space();
            let value = reader.value()?;
            fields.push(Field { name, name_span, value });
            Some(())
        })?;
        duplicate::report_fields(self, &fields);
        let value = match (fields.is_empty(), items.is_empty()) {
            (true, true) => Value::Unit,
            (true, false) => Value::Tuple(items),
            _ => Value::Struct(fields),
        };
        Some(Node { span: span(start, self.at), value })
    }

    /// Reads `name:`. A forgotten colon is reported; it is less doubtful that it was forgotten `in_struct`.
    fn field_name(&mut self, in_struct: bool) -> Option<(String, Span)> {
        let start = self.at;
        let (name, end) = self.identifier_at(start)?;
        let name_span = span(start, end);
        self.at = end;
        self.skip_space();
        let here = self.at;
        let same_line = !self.bytes[end..here].contains(&b'\n');
        let lower = name.starts_with(|first: char| first.is_lowercase());
        let literal = matches!(name, "true" | "false" | "inf");
        match self.byte() {
            Some(b':') => self.at += 1,
            Some(b'=') => self.report_missing_colon(name_span),
            Some(byte) if same_line && lower && !literal && self.begins_field_value(byte, end, in_struct) => {
                self.report_missing_colon(name_span);
            }
            _ => {
                self.at = start;
                return None;
            }
        }
        Some((name.to_owned(), name_span))
    }

    fn begins_field_value(&self, byte: u8, end: usize, in_struct: bool) -> bool {
        match byte {
            b'"' | b'[' | b'{' | b'0'..=b'9' => true,
            b'(' => in_struct && self.at > end,
            _ => false,
        }
    }

    /// Reports that a colon is missing here, and takes an equals sign for one.
    fn report_missing_colon(&mut self, name: Span) {
        let here = self.at;
        let message = format!("a colon is missing between `{}` and {}", self.source.slice(name), self.token(here));
        let error = self.error(MISSING_COLON, here, self.token_end(here), message);
        if self.byte() == Some(b'=') {
            self.at += 1;
            self.report(error.suggest("write `:` instead of `=`"));
        } else {
            self.report(error);
        }
    }

    /// Reads the value of a field whose name is not a plain one, after its colon.
    fn quoted_field(&mut self, item: usize, name: &Node) -> Option<Field> {
        match &name.value {
            Value::Text(text) => {
                let suggestion = format!("write `{}: …`, or `{{ … }}` for a map", shortened(text));
                self.hold(item, name.span, "a field name has no quotes", Some(&suggestion));
            }
            _ => self.hold(item, name.span, "this is not a field name", Some("maps are written `{ … }`")),
        }
        self.skip_space();
        let value = self.value()?;
        Some(Field { name: self.source.slice(name.span).to_owned(), name_span: name.span, value })
    }

    /// Reports an item of a list that turns out to be the key of an entry, and reads on after it.
    fn refuse_entry(&mut self, item: usize) -> Option<()> {
        self.skip_space();
        if self.byte() == Some(b':') {
            let suggestion = "maps are written `{ key: value }`, structs `(name: value)`";
            let key = span(item, self.token_end(item));
            self.hold(item, key, "a list cannot hold an entry `key: value`", Some(suggestion));
            self.at += 1;
            self.skip_space();
            self.value()?;
        }
        Some(())
    }

    /// Reports a mistake in the items of a bracket that is not a syntax error.
    pub fn report_duplicate(&mut self, code: Code, second: Span, first: Span, message: String) {
        let diagnostic = Diagnostic::error(code, self.source.place(second), message);
        self.out.push(diagnostic.relate(self.source.place(first), "first here"));
    }
}
