// The whole picture from its terms.
//
// T        transmittance of the medium along the ray, to the surface or to infinity
// J        what the medium sends toward the eye that comes from no light of the scene (see Ambient)
//
//   radiance = airlight + surface + T background, where the ray meets nothing, + (1 - T) J
// (Biri, Arques and Michelin 2006, eq. 1, in which the ambient term reads L_a e^(-k_t d): that would fade with the fog)
#import scene
#import ray
#import medium

var<uniform> camera: Camera;
var<uniform> medium: Medium;
var<uniform> height_fog: HeightFog;
var<uniform> ambient: Ambient;
var<uniform> background: Background;
var surface: texture_2d<f32>;
var airlight: texture_2d<f32>;
var depth: texture_2d<f32>;
var radiance: texture_storage_2d<rgba32float, write>;

@compute @workgroup_size(8, 8)
fn main(@builtin(global_invocation_id) id: vec3<u32>) {
    let size = textureDimensions(radiance);
    if any(id.xy >= size) {
        return;
    }
    var sum = textureLoad(airlight, id.xy, 0).rgb + textureLoad(surface, id.xy, 0).rgb;
    let way = textureLoad(depth, id.xy, 0).r;
    let ray = ray_of_pixel(camera, id.xy, size);
    let effective = effective_way(height_fog, ray.origin.y, ray.direction.y, way);
    if way >= ENDLESS {
        sum += transmittance(medium, effective) * background.radiance;
    }
    sum += opacity(medium, effective) * ambient.radiance;
    textureStore(radiance, id.xy, vec4(sum, 1.0));
}
