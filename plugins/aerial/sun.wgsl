// L_in of every directional light, per pixel: see air.wgsl.
#import scene
#import ray
#import light_sum
#import "air.wgsl"

var<uniform> camera: Camera;
var<uniform> air: Air;
var depth: texture_2d<f32>;
var inscattering: texture_storage_2d<rgba32float, write>;

struct Receiver {
    direction: vec3<f32>,       // of the ray
}

fn received(light: Light, index: u32, receiver: Receiver) -> vec3<f32> {
    return source_of_sun(air, light, receiver.direction);
}

@compute @workgroup_size(8, 8)
fn main(@builtin(global_invocation_id) id: vec3<u32>) {
    let size = textureDimensions(inscattering);
    let direction = ray_of_pixel(camera, id.xy, size).direction;
    let s = way_in_air(air, direction, textureLoad(depth, id.xy, 0).x);
    let source = received_of_all(Receiver(direction));
    if all(id.xy < size) {
        textureStore(inscattering, id.xy, vec4<f32>(in_scattering(air, source, s), 1.0));
    }
}
