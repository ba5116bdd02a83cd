//! Codes of the mistakes that this crate reports.

use tyndall_document::codes;

codes! {
    /// Every class of mistake that this crate reports and none below it.
    CODES:
    /// Text that is not WGSL.
    SYNTAX = "shader-syntax";
    /// WGSL that parses but is not valid.
    INVALID = "shader-invalid";
    /// An `#import` that names nothing, or is malformed.
    IMPORT = "shader-import";
    /// Modules that import each other in a circle.
    IMPORT_CYCLE = "shader-import-cycle";
    /// A written `@group` or `@binding`.
    BINDING = "shader-binding";
    /// No entry point, one in an imported module, or one whose size is not known.
    ENTRY = "shader-entry";
    /// A variable of a kind that a pass cannot bind.
    VARIABLE = "shader-variable";
    /// A port and its variable disagree, or one of them is missing.
    PORT = "shader-port";
    /// A parameter and its member or `override` disagree, or one of them is missing.
    PARAM = "shader-param";
    /// Scene data that is read but not declared, or declared but not read.
    SCENE = "shader-scene";
    /// A variable or parameter that no entry point uses.
    UNUSED = "shader-unused";
    /// naga itself failed on the text.
    INTERNAL = "shader-internal";
}
