// F_ex L_0, per pixel: see air.wgsl.
//
// L_0 is linear in the light of the sun, so what the air takes of sunlight on its way to the ground is taken here, where
// the lit surface comes in: of several suns the mean, weighted by their irradiance.
#import scene
#import ray
#import "air.wgsl"

var<uniform> camera: Camera;
var<storage, read> lights: Lights;
var<uniform> air: Air;
var depth: texture_2d<f32>;
var surface: texture_2d<f32>;
var attenuated: texture_storage_2d<rgba32float, write>;

@compute @workgroup_size(8, 8)
fn main(@builtin(global_invocation_id) id: vec3<u32>) {
    let size = textureDimensions(attenuated);
    let count = lights.count;
    let direction = ray_of_pixel(camera, id.xy, size).direction;
    let s = way_in_air(air, direction, textureLoad(depth, id.xy, 0).x);
    var above = vec3<f32>(0.0);
    var below = vec3<f32>(0.0);
    var i = 0u;
    loop {
        let light = lights.items[i];
        let irradiance = select(vec3<f32>(0.0), light.intensity, light.kind == DIRECTIONAL);
        above += irradiance;
        below += irradiance * sunlight(air, light);
        i++;
        if i >= count { break; }
    }
    let left = select(vec3<f32>(1.0), below / max(above, vec3<f32>(1e-30)), above > vec3<f32>(0.0));
    let light = textureLoad(surface, id.xy, 0).rgb;
    if all(id.xy < size) {
        textureStore(attenuated, id.xy, vec4<f32>(light * left * extinction_factor(air, s), 1.0));
    }
}
