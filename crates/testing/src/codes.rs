//! Every class of mistake of a test file that this crate reports; each has a fixture in `tests/fixtures`.

use tyndall_document::codes;

codes! {
    /// Every class of mistake that this crate reports and none below it.
    CODES:
    /// `frames` is not a list of ascending frame numbers.
    BAD_FRAMES = "bad-frames";
    /// The file looks at nothing.
    NO_TAPS = "no-taps";
    /// A text is not a pattern of `pass.port`.
    BAD_PATTERN = "bad-pattern";
    /// A tap says nothing about the ports that it looks at.
    EMPTY_TAP = "empty-tap";
    /// A pattern matches no port of the graph.
    EMPTY_PATTERN = "empty-pattern";
    /// A pattern matches only ports of passes that are switched off.
    TAP_OFF = "tap-off";
    /// A tolerance is invalid, or looser than allowed.
    BAD_TOLERANCE = "bad-tolerance";
    /// A tolerance is loose and nothing says why, or a text that should say something is blank.
    MISSING_REASON = "missing-reason";
    /// An unknown class of adapters.
    UNKNOWN_ADAPTER_CLASS = "unknown-adapter-class";
    /// A check does not fit what the port holds.
    WRONG_CHECK = "wrong-check";
    /// A check holds whatever comes out.
    VACUOUS_CHECK = "vacuous-check";
    /// A check names a port that the graph does not have.
    UNKNOWN_TAP = "unknown-tap";
    /// A pass has no reference on the CPU.
    NO_REFERENCE = "no-reference";
    /// A relation compares nothing.
    EMPTY_RELATION = "empty-relation";
}
