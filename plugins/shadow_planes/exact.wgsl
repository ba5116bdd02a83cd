// Airlight of every light of the scene where the light reaches: see shaders/shadows.wgsl and shaders/airlight.wgsl.
#import scene
#import ray
#import airlight
#import lights
#import shadows
#import unfinished
#import "few_nodes.wgsl"

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
    // the sum before the light; and with it as if it had no shadow, once its lit parts are summed
    var before = vec3<f32>(0.0);
    var unshadowed = vec3<f32>(0.0);
    var bounds = false;
    var partly = false;
    loop {
        if whole && !bounds {
            found = next_lit_part(shadow, found.walk);
        }
        let part = select(found.part, vec2<f32>(0.0, shadow.way), bounds);
        let piece = airlight_of_part(cursor, lights.items[light], medium, phase, ray, part, shadow.way, nodes);
        sum += select(piece.radiance, vec3<f32>(0.0), bounds);
        unshadowed += select(vec3<f32>(0.0), piece.radiance, bounds);
        cursor = piece.next;
        whole = cursor.light > light;
        partly = partly || (part.x < part.y && (part.x > 0.0 || part.y < shadow.way));
        if whole {
            let at_end = found.walk.x >= shadow.way;
            if at_end && found.walk.depth <= 0 && !bounds {
                lit_bits += bit_of_light(light);
            }
            // nodes err: the sum over parts may come to more than that over the ray
            sum = select(sum, min(sum, unshadowed), bounds);
            bounds = at_end && partly && !bounds;
            let done = at_end && !bounds;
            light += select(0u, 1u, done);
            cursor = Cursor(light, 0u, 0.0);
            before = select(before, sum, done);
            unshadowed = before;
            partly = partly && !done;
            if done {
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
