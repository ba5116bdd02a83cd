// A picture at another size.
//
// Where it shrinks along an axis, a target texel is the mean of the source over its footprint (box filter, texels cut by
// the footprint's edge weighted by the part inside), so the picture's mean stays. Where it grows, values are linear
// between the centres of source texels.
struct Params {
    width: u32,
    height: u32,
}

var<uniform> params: Params;
var input: texture_2d<f32>;
var resized: texture_storage_2d<rgba32float, write>;

// Weight of source texel `at` for target texel `target_at`, along one axis.
struct Footprint {
    first: i32,
    last: i32,
    start: f32,
    end: f32,
    shrinks: bool,
}

fn footprint(at: u32, target_size: u32, source_size: u32) -> Footprint {
    let ratio = f32(source_size) / f32(target_size);
    if ratio > 1.0 {
        let start = f32(at) * ratio;
        let end = min(f32(at + 1u) * ratio, f32(source_size));
        return Footprint(i32(floor(start)), i32(ceil(end)) - 1, start, end, true);
    }
    let centre = (f32(at) + 0.5) * ratio - 0.5;
    let first = i32(floor(centre));
    return Footprint(first, first + 1, centre, centre, false);
}

fn weight(f: Footprint, texel: i32) -> f32 {
    if f.shrinks {
        return max(min(f.end, f32(texel + 1)) - max(f.start, f32(texel)), 0.0);
    }
    return max(1.0 - abs(f32(texel) - f.start), 0.0);
}

@compute @workgroup_size(8, 8)
fn main(@builtin(global_invocation_id) id: vec3<u32>) {
    if id.x >= params.width || id.y >= params.height {
        return;
    }
    let source = textureDimensions(input);
    let limit = vec2<i32>(source) - 1;
    let across = footprint(id.x, params.width, source.x);
    let down = footprint(id.y, params.height, source.y);
    var sum = vec3(0.0);
    var total = 0.0;
    for (var y = down.first; y <= down.last; y++) {
        for (var x = across.first; x <= across.last; x++) {
            let part = weight(across, x) * weight(down, y);
            sum += part * textureLoad(input, clamp(vec2(x, y), vec2(0), limit), 0).rgb;
            total += part;
        }
    }
    textureStore(resized, id.xy, vec4(sum / max(total, 1e-20), 1.0));
}
