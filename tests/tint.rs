//! A plugin that is a folder with a manifest and WGSL.

/// The manifest of a plugin with one pass.
pub const MANIFEST: &str = r#"(
    name: "tint",
    version: "0.1.0",
    about: "Tints.",
    passes: {
        "invert": (
            about: "What is missing to a level.",
            shader: "invert.wgsl",
            ports: {
                "radiance": (about: "A picture"),
                "inverted": (about: "level - picture", size: Same("radiance"), disabled: Input("radiance")),
            },
            params: { "level": (about: "What is subtracted from", default: 1.0, range: (0.0, 10.0)) },
        ),
    },
)"#;

/// Its shader.
pub const SHADER: &str = "
struct Params { level: f32 }
var<uniform> params: Params;
var radiance: texture_2d<f32>;
var inverted: texture_storage_2d<rgba32float, write>;

@compute @workgroup_size(8, 8)
fn main(@builtin(global_invocation_id) id: vec3<u32>) {
    if any(id.xy >= textureDimensions(inverted)) {
        return;
    }
    let color = textureLoad(radiance, id.xy, 0).rgb;
    textureStore(inverted, id.xy, vec4(params.level - color, 1.0));
}
";

/// A graph that uses it.
pub const GRAPH: &str = r#"(
    version: 1,
    passes: {
        "grey": (use: "core.constant", params: { "value": (0.25, 0.5, 1.0) }),
        "tinted": (use: "tint.invert", inputs: { "radiance": "grey.color" }, params: { "level": 2.0 }),
    },
    outputs: { "radiance": "tinted.inverted" },
)"#;
