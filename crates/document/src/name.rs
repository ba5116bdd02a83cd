//! The names that people give in documents: of plugins, passes, ports, parameters, presets and outputs.

use crate::{Code, Decoder, Diagnostic, Span};

/// What [`is_name`] demands, in words.
pub const NAME_RULE: &str = "a name consists of lower-case letters, digits and `_`, and begins with a letter";

/// Whether a text is a valid name: whether it matches `[a-z][a-z0-9_]*`.
pub fn is_name(text: &str) -> bool {
    let mut bytes = text.bytes();
    bytes.next().is_some_and(|first| first.is_ascii_lowercase())
        && bytes.all(|byte| byte.is_ascii_lowercase() || byte.is_ascii_digit() || byte == b'_')
}

impl Decoder<'_> {
    /// Whether the text at `span` is a valid name; if it is not, that is reported as `code`.
    pub fn check_name(&mut self, text: &str, span: Span, code: Code) -> bool {
        let valid = is_name(text);
        if !valid {
            let message = format!("{text:?} is not a valid name");
            self.report(Diagnostic::error(code, self.place(span), message).suggest(NAME_RULE));
        }
        valid
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_lower_case_and_begin_with_a_letter() {
        assert!(["a", "airlight", "mip_2", "a__"].into_iter().all(is_name));
        assert!(!["", "_a", "2nd", "Glow", "fög", "a-b", "a.b", "a b"].into_iter().any(is_name));
    }
}
