// a + factor * b
struct Params {
    factor: f32,
}

var<uniform> params: Params;
var a: texture_2d<f32>;
var b: texture_2d<f32>;
var sum: texture_storage_2d<rgba32float, write>;

@compute @workgroup_size(8, 8)
fn main(@builtin(global_invocation_id) id: vec3<u32>) {
    if any(id.xy >= textureDimensions(sum)) {
        return;
    }
    let value = textureLoad(a, id.xy, 0).rgb + params.factor * textureLoad(b, id.xy, 0).rgb;
    textureStore(sum, id.xy, vec4(value, 1.0));
}
