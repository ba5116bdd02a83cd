// The whole picture: L_in + F_ex L_0, and behind the air, where a ray meets nothing, F_ex times the background.
#import scene
#import ray
#import "air.wgsl"

var<uniform> camera: Camera;
var<uniform> background: Background;
var<uniform> air: Air;
var depth: texture_2d<f32>;
var inscattering: texture_2d<f32>;
var surface: texture_2d<f32>;
var radiance: texture_storage_2d<rgba32float, write>;

@compute @workgroup_size(8, 8)
fn main(@builtin(global_invocation_id) id: vec3<u32>) {
    let size = textureDimensions(radiance);
    let direction = ray_of_pixel(camera, id.xy, size).direction;
    let way = textureLoad(depth, id.xy, 0).x;
    let behind = background.radiance * extinction_factor(air, way_in_air(air, direction, way));
    let sum = textureLoad(inscattering, id.xy, 0).rgb + textureLoad(surface, id.xy, 0).rgb;
    if all(id.xy < size) {
        textureStore(radiance, id.xy, vec4<f32>(sum + select(vec3<f32>(0.0), behind, way >= ENDLESS), 1.0));
    }
}
