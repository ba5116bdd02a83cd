//! The classes of mistakes that this crate reports, and how every crate declares its own.

/// Declares the classes of mistakes of a crate as constants of the type [`Code`](crate::Code), and a list of them all.
/// A class without documentation does not compile.
///
/// ```
/// tyndall_document::codes! {
///     /// Every class of mistake that this crate reports.
///     CODES:
///     /// A lamp is switched off.
///     DARK = "dark";
/// }
/// assert_eq!(CODES, [DARK]);
/// ```
#[macro_export]
macro_rules! codes {
    ($(#[doc = $about:literal])+ $list:ident: $($(#[doc = $doc:literal])+ $name:ident = $text:literal;)+) => {
        $($(#[doc = $doc])+ pub const $name: $crate::Code = $crate::Code($text);)+

        $(#[doc = $about])+
        pub const $list: &[$crate::Code] = &[$($name),+];
    };
}

codes! {
    /// Every class of mistake that this crate reports.
    CODES:
    /// There is no such file.
    MISSING_FILE = "missing-file";
    /// What should be a file is a folder, is not UTF-8, is too large, or may not be read.
    UNREADABLE_FILE = "unreadable-file";
    /// A bracket is not closed, or is closed by one of another kind.
    UNCLOSED_BRACKET = "unclosed-bracket";
    /// A closing bracket closes nothing.
    UNOPENED_BRACKET = "unopened-bracket";
    /// Two items without a comma between them.
    MISSING_COMMA = "missing-comma";
    /// A name or a key without a colon after it.
    MISSING_COLON = "missing-colon";
    /// Nothing where a value belongs.
    MISSING_VALUE = "missing-value";
    /// A character that cannot begin anything.
    UNEXPECTED_CHARACTER = "unexpected-character";
    /// `name: value` among plain values, or a plain value among `name: value`.
    MISPLACED_ENTRY = "misplaced-entry";
    /// A string without its closing quote.
    UNTERMINATED_STRING = "unterminated-string";
    /// A block comment without its end.
    UNTERMINATED_COMMENT = "unterminated-comment";
    /// A backslash in a string that does not begin a known escape sequence.
    BAD_ESCAPE = "bad-escape";
    /// A character literal that does not hold one character.
    BAD_CHARACTER = "bad-character";
    /// Something that begins like a number but is not one.
    BAD_NUMBER = "bad-number";
    /// A `#![…]` line that is not supported.
    BAD_ATTRIBUTE = "bad-attribute";
    /// RON that has no meaning in our files: byte strings, ranges, some extensions.
    UNSUPPORTED_SYNTAX = "unsupported-syntax";
    /// Brackets nested more deeply than the limit allows.
    TOO_DEEP = "too-deep";
    /// More text after the value.
    TRAILING_TEXT = "trailing-text";
    /// So many syntax errors that the rest is not worth reading.
    TOO_MANY_ERRORS = "too-many-errors";
    /// A field or a key that appears twice.
    DUPLICATE_NAME = "duplicate-name";
    /// A value of the wrong type.
    WRONG_TYPE = "wrong-type";
    /// A number that is infinite or not a number.
    NOT_FINITE = "not-finite";
    /// A field that does not exist there.
    UNKNOWN_FIELD = "unknown-field";
    /// A required field that is not given.
    MISSING_FIELD = "missing-field";
    /// A variant that does not exist there.
    UNKNOWN_VARIANT = "unknown-variant";
    /// A name that does not match `[a-z][a-z0-9_]*`.
    BAD_NAME = "bad-name";
    /// A version of a file's format that does not exist, or one that is not of the form that a version has.
    BAD_VERSION = "bad-version";
    /// A version of a file's format that this program does not know yet.
    NEWER_VERSION = "newer-version";
}

codes! {
    /// Classes of mistakes that several crates report and this one does not. The fixtures are theirs.
    SHARED_CODES:
    /// A size that is 0, too large, or not of the form that a size has.
    BAD_SIZE = "bad-size";
    /// A number outside the range that it has there.
    OUT_OF_RANGE = "out-of-range";
}
