// F_ex L_0, per pixel: see air.wgsl.
//
// L_0 is linear in the light of the sun, so what the air takes of sunlight on its way to the ground is taken here, where
// the lit surface comes in: of several suns the mean, weighted by their irradiance.
#import scene
#import ray
#import every_light
#import "air.wgsl"

var<uniform> camera: Camera;
var<uniform> air: Air;
var depth: texture_2d<f32>;
var surface: texture_2d<f32>;
var attenuated: texture_storage_2d<rgba32float, write>;

struct Gathered {
    light: u32,
    above: vec3<f32>,           // irradiance of the suns above the air, W/m^2
    below: vec3<f32>,           // and on the ground
}

fn gather(before: Gathered, light: Light) -> Gathered {
    let irradiance = select(vec3<f32>(0.0), light.intensity, light.kind == DIRECTIONAL);
    return Gathered(before.light + 1u, before.above + irradiance, before.below + irradiance * sunlight(air, light));
}

@compute @workgroup_size(8, 8)
fn main(@builtin(global_invocation_id) id: vec3<u32>) {
    let size = textureDimensions(attenuated);
    let direction = ray_of_pixel(camera, id.xy, size).direction;
    let s = way_in_air(air, direction, textureLoad(depth, id.xy, 0).x);
    let suns = gather_lights(Gathered(0u, vec3<f32>(0.0), vec3<f32>(0.0)));
    let left = select(vec3<f32>(1.0), suns.below / max(suns.above, vec3<f32>(1e-30)), suns.above > vec3<f32>(0.0));
    let light = textureLoad(surface, id.xy, 0).rgb;
    if all(id.xy < size) {
        textureStore(attenuated, id.xy, vec4<f32>(light * left * extinction_factor(air, s), 1.0));
    }
}
