//! The classes of mistakes that this crate reports.

use crate::Code;

macro_rules! codes {
    ($($(#[$doc:meta])* $name:ident = $text:literal;)*) => {
        $($(#[$doc])* pub const $name: Code = Code($text);)*
        /// Every code of this crate.
        pub const CODES: &[Code] = &[$($name),*];
    };
}

codes! {
    /// There is no such file.
    MISSING_FILE = "missing-file";
    /// A file is a folder, is not UTF-8, is too large, or may not be read.
    UNREADABLE_FILE = "unreadable-file";
    /// A bracket is not closed, or closed by another kind.
    UNCLOSED_BRACKET = "unclosed-bracket";
    /// A closing bracket closes nothing.
    UNOPENED_BRACKET = "unopened-bracket";
    /// Two items without a comma between them.
    MISSING_COMMA = "missing-comma";
    /// A name or a key without a colon behind it.
    MISSING_COLON = "missing-colon";
    /// Nothing where a value belongs.
    MISSING_VALUE = "missing-value";
    /// A character that begins nothing.
    UNEXPECTED_CHARACTER = "unexpected-character";
    /// `name: value` among plain values, or a plain value among `name: value`.
    MISPLACED_ENTRY = "misplaced-entry";
    /// A string without its closing quote.
    UNTERMINATED_STRING = "unterminated-string";
    /// A block comment without its end.
    UNTERMINATED_COMMENT = "unterminated-comment";
    /// A backslash in a string that is followed by nothing known.
    BAD_ESCAPE = "bad-escape";
    /// A character literal that does not hold one character.
    BAD_CHARACTER = "bad-character";
    /// Something that begins like a number and is none.
    BAD_NUMBER = "bad-number";
    /// A `#![…]` line that is not understood.
    BAD_ATTRIBUTE = "bad-attribute";
    /// RON that has no meaning in our files: byte strings, ranges, some extensions.
    UNSUPPORTED_SYNTAX = "unsupported-syntax";
    /// Brackets within brackets beyond the limit.
    TOO_DEEP = "too-deep";
    /// More text behind the value.
    TRAILING_TEXT = "trailing-text";
    /// So many syntax errors that the rest is not worth reading.
    TOO_MANY_ERRORS = "too-many-errors";
    /// A field or a key that stands twice.
    DUPLICATE_NAME = "duplicate-name";
    /// A value of another type than the place demands.
    WRONG_TYPE = "wrong-type";
    /// A number that is infinite or not a number.
    NOT_FINITE = "not-finite";
    /// A field that is not known there.
    UNKNOWN_FIELD = "unknown-field";
    /// A field without which nothing can be made of the rest.
    MISSING_FIELD = "missing-field";
    /// A variant that is not known there.
    UNKNOWN_VARIANT = "unknown-variant";
}
