// The whole picture from its terms.
//
// sigma_t  extinction, 1/m, per channel
// T        transmittance of the medium along the ray to infinity: 1 where sigma_t = 0, else 0
#import scene

var<uniform> medium: Medium;
var<uniform> background: Background;
var surface: texture_2d<f32>;
var airlight: texture_2d<f32>;
var depth: texture_2d<f32>;
var radiance: texture_storage_2d<rgba32float, write>;

// Larger than every distance that a surface can have.
const FARTHEST = 3e38;

@compute @workgroup_size(8, 8)
fn main(@builtin(global_invocation_id) id: vec3<u32>) {
    let size = textureDimensions(radiance);
    if any(id.xy >= size) {
        return;
    }
    var sum = textureLoad(airlight, id.xy, 0).rgb + textureLoad(surface, id.xy, 0).rgb;
    if textureLoad(depth, id.xy, 0).r > FARTHEST {
        let transmittance = select(vec3(0.0), vec3(1.0), medium.extinction <= vec3(0.0));
        sum += transmittance * background.radiance;
    }
    textureStore(radiance, id.xy, vec4(sum, 1.0));
}
