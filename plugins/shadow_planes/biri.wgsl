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
#import every_light
#import unfinished
#import "shadows.wgsl"

override nodes: u32 = 12;
override stencil: bool = true;

var<uniform> camera: Camera;
var<uniform> medium: Medium;
var<uniform> phase: Phase;
var depth: texture_2d<f32>;
var radiance: texture_storage_2d<rgba32float, write>;
var lit: texture_storage_2d<rgba32uint, write>;

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
        let crossing = crossing_of(shadow_edges.items[shadow_crossings.items[min(i, max(ray.end, 1u) - 1u)].y], ray);
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
        let edge_number = shadow_crossings.items[min(i, max(ray.end, 1u) - 1u)].y;
        let edge = shadow_edges.items[edge_number];
        let crossing = crossing_of(edge, ray);
        let its_place = length(0.5 * (edge.a.xyz + edge.b.xyz));
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

struct Gathered {
    light: u32,
    radiance: vec3<f32>,        // W/(sr m^2)
    lit: vec4<u32>,             // which lights reach the surface, see lights.wgsl
    ray: Ray,
    way: f32,
    shadow: ShadowRay,
    drawn: Drawn,
    next: Cursor,               // in what is drawn
}

// Before anything of a light is drawn.
fn begun(before: Gathered, light: u32) -> Gathered {
    // beyond the last light no more is drawn
    let lights_end = max(lights.count, 1u);
    var after = before;
    after.light = light;
    after.shadow = shadow_ray(shadow_lights.items[min(light, lights_end - 1u)], before.ray, before.way);
    after.drawn = surface(after.shadow);
    after.next = Cursor(light, 0u, 0.0);
    after.lit |= select(vec4<u32>(0u), bit_of_light(light), light < lights_end && after.drawn.stencil == 0);
    return after;
}

fn gather(before: Gathered, light: Light) -> Gathered {
    let piece = airlight(before.next, light, medium, phase, before.ray, before.drawn.x, nodes);
    var after = before;
    after.radiance += before.drawn.share * piece.radiance;
    after.next = piece.next;
    if piece.next.light > before.light {
        after.drawn = next_drawn(before.shadow, before.drawn);
        after.next = Cursor(before.light, 0u, 0.0);
        if after.drawn.done {
            after = begun(after, before.light + 1u);
        }
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
