// Airlight of every light of the scene where the light reaches: see shaders/shadows.wgsl and shaders/airlight.wgsl.
#import scene
#import ray
#import airlight
#import lights
#import shadows
#import unfinished
#import "few_nodes.wgsl"
#import "bound.wgsl"

override nodes: u32 = 12;

var<uniform> camera: Camera;
var<uniform> medium: Medium;
var<uniform> phase: Phase;
var<storage, read> lights: Lights;
var depth: texture_2d<f32>;
var radiance: texture_storage_2d<rgba32float, write>;
var lit: texture_storage_2d<rgba32float, write>;

@compute @workgroup_size(8, 8)
fn main(@builtin(global_invocation_id) id: vec3<u32>) {
    let size = textureDimensions(radiance);
    let count = lights.count;
    let ray = ray_of_pixel(camera, id.xy, size);
    let way = textureLoad(depth, id.xy, 0).x;
    var sum = vec3<f32>(0.0);
    var lit_bits = vec4<f32>(0.0);
    // a list without lights holds one of intensity 0; why the test stands at the end: see shaders/airlight.wgsl
    var light = 0u;
    var shadow = shadow_ray(shadow_lights.items[0], ray, way);
    var found = LitPart(vec2<f32>(0.0), start_of_walk(shadow_lights.items[0], shadow), false);
    var cursor = Cursor(0u, 0u, 0.0);
    var whole = true;
    var bound = unbounded(sum);
    loop {
        if whole && bound.stage == LIT {
            found = next_lit_part(shadow, found.walk);
            bound = with_dark_before(bound, found.part);
        }
        let part = part_of_stage(bound, found.part, shadow.way);
        let piece = airlight_of_part(cursor, lights.items[light], medium, phase, ray, part, shadow.way, nodes, bound.stage == DARK);
        sum += select(vec3<f32>(0.0), piece.radiance, bound.stage == LIT);
        bound.sum += select(piece.radiance, vec3<f32>(0.0), bound.stage == LIT);
        cursor = piece.next;
        whole = cursor.light > light;
        if whole {
            let at_end = found.walk.x >= shadow.way;
            if at_end && found.walk.depth <= 0 && bound.stage == LIT {
                lit_bits += bit_of_light(light);
            }
            sum = select(sum, min(sum, bound.sum), bound.stage == WHOLE);
            bound = next_stage(bound, sum, at_end, nodes);
            let done = at_end && bound.stage == LIT;
            light += select(0u, 1u, done);
            cursor = Cursor(light, 0u, 0.0);
            if done {
                bound = unbounded(sum);
                shadow = shadow_ray(shadow_lights.items[light], ray, way);
                found.walk = start_of_walk(shadow_lights.items[light], shadow);
            }
        }
        if light >= count { break; }
    }
    // no early return above: outside of branches software Vulkan reads the scene's data once for all threads
    if all(id.xy < size) {
        textureStore(radiance, id.xy, vec4<f32>(sum, 1.0));
        textureStore(lit, id.xy, lit_bits);
        if light < count || stopped {
            tell_unfinished();
        }
    }
}
