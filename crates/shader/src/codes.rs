//! Codes of the mistakes that this crate reports.

use tyndall_document::Code;

/// Text that is not WGSL.
pub const SYNTAX: Code = Code("shader-syntax");
/// WGSL that parses and means nothing valid.
pub const INVALID: Code = Code("shader-invalid");
/// An `#import` that names nothing, or is malformed.
pub const IMPORT: Code = Code("shader-import");
/// Modules that import each other in a circle.
pub const IMPORT_CYCLE: Code = Code("shader-import-cycle");
/// A written `@group` or `@binding`.
pub const BINDING: Code = Code("shader-binding");
/// No entry point, one in an imported module, or one whose size is not known.
pub const ENTRY: Code = Code("shader-entry");
/// A variable that is nothing which a pass may bind.
pub const VARIABLE: Code = Code("shader-variable");
/// A port and its variable disagree, or one of them is missing.
pub const PORT: Code = Code("shader-port");
/// A parameter and its member or `override` disagree, or one of them is missing.
pub const PARAM: Code = Code("shader-param");
/// Scene data that is read and not declared, or declared and not read.
pub const SCENE: Code = Code("shader-scene");
/// A variable or parameter that no entry point uses.
pub const UNUSED: Code = Code("shader-unused");
/// naga itself failed on the text.
pub const INTERNAL: Code = Code("shader-internal");

/// Every code of this crate.
pub const CODES: &[Code] =
    &[SYNTAX, INVALID, IMPORT, IMPORT_CYCLE, BINDING, ENTRY, VARIABLE, PORT, PARAM, SCENE, UNUSED, INTERNAL];
