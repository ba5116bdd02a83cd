//! Codes of the mistakes that this layer reports.

use tyndall_document::Code;

/// Two plugins on one search path have the same name.
pub const DUPLICATE_PLUGIN: Code = Code("duplicate-plugin");
/// A name that cannot be one.
pub const BAD_PLUGIN_NAME: Code = Code("bad-plugin-name");
/// A version that is not `MAJOR.MINOR.PATCH`.
pub const BAD_VERSION: Code = Code("bad-version");
/// A manifest names a shader that is not in its folder.
pub const MISSING_SHADER: Code = Code("missing-shader");
/// A manifest says something of a port that the shader contradicts, or leaves open what must be said.
pub const BAD_PORT: Code = Code("bad-port");
/// A manifest says something of a parameter that the shader contradicts, or leaves open what must be said.
pub const BAD_PARAM: Code = Code("bad-param");
/// A size that is none.
pub const BAD_SIZE: Code = Code("bad-size");
/// A descriptor that contradicts itself.
pub const BAD_DESCRIPTOR: Code = Code("bad-descriptor");
/// A plugin folder or a search path that cannot be read.
pub const UNREADABLE_PLUGIN: Code = Code("unreadable-plugin");

/// All of them.
pub const CODES: &[Code] = &[
    DUPLICATE_PLUGIN,
    BAD_PLUGIN_NAME,
    BAD_VERSION,
    MISSING_SHADER,
    BAD_PORT,
    BAD_PARAM,
    BAD_SIZE,
    BAD_DESCRIPTOR,
    UNREADABLE_PLUGIN,
];
