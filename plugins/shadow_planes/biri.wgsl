// Airlight by shadow planes drawn back to front over one another, with a stencil: Biri, Arques and Michelin 2006, section IV.
//
// A shadow plane is what lies behind a silhouette edge as the light sees it. One that faces the eye ends what is lit, seen
// from the eye; one that does not begins it. With L the airlight from the eye to a distance, what is drawn is
//
//   L of the surface            where the stencil is 0, which counts the volumes that the surface is in
//   + L of a plane that faces the eye, where the stencil is 1; it takes 1 from the stencil
//   - L of one that does not, where the stencil is 0; it adds 1
//
// The paper draws quadrilaterals and blends them. Here each pixel draws those that cover it, in the same order, with a
// stencil of its own: the same sums. A plane has one place in the order, that of the middle of its edge, wherever a ray
// meets it: so the order is wrong where planes intersect or lie behind one another the other way round farther out.
#import scene
#import ray
#import airlight
#import lights
#import shadows
#import unfinished

override nodes: u32 = 12;
override stencil: bool = true;

var<uniform> camera: Camera;
var<uniform> medium: Medium;
var<uniform> phase: Phase;
var<storage, read> lights: Lights;
var depth: texture_2d<f32>;
var radiance: texture_storage_2d<rgba32float, write>;
var lit: texture_storage_2d<rgba32float, write>;

// Whether a loop over planes ended before it was done.
var<private> stopped: bool = false;

// What eight bits hold.
const STENCIL_MAX: i32 = 255;

// What is drawn into a pixel, and how far the drawing has come.
struct Drawn {
    x: f32,                     // m; of what is drawn now
    share: f32,                 // of its airlight: 1, -1 or 0
    stencil: i32,
    place: f32,                 // in the order: distance of the middle of the plane's edge from the eye, m
    edge: u32,                  // among planes at the same place
    done: bool,
}

// Step 2: how many shadow volumes the surface is in. The planes before it that face the eye less those that do not, which
// is that where the eye is in none.
fn stencil_of_surface(ray: ShadowRay) -> i32 {
    var facing = 0;
    var averted = 0;
    var i = ray.first;
    loop {
        let crossing = crossing_of(shadow_edges.items[shadow_crossings.items[min(i, max(ray.end, 1u) - 1u)].edge], ray);
        let counts = i < ray.end && crossing.x > 0.0 && crossing.x < ray.way;
        facing += select(0, 1, counts && crossing.step > 0);
        averted += select(0, 1, counts && crossing.step < 0);
        i++;
        if i >= ray.end { break; }
    }
    stopped = stopped || i < ray.end;
    return max(min(facing, STENCIL_MAX) - averted, 0);
}

// Steps 4 and 5: the plane behind the last one in the order; drawn or not.
fn next_plane(ray: ShadowRay, last: Drawn) -> Drawn {
    var x = 0.0;
    var step = 0;
    var place = -1.0;
    var number = 0u;
    var i = ray.first;
    loop {
        let edge_number = shadow_crossings.items[min(i, max(ray.end, 1u) - 1u)].edge;
        let edge = shadow_edges.items[edge_number];
        let crossing = crossing_of(edge, ray);
        let its_place = length(0.5 * (edge.a + edge.b));
        let follows = its_place < last.place || (its_place == last.place && edge_number > last.edge);
        let precedes = its_place > place || (its_place == place && edge_number < number);
        let takes = i < ray.end && crossing.x > 0.0 && crossing.x < ray.way && follows && precedes;
        x = select(x, crossing.x, takes);
        step = select(step, crossing.step, takes);
        place = select(place, its_place, takes);
        number = select(number, edge_number, takes);
        i++;
        if i >= ray.end { break; }
    }
    stopped = stopped || i < ray.end;
    let facing = step > 0;
    let passes = !stencil || last.stencil == select(0, 1, facing);
    let counted = clamp(last.stencil + select(1, -1, facing), 0, STENCIL_MAX);
    let share = select(0.0, select(-1.0, 1.0, facing), passes && place >= 0.0);
    return Drawn(x, share, select(last.stencil, counted, place >= 0.0), place, number, place < 0.0);
}

fn next_drawn(ray: ShadowRay, last: Drawn) -> Drawn {
    var next = last;
    loop {
        next = next_plane(ray, next);
        if next.done || next.share != 0.0 { break; }
    }
    return next;
}

// Step 3: the surface, or where there is none the ray without end.
fn surface(ray: ShadowRay) -> Drawn {
    let volumes = stencil_of_surface(ray);
    return Drawn(ray.way, select(0.0, 1.0, volumes == 0), volumes, BEYOND, 0u, false);
}

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
    var drawn = surface(shadow);
    var cursor = Cursor(0u, 0u, 0.0);
    lit_bits += select(vec4<f32>(0.0), bit_of_light(0u), drawn.stencil == 0);
    loop {
        let part = vec2<f32>(0.0, drawn.x);
        let piece = airlight_between(cursor, lights.items[light], medium, phase, ray, part, nodes);
        sum += drawn.share * piece.radiance;
        cursor = piece.next;
        if cursor.light > light {
            drawn = next_drawn(shadow, drawn);
            cursor = Cursor(light, 0u, 0.0);
            if drawn.done {
                light++;
                cursor = Cursor(light, 0u, 0.0);
                // beyond the last light no more is drawn
                let next = min(light, max(count, 1u) - 1u);
                shadow = shadow_ray(shadow_lights.items[next], ray, way);
                drawn = surface(shadow);
                lit_bits += select(vec4<f32>(0.0), bit_of_light(light), light < count && drawn.stencil == 0);
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
