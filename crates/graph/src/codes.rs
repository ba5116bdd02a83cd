//! Every class of mistake that this crate reports; each has a fixture in `tests/fixtures`.

use tyndall_document::codes;

codes! {
    /// Every class of mistake that this crate reports and none below it.
    CODES:
    /// A file whose picture sets the size of a port does not hold a picture.
    BAD_PICTURE = "bad-picture";
    /// The graph has no outputs.
    NO_OUTPUTS = "no-outputs";
    /// `use` names a pass that does not exist.
    UNKNOWN_PASS = "unknown-pass";
    /// A pass of this kind has no port of this name.
    UNKNOWN_PORT = "unknown-port";
    /// A pass of this kind has no parameter of this name, or the graph has none.
    UNKNOWN_PARAMETER = "unknown-parameter";
    /// `pass.port` names a pass that the graph does not have.
    UNKNOWN_REFERENCE = "unknown-reference";
    /// A text that is not of the form `pass.port`.
    BAD_REFERENCE = "bad-reference";
    /// An input is used as if it could be read.
    NOT_AN_OUTPUT = "not-an-output";
    /// An output is used as if it could be connected to a port.
    NOT_AN_INPUT = "not-an-input";
    /// A required input is not connected.
    MISSING_INPUT = "missing-input";
    /// A texture is connected to a buffer, or the like.
    WRONG_KIND = "wrong-kind";
    /// A texture of another dimension is connected.
    WRONG_DIMENSION = "wrong-dimension";
    /// A texture is connected whose channels have another meaning.
    WRONG_CLASS = "wrong-class";
    /// A texture of another format is connected.
    WRONG_FORMAT = "wrong-format";
    /// A buffer or value with elements of another type is connected.
    WRONG_ELEMENT = "wrong-element";
    /// The units of both ends of a connection differ.
    WRONG_UNIT = "wrong-unit";
    /// A port has another size than its reader demands.
    WRONG_SIZE = "wrong-size";
    /// Passes wait for each other.
    CYCLE = "cycle";
    /// A word is not one of the choices.
    UNKNOWN_CHOICE = "unknown-choice";
    /// `$name` names a parameter that the graph does not have.
    UNKNOWN_NAME = "unknown-name";
    /// `$name` names a parameter whose type does not fit.
    WRONG_REFERENCE_TYPE = "wrong-reference-type";
    /// A parameter that sets a size changes from frame to frame.
    LIVE_SIZE = "live-size";
    /// Nothing uses a parameter of the graph.
    UNUSED_PARAMETER = "unused-parameter";
    /// The graph has no output of this name.
    UNKNOWN_OUTPUT = "unknown-output";
    /// A command-line argument is not of the form that it must have.
    BAD_ARGUMENT = "bad-argument";
}
