//! Codes of the mistakes that this layer reports.

use tyndall_document::codes;

codes! {
    /// Every class of mistake that this crate reports and none below it.
    CODES:
    /// Two plugins on one search path have the same name.
    DUPLICATE_PLUGIN = "duplicate-plugin";
    /// A name that cannot be one.
    BAD_PLUGIN_NAME = "bad-plugin-name";
    /// A manifest names a shader that is not in its folder.
    MISSING_SHADER = "missing-shader";
    /// A manifest says something of a port that the shader contradicts, or leaves open what must be said.
    BAD_PORT = "bad-port";
    /// A manifest says something of a parameter that the shader contradicts, or leaves open what must be said.
    BAD_PARAM = "bad-param";
    /// A variable of scene data whose type is laid out in another way than the data.
    SCENE_LAYOUT = "scene-layout";
    /// Two plugins add the same thing to scenes.
    SCENE_CLASH = "scene-clash";
    /// A descriptor that contradicts itself.
    BAD_DESCRIPTOR = "bad-descriptor";
    /// A plugin folder or a search path that cannot be read.
    UNREADABLE_PLUGIN = "unreadable-plugin";
}
