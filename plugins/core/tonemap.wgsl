// Radiance to what a screen shows.
#import colour

struct Params {
    exposure: f32,
    curve: u32, // 0 clip, 1 reinhard, 2 filmic
}

var<uniform> params: Params;
var radiance: texture_2d<f32>;
var color: texture_storage_2d<rgba8unorm, write>;

// Hable 2010, "Uncharted 2: HDR Lighting", slide 142: shoulder, linear part and toe in one rational function.
fn hable(x: vec3<f32>) -> vec3<f32> {
    return (x * (0.15 * x + 0.05) + 0.004) / (x * (0.15 * x + 0.50) + 0.06) - 0.02 / 0.30;
}

// The radiance that filmic maps to white, as in the source.
const FILMIC_WHITE = 11.2;

fn tone(x: vec3<f32>) -> vec3<f32> {
    switch params.curve {
        case 1u: {
            // Reinhard et al. 2002, eq. 3, per channel.
            return x / (1.0 + x);
        }
        case 2u: {
            // The factor 2 is the source's exposure bias.
            return hable(2.0 * x) / hable(vec3(FILMIC_WHITE));
        }
        default: {
            return x;
        }
    }
}

@compute @workgroup_size(8, 8)
fn main(@builtin(global_invocation_id) id: vec3<u32>) {
    let size = textureDimensions(color);
    if any(id.xy >= size) {
        return;
    }
    let exposed = max(textureLoad(radiance, id.xy, 0).rgb * params.exposure, vec3(0.0));
    // Beyond this every curve has reached white, and the rational ones would divide infinities.
    let shown = srgb_from_linear(tone(min(exposed, vec3(1e6))));
    textureStore(color, id.xy, vec4(shown, 1.0));
}
