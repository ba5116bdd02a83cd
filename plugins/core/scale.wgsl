// input * factor
struct Params {
    factor: vec3<f32>,
}

var<uniform> params: Params;
var input: texture_2d<f32>;
var scaled: texture_storage_2d<rgba32float, write>;

@compute @workgroup_size(8, 8)
fn main(@builtin(global_invocation_id) id: vec3<u32>) {
    if any(id.xy >= textureDimensions(scaled)) {
        return;
    }
    textureStore(scaled, id.xy, vec4(textureLoad(input, id.xy, 0).rgb * params.factor, 1.0));
}
