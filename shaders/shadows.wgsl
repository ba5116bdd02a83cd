// The parts of a view ray that a light reaches, exact whatever casts shadows: see ShadowLight in scene.wgsl, and
// crates/scene/src/shadows, which sorts the silhouettes.
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
// Nothing is stored: the few crossings nearest behind where a walk stands are sorted as they are found, and a walk begins
// anew where there are more. So there is no limit to what a ray can cross.

#import scene
#import ray

var<storage, read> shadow_lights: ShadowLights;
var<storage, read> shadow_slices: ShadowSlices;
var<storage, read> shadow_crossings: ShadowCrossings;
var<storage, read> shadow_edges: ShadowEdges;

// More than any distance, m, whose products stay finite.
const BEYOND: f32 = 1e18;

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
    let slice = min(u32(angle_of(toward) * 0.25 * f32(light.slices)), max(light.slices, 1u) - 1u);
    // without an edge there is no slice
    let at = select(0u, light.first_slice + slice, light.slices > 0u);
    let first = shadow_slices.items[at];
    let end = select(first, shadow_slices.items[select(0u, at + 1u, light.slices > 0u)], light.slices > 0u);
    return ShadowRay(toward, sine, dot(ray.direction, light.axis), light.nearness, min(way, BEYOND), first, end);
}

// How far a walk along a ray has come.
struct ShadowWalk {
    x: f32,                     // m; below 0 before it starts
    depth: i32,
    crossing: u32,              // all before it are behind
}

fn start_of_walk(light: ShadowLight, ray: ShadowRay) -> ShadowWalk {
    return ShadowWalk(-1.0, light.depth_at_eye, ray.first);
}

// Where the ray passes behind an edge, m, and by how much the depth grows there; BEYOND and 0 where it does not.
struct Crossing {
    x: f32,
    step: i32,
}

fn crossing_of(edge: ShadowEdge, ray: ShadowRay) -> Crossing {
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
    let behind = crossed && ahead && from_ray < 0.0 && v > 0.0;
    return Crossing(select(BEYOND, r / max(v, 1e-30), behind), select(0, select(-edge.step, edge.step, forward), behind));
}

// Whether all that has n/r = `ratio` or less is crossed at x or farther.
fn is_beyond(ratio: f32, ray: ShadowRay, x: f32) -> bool {
    return x * (ray.sine * ratio - ray.cosine * ray.nearness) <= 1.0;
}

// The nearest crossings ahead, in order.
struct Crossings {
    x: vec4<f32>,
    steps: vec4<i32>,
}

// With one more: in its place, or a part of one at the same x.
fn with_crossing(crossings: Crossings, more: Crossing) -> Crossings {
    let x = crossings.x;
    let steps = crossings.steps;
    let same = vec4<f32>(more.x) == x;
    let before = vec4<f32>(more.x) < x;
    let known = any(same);
    let before_last = vec4<bool>(false, before.x, before.y, before.z);
    let inserted_x = select(x, select(vec4<f32>(more.x), vec4<f32>(more.x, x.xyz), before_last), before);
    let inserted = select(steps, select(vec4<i32>(more.step), vec4<i32>(more.step, steps.xyz), before_last), before);
    let summed = steps + select(vec4<i32>(0), vec4<i32>(more.step), same);
    return Crossings(select(inserted_x, x, known), select(inserted, summed, known));
}

// The nearest crossings behind where the walk stands.
fn next_crossings(ray: ShadowRay, walk: ShadowWalk) -> Crossings {
    var found = Crossings(vec4<f32>(BEYOND), vec4<i32>(0));
    var i = walk.crossing;
    loop {
        let crossing = shadow_crossings.items[min(i, max(ray.end, 1u) - 1u)];
        let here = crossing_of(shadow_edges.items[crossing.edge], ray);
        let done = i >= ray.end || is_beyond(crossing.nearest, ray, min(found.x.w, ray.way));
        let counts = !done && here.x > walk.x && here.x < ray.way;
        found = with_crossing(found, Crossing(select(BEYOND, here.x, counts), select(0, here.step, counts)));
        i++;
        if done { break; }
    }
    return found;
}

// The first crossing of the slice that is not known to be behind x.
fn crossing_behind(ray: ShadowRay, first: u32, x: f32) -> u32 {
    var i = first;
    loop {
        let crossing = shadow_crossings.items[min(i, max(ray.end, 1u) - 1u)];
        let passed = i < ray.end && !is_beyond(crossing.farthest, ray, 0.9999 * x);
        i += select(0u, 1u, passed);
        if !passed { break; }
    }
    return i;
}

// A part of the ray, from x to y metres, that the light reaches; and where the walk stands behind it.
struct LitPart {
    part: vec2<f32>,
    walk: ShadowWalk,
    done: bool,
}

// The walk goes on to a crossing, or to the ray's end. Where a part ends it stops.
fn step_to(lit: LitPart, crossing_x: f32, step: i32, way: f32) -> LitPart {
    let x = min(crossing_x, way);
    let depth = lit.walk.depth + step;
    let is_lit = lit.walk.depth <= 0;
    let at_end = x >= way;
    let start = select(lit.part.x, x, !is_lit && (depth <= 0 || at_end));
    let done = at_end || (is_lit && depth > 0);
    var next = LitPart(vec2<f32>(start, x), ShadowWalk(x, depth, lit.walk.crossing), done);
    if lit.done {
        next = lit;
    }
    return next;
}

// The next lit part of the ray, empty where there is none: then the walk stands at the ray's end, as it does behind the
// last part if that is the end's; else where the next shadow begins.
fn next_lit_part(ray: ShadowRay, walk: ShadowWalk) -> LitPart {
    var lit = LitPart(vec2<f32>(max(walk.x, 0.0)), walk, false);
    loop {
        let found = next_crossings(ray, lit.walk);
        lit = step_to(lit, found.x.x, found.steps.x, ray.way);
        lit = step_to(lit, found.x.y, found.steps.y, ray.way);
        lit = step_to(lit, found.x.z, found.steps.z, ray.way);
        lit = step_to(lit, found.x.w, found.steps.w, ray.way);
        lit.walk.crossing = crossing_behind(ray, lit.walk.crossing, lit.walk.x);
        if lit.done { break; }
    }
    return lit;
}
