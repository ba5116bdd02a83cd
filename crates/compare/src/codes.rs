//! The classes of mistakes in comparison files; each has a fixture in `tests/fixtures`.

use tyndall_document::codes;

codes! {
    /// Every class of mistake that this crate reports and none below it.
    CODES:
    /// There are no scenes, or no methods.
    NOTHING_TO_COMPARE = "nothing-to-compare";
    /// The program cannot compute the truth of an output.
    NO_TRUTH = "no-truth";
    /// The output of a method's graph is not a picture of the compared size.
    WRONG_PICTURE = "wrong-picture";
    /// A method changes the scene, which the truth depends on.
    SCENE_OF_METHOD = "scene-of-method";
}
