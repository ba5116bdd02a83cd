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
    shadow: ShadowRay,
    found: LitPart,             // of the ray
    next: Cursor,               // in what is summed now: in that part, or what `bound` says
    whole: bool,                // all of it is summed
    bound: Bound,
}

// Before the first part of a light.
fn begun(before: Gathered, light: u32) -> Gathered {
    var after = before;
    after.light = light;
    after.shadow = shadow_ray(shadow_lights.items[light], before.ray, before.way);
    after.found = LitPart(vec2<f32>(0.0), start_of_walk(shadow_lights.items[light], after.shadow), false);
    after.next = Cursor(light, 0u, 0.0);
    after.whole = true;
    after.bound = unbounded(before.radiance);
    return after;
}

// Behind a part: what is summed next of this light, or the next one.
fn behind_part(before: Gathered) -> Gathered {
    var after = before;
    let stage = before.bound.stage;
    let at_end = before.found.walk.x >= before.shadow.way;
    if at_end && before.found.walk.depth <= 0 && stage == LIT {
        after.lit |= bit_of_light(before.light);
    }
    after.radiance = select(before.radiance, min(before.radiance, before.bound.sum), stage == WHOLE);
    after.bound = next_stage(before.bound, after.radiance, at_end, nodes);
    after.next = Cursor(before.light, 0u, 0.0);
    if at_end && after.bound.stage == LIT {
        after = begun(after, before.light + 1u);
    }
    return after;
}

fn gather(before: Gathered, light: Light) -> Gathered {
    var after = before;
    if before.whole && before.bound.stage == LIT {
        after.found = next_lit_part(before.shadow, before.found.walk);
        after.bound = with_dark_before(before.bound, after.found.part);
    }
    let stage = after.bound.stage;
    let part = part_of_stage(after.bound, after.found.part, before.shadow.way);
    let piece = airlight_of_part(before.next, light, medium, phase, before.ray, part, before.shadow.way, nodes, stage == DARK);
    after.radiance += select(vec3<f32>(0.0), piece.radiance, stage == LIT);
    after.bound.sum += select(piece.radiance, vec3<f32>(0.0), stage == LIT);
    after.next = piece.next;
    after.whole = piece.next.light > before.light;
    if after.whole {
        after = behind_part(after);
    }
    return after;
}

@compute @workgroup_size(8, 8)
fn main(@builtin(global_invocation_id) id: vec3<u32>) {
    let size = textureDimensions(radiance);
    var start = Gathered();
    start.ray = ray_of_pixel(camera, id.xy, size);
    start.way = textureLoad(depth, id.xy, 0).x;
    let gathered = gather_lights(begun(start, 0u));
    if all(id.xy < size) {
        textureStore(radiance, id.xy, vec4<f32>(gathered.radiance, 1.0));
        textureStore(lit, id.xy, gathered.lit);
        if lights_missed || stopped {
            tell_unfinished();
        }
    }
}
