// Airlight of every light of the scene where the light reaches: see shadows.wgsl and shaders/airlight.wgsl.
#import scene
#import ray
#import airlight
#import lights
#import every_light
#import unfinished
#import "shadows.wgsl"
#import "few_nodes.wgsl"
#import "bound.wgsl"

override nodes: u32 = 12;

var<uniform> camera: Camera;
var<uniform> medium: Medium;
var<uniform> phase: Phase;
var depth: texture_2d<f32>;
var radiance: texture_storage_2d<rgba32float, write>;
var lit: texture_storage_2d<rgba32uint, write>;

struct Gathered {
    light: u32,
    radiance: vec3<f32>,        // W/(sr m^2)
    lit: vec4<u32>,             // which lights reach the surface, see lights.wgsl
    ray: Ray,
    way: f32,
    is_new: bool,               // nothing of the light was looked at
    found: LitParts,            // of the ray
    part: u32,                  // the one that is summed now
    next: Cursor,               // in it, or in what `bound` says
    bound: Bound,
}

// With the next parts of the ray that the light reaches.
fn with_parts(before: Gathered) -> Gathered {
    let shadow_light = shadow_lights.items[before.light];
    let shadow = shadow_ray(shadow_light, before.ray, before.way);
    var after = before;
    if before.is_new {
        after.found.walk = start_of_walk(shadow_light, shadow);
        after.bound = unbounded(before.radiance);
    }
    after.found = next_lit_parts(shadow, after.found.walk);
    after.part = 0u;
    after.next = Cursor(before.light, 0u, 0.0);
    return after;
}

// Behind a part: what is summed next of this light.
fn behind_part(before: Gathered, part: vec2<f32>) -> Gathered {
    var after = before;
    let stage = before.bound.stage;
    let at_end = before.part + 1u >= before.found.count && before.found.walk.x >= min(before.way, BEYOND);
    if at_end && before.found.walk.depth <= 0 && stage == LIT {
        after.lit |= bit_of_light(before.light);
    }
    after.radiance = select(before.radiance, min(before.radiance, before.bound.sum), stage == WHOLE);
    if stage == LIT {
        after.bound = with_dark_before(before.bound, part);
    }
    after.bound = next_stage(after.bound, after.radiance, at_end, nodes);
    after.next = Cursor(before.light, 0u, 0.0);
    if after.bound.stage == LIT {
        after.part++;
        after.is_new = at_end;
    }
    return after;
}

// One piece more of the parts that were found.
fn summed(before: Gathered, light: Light) -> Gathered {
    var after = before;
    let stage = before.bound.stage;
    let lit = parts[min(before.part, PARTS - 1u)];
    let part = part_of_stage(before.bound, lit, before.way);
    let piece = airlight_of_part(before.next, light, medium, phase, before.ray, part, before.way, nodes, stage == DARK);
    after.radiance += select(vec3<f32>(0.0), piece.radiance, stage == LIT);
    after.bound.sum += select(piece.radiance, vec3<f32>(0.0), stage == LIT);
    after.next = piece.next;
    if piece.next.light > before.light {
        after = behind_part(after, lit);
    }
    return after;
}

// First the lit parts are found, and then summed: see `next_lit_parts`.
fn gather(before: Gathered, light: Light) -> Gathered {
    var after = with_parts(before);
    loop {
        after = summed(after, light);
        if after.part >= after.found.count { break; }
    }
    stopped = stopped || after.part < after.found.count;
    after.light += select(0u, 1u, after.is_new);
    return after;
}

@compute @workgroup_size(8, 8)
fn main(@builtin(global_invocation_id) id: vec3<u32>) {
    let size = textureDimensions(radiance);
    var start = Gathered();
    start.ray = ray_of_pixel(camera, id.xy, size);
    start.is_new = true;
    start.way = textureLoad(depth, id.xy, 0).x;
    let gathered = gather_lights(start);
    if all(id.xy < size) {
        textureStore(radiance, id.xy, vec4<f32>(gathered.radiance, 1.0));
        textureStore(lit, id.xy, gathered.lit);
        if lights_missed || stopped {
            tell_unfinished();
        }
    }
}
