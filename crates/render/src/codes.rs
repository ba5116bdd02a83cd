//! Every class of mistake that this crate reports.

use tyndall_document::codes;

codes! {
    /// Every class of mistake that this crate reports and none below it.
    CODES:
    /// The graph reads a scene, and none is given.
    NO_SCENE = "no-scene";
    /// A pass would be wrong in this scene.
    REFUSED = "scene-refused";
    /// A switch is on whose work needs an optional input that nothing feeds.
    INPUT_NEEDED = "input-needed";
    /// The scene has something that a pass does not do justice to.
    LIMIT = "limit";
    /// A driver ended loops of a pass before they were done.
    UNFINISHED = "unfinished";
}
