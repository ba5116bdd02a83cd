//! The keys and forms of `plugin.ron`, each said once: the reader accepts these and no others, and a test holds
//! `docs/plugin.md` to them.

/// Of a plugin.
pub const PLUGIN: &[&str] = &["name", "version", "about", "passes"];

/// Of a pass.
pub const PASS: &[&str] = &["about", "source", "shader", "dispatch", "limits", "refuses", "ports", "params", "presets"];

/// Of a port.
pub const PORT: &[&str] = &["about", "unit", "class", "size", "optional", "history", "disabled", "unordered"];

/// Of a parameter.
pub const PARAM: &[&str] = &["about", "unit", "default", "range", "choices", "needs"];

/// Of a preset.
pub const PRESET: &[&str] = &["about", "values"];

/// Values of `class`.
pub const CLASS: &[&str] = &["Color", "Scalar", "Vector", "Display", "Data", "RasterDepth", "Any"];

/// Forms of `size`.
pub const SIZE: &[&str] = &["Same", "Scaled", "Frame", "Fixed", "Params", "FramePixels"];

/// Forms of `disabled`.
pub const DISABLED: &[&str] = &["Input", "Constant"];
