// The parts of a view ray that a light reaches, exact whatever casts shadows: see ShadowLight in
// shadow_data.wgsl, and src/shadows, which sorts the silhouettes.
//
// The half-plane of ray and light begins at the axis through light and eye, the z axis of the light's frame. In it
//
//   r, z      distance of a point from the axis, and along it from the eye, m
//   kappa     1/distance of the light from the eye; 0 of a directional light
//   n         1 + kappa z: the light sees a point in the direction n/r
//   gamma     angle between the axis and the ray: the ray's points are x (sin(gamma), cos(gamma))
//   side      of a vertex: its distance from the half-plane, to one side of it or the other
//   T         sin(gamma) z - cos(gamma) r: distance of a point from the ray, below 0 between ray and light
//   V         sin(gamma) n - kappa cos(gamma) r: the ray passes behind a point at x = r/V, and never where V <= 0
//   depth     number of triangles between the light and a point of the ray
//
// An edge whose ends are on two sides of the half-plane meets it at a point. If that is between ray and light, then
// behind it the depth is another. Which side a vertex is on is the same for all edges that share it, so that outlines
// stay closed whatever is rounded; and whether such a point is ahead is decided as the depth at the eye was.
//
// A walk looks at the crossings of its slice one after another, in the order in which the light sees them. The order along
// the ray is nearly the same: the few that are ahead of the walk are kept sorted, and it goes on to the first of them as
// soon as nothing that follows in the slice can come before that. Where there are more than there is room for, the walk
// begins anew at what was lost. So there is no limit to what a ray can cross.

#import scene
#import ray
#import "shadow_data.wgsl"

// More than any distance, m, whose products stay finite.
const BEYOND: f32 = 1e18;

// n/r of edges of which no more is known.
const ANYWHERE: f32 = 3e38;

// A ray in the frame of a light.
struct ShadowRay {
    toward: vec2<f32>,          // unit vector: the way of the ray across the axis
    sine: f32,                  // of gamma
    cosine: f32,
    nearness: f32,              // kappa, 1/m
    way: f32,                   // m; BEYOND where it meets nothing
    first: u32,                 // crossing of its slice
    end: u32,
}

// 0 at +x, 1 at +y, 2 at -x, 3 at -y, monotonous between; `angle` of slices.rs.
fn angle_of(v: vec2<f32>) -> f32 {
    let part = v.y / (abs(v.x) + abs(v.y));
    return select(select(part, 4.0 + part, v.y < 0.0), 2.0 - part, v.x < 0.0);
}

fn shadow_ray(light: ShadowLight, ray: Ray, way: f32) -> ShadowRay {
    let across = vec2<f32>(dot(ray.direction, light.across), dot(ray.direction, light.upward));
    let sine = length(across);
    // along the axis every half-plane is the ray's
    let toward = select(vec2<f32>(1.0, 0.0), across / sine, sine > 1e-12);
    let place = angle_of(toward) * 0.25 * f32(light.bins);
    let bin = min(u32(place), max(light.bins, 1u) - 1u);
    let slices = shadow_slices.items[light.first_bin + bin];
    let count = slices & 0xffffu;
    let within = min(u32((place - f32(bin)) * f32(count)), max(count, 1u) - 1u);
    let slice = light.first_bin + light.bins + (slices >> 16u) + within;
    let first = shadow_slices.items[slice];
    let end = select(first, shadow_slices.items[slice + 1u], light.bins > 0u);
    return ShadowRay(toward, sine, dot(ray.direction, light.axis), light.nearness, min(way, BEYOND), first, end);
}

// Where the ray passes behind an edge, m, and by how much the depth grows there; BEYOND and 0 where it does not. What
// touches the eye hides the light from there on.
struct Crossing {
    x: f32,
    step: i32,
}

fn crossing_of(edge: ShadowEdge, ray: ShadowRay) -> Crossing {
    let step = i32(edge.a.w);
    let away = edge.b.w;
    let side_a = ray.toward.x * edge.a.y - ray.toward.y * edge.a.x;
    let side_b = ray.toward.x * edge.b.y - ray.toward.y * edge.b.x;
    let r_a = dot(ray.toward, edge.a.xy);
    let r_b = dot(ray.toward, edge.b.xy);
    let forward = side_a < 0.0;
    let crossed = forward != (side_b < 0.0);
    let ahead = (r_a > 0.0 && r_b > 0.0) || ((r_a > 0.0 || r_b > 0.0) && forward);
    let inverse = 1.0 / select(1.0, side_b - side_a, crossed);
    let r = max((side_b * r_a - side_a * r_b) * inverse, 0.0);
    let z = (side_b * edge.a.z - side_a * edge.b.z) * inverse;
    let from_ray = ray.sine * z - ray.cosine * r;
    let v = ray.sine + ray.nearness * from_ray;
    let at_eye = away != 0.0;
    let hides = select(from_ray < 0.0 && v > 0.0, is_hidden_at_eye(away, ray, r, from_ray), at_eye);
    let behind = crossed && ahead && hides;
    let x = select(r / max(v, 1e-30), 0.0, at_eye);
    return Crossing(select(BEYOND, x, behind), select(0, select(-step, step, forward), behind));
}

// Whether the triangle of an edge touches the eye and hides the light from the ray's first metre on. An eye behind it is in
// its shadow whatever the ray; else a ray that passes behind it is, unless it meets the triangle after all and ends there.
fn is_hidden_at_eye(away: f32, ray: ShadowRay, r: f32, from_ray: f32) -> bool {
    let met = away * r / max(ray.sine * away - from_ray, 1e-30);
    return away < 0.0 || (from_ray < 0.0 && ray.way > 2.0 * met);
}

// Of a crossing: the bits of its cosine.
const COSINE_BITS: u32 = 0x3ffu;

// Whether some of an edge may be between the ray and the light. What makes a smaller angle with the axis than the ray does, as
// the eye sees it, is beyond the ray; without a look at its edge that is most of what a ray through a tree meets.
fn may_hide(crossing: u32, ray: ShadowRay) -> bool {
    return ray.cosine >= f32(crossing & COSINE_BITS) * (2.0 / f32(COSINE_BITS)) - 1.0;
}

// Whether all that has n/r = `ratio` or less is crossed at x or farther. Of what may be anywhere the ratio says nothing.
fn is_beyond(ratio: f32, ray: ShadowRay, x: f32) -> bool {
    return ratio < ANYWHERE && x * (ray.sine * ratio - ray.cosine * ray.nearness) <= 1.0;
}

// Crossings ahead, in order, each with its number; BEYOND where there is none.
struct Crossings {
    x: vec4<f32>,
    steps: vec4<i32>,
    numbers: vec4<u32>,
}

fn no_crossings() -> Crossings {
    return Crossings(vec4<f32>(BEYOND), vec4<i32>(0), vec4<u32>(0u));
}

// With one more: in its place, or a part of one at the same x.
fn with_crossing(crossings: Crossings, more: Crossing, number: u32) -> Crossings {
    let x = crossings.x;
    let same = vec4<f32>(more.x) == x;
    let before = vec4<f32>(more.x) < x;
    let known = any(same);
    let before_last = vec4<bool>(false, before.x, before.y, before.z);
    let steps = crossings.steps;
    let numbers = crossings.numbers;
    let inserted_x = select(x, select(vec4<f32>(more.x), vec4<f32>(more.x, x.xyz), before_last), before);
    let inserted_steps = select(steps, select(vec4<i32>(more.step), vec4<i32>(more.step, steps.xyz), before_last), before);
    let inserted_numbers = select(numbers, select(vec4<u32>(number), vec4<u32>(number, numbers.xyz), before_last), before);
    let summed = steps + select(vec4<i32>(0), vec4<i32>(more.step), same);
    return Crossings(select(inserted_x, x, known), select(inserted_steps, summed, known), select(inserted_numbers, numbers, known));
}

// Without the first.
fn without_first(crossings: Crossings) -> Crossings {
    return Crossings(vec4<f32>(crossings.x.yzw, BEYOND), vec4<i32>(crossings.steps.yzw, 0), vec4<u32>(crossings.numbers.yzw, 0u));
}

// How far a walk along a ray has come.
struct ShadowWalk {
    x: f32,                     // m; below 0 before it starts
    depth: i32,
    next: u32,                  // crossing of the slice to look at
    ahead: Crossings,           // of those before it that are not behind x
    lost: f32,                  // m; from here on there was no room for all; NOTHING_LOST
    first_lost: u32,            // the first of them, or one before it
    counted: f32,               // m; what is up to here was counted before the walk began anew
}

// Farther than BEYOND.
const NOTHING_LOST: f32 = 2e18;

fn start_of_walk(light: ShadowLight, ray: ShadowRay) -> ShadowWalk {
    return ShadowWalk(-1.0, light.depth_at_eye, ray.first, no_crossings(), NOTHING_LOST, ray.end, -1.0);
}

// A crossing is looked at: from now on it is ahead, or lost.
fn look_at(crossing: Crossing, ray: ShadowRay, walk: ShadowWalk) -> ShadowWalk {
    // bounds are not that exact, but if one is found too late it counts where the walk stands
    let x = max(crossing.x, walk.x);
    let is_ahead = walk.next < ray.end && crossing.x > walk.counted && x < ray.way;
    let keeps = is_ahead && x < walk.lost;
    let last = walk.ahead.x.w;
    let no_room = keeps && last < BEYOND && all(walk.ahead.x != vec4<f32>(x));
    let loses_last = no_room && x < last;
    let loses_this = is_ahead && !keeps || no_room && !loses_last;
    let lost_number = select(select(ray.end, walk.next, loses_this), walk.ahead.numbers.w, loses_last);
    var looked = walk;
    looked.ahead = with_crossing(walk.ahead, Crossing(select(BEYOND, x, keeps), select(0, crossing.step, keeps)), walk.next);
    looked.lost = select(walk.lost, max(x, last), no_room);
    looked.first_lost = min(walk.first_lost, lost_number);
    looked.next = walk.next + 1u;
    return looked;
}

// From where it stands, at the first crossing that was lost.
fn begun_anew(ray: ShadowRay, walk: ShadowWalk) -> ShadowWalk {
    return ShadowWalk(walk.x, walk.depth, walk.first_lost, no_crossings(), NOTHING_LOST, ray.end, walk.x);
}

// A part of the ray, from x to y metres, that the light reaches; and where the walk stands behind it.
struct LitPart {
    part: vec2<f32>,
    walk: ShadowWalk,
    done: bool,
}

// The walk goes on to the first crossing ahead, or to the ray's end. Where a part ends it stops.
fn step_to_next(lit: LitPart, way: f32) -> LitPart {
    let x = min(lit.walk.ahead.x.x, way);
    let depth = lit.walk.depth + lit.walk.ahead.steps.x;
    let is_lit = lit.walk.depth <= 0;
    let at_end = x >= way;
    let start = select(lit.part.x, x, !is_lit && (depth <= 0 || at_end));
    var next = LitPart(vec2<f32>(start, x), lit.walk, at_end || (is_lit && depth > 0));
    next.walk.x = x;
    next.walk.depth = depth;
    next.walk.ahead = without_first(lit.walk.ahead);
    return next;
}

// From where a walk stands.
fn from_here(walk: ShadowWalk) -> LitPart {
    return LitPart(vec2<f32>(max(walk.x, 0.0)), walk, false);
}

// One crossing of the slice farther. Where that comes to the end of a part, it is done.
fn walked(before: LitPart, ray: ShadowRay) -> LitPart {
    var lit = before;
    let crossing = shadow_crossings.items[min(lit.walk.next, max(ray.end, 1u) - 1u)];
    var here = Crossing(BEYOND, 0);
    if lit.walk.next < ray.end && may_hide(crossing.x, ray) {
        here = crossing_of(shadow_edges.items[crossing.y], ray);
    }
    let x = min(lit.walk.ahead.x.x, ray.way);
    let is_next_lost = lit.walk.lost <= x;
    let is_next_known = lit.walk.next >= ray.end || is_beyond(bitcast<f32>(crossing.x & ~COSINE_BITS), ray, x);
    if is_next_known && !is_next_lost {
        lit = step_to_next(lit, ray.way);
    }
    lit.walk = look_at(here, ray, lit.walk);
    if is_next_lost {
        lit.walk = begun_anew(ray, lit.walk);
    }
    return lit;
}

// As many lit parts as are found at once: software Vulkan runs threads in lockstep, and were each part summed as soon as it
// is found, every thread would wait for the longest walk to one.
const PARTS: u32 = 32u;

// In order. The last of a ray is empty where the ray ends in shadow.
var<private> parts: array<vec2<f32>, PARTS>;

// How many of `parts` there are now, and where the walk stands behind them: at the ray's end, or where a shadow begins.
struct LitParts {
    count: u32,
    walk: ShadowWalk,
}

// Fills `parts` with the next ones of the ray: as many as there is room for, at least one.
fn next_lit_parts(ray: ShadowRay, walk: ShadowWalk) -> LitParts {
    var lit = from_here(walk);
    var count = 0u;
    loop {
        lit = walked(lit, ray);
        if lit.done {
            parts[count] = lit.part;
            count++;
            lit = from_here(lit.walk);
        }
        if count >= PARTS || lit.walk.x >= ray.way { break; }
    }
    return LitParts(count, lit.walk);
}
