// One colour everywhere.
struct Params {
    value: vec3<f32>,
}

var<uniform> params: Params;
var color: texture_storage_2d<rgba32float, write>;

@compute @workgroup_size(8, 8)
fn main(@builtin(global_invocation_id) id: vec3<u32>) {
    if any(id.xy >= textureDimensions(color)) {
        return;
    }
    textureStore(color, id.xy, vec4(params.value, 1.0));
}
