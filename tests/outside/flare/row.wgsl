// The steps of a flare, one to a pixel.
struct Step {
    color: vec3<f32>,           // W/(sr m^2)
    share: f32,
}

struct Steps {
    count: u32,
    pad0: u32,
    pad1: u32,
    pad2: u32,
    items: array<Step>,
}

var<storage, read> flare_steps: Steps;
var radiance: texture_storage_2d<rgba32float, write>;

@compute @workgroup_size(8, 8)
fn main(@builtin(global_invocation_id) id: vec3<u32>) {
    if all(id.xy < textureDimensions(radiance)) {
        let step = flare_steps.items[min(id.x, flare_steps.count - 1u)];
        textureStore(radiance, id.xy, vec4<f32>(step.color * step.share, 1.0));
    }
}
