// L_in of every directional light, per pixel: see air.wgsl.
#import scene
#import ray
#import "air.wgsl"

var<uniform> camera: Camera;
var<storage, read> lights: Lights;
var<uniform> air: Air;
var depth: texture_2d<f32>;
var inscattering: texture_storage_2d<rgba32float, write>;

@compute @workgroup_size(8, 8)
fn main(@builtin(global_invocation_id) id: vec3<u32>) {
    let size = textureDimensions(inscattering);
    let count = lights.count;
    let direction = ray_of_pixel(camera, id.xy, size).direction;
    let s = way_in_air(air, direction, textureLoad(depth, id.xy, 0).x);
    var source = vec3<f32>(0.0);
    // a list without lights holds one of intensity 0; why the test stands at the end: see shaders/airlight.wgsl
    var i = 0u;
    loop {
        source += source_of_sun(air, lights.items[i], direction);
        i++;
        if i >= count { break; }
    }
    if all(id.xy < size) {
        textureStore(inscattering, id.xy, vec4<f32>(in_scattering(air, source, s), 1.0));
    }
}
