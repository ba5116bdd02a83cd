// Which points of a view ray a light does not reach, from the triangles that cast shadows alone: brute force but for a
// hierarchy of boxes (src/occluders.rs builds it). Silhouettes have no part in it.
//
// Points are asked for by 32, as bits, so that a walk down the hierarchy serves them all: software Vulkan ends all loops
// of a thread after 65,535 rounds, and a walk for each point of a fine march would come to more. The shadow of
// a triangle is convex, so it hides the points of one interval of the ray.

#import scene
#import ray
#import "occluder_data.wgsl"

// Whether a walk ended before it was done.
var<private> occluders_missed: bool = false;

// By what part a number may have been rounded in all that leads to the height of a light above a triangle, as in shadows.rs.
const ROUNDED: f32 = 8.0 / 16777216.0;
// Boxes are larger by this part, so that rounding errors lose none.
const BOX_SLACK: f32 = 1e-5;

// What lies between a light and a part of a ray: a triangle, or of a directional light a parallelogram.
struct Fan {
    start: vec3<f32>,           // of the part, m
    low: vec3<f32>,             // of its box
    high: vec3<f32>,
    normal: vec3<f32>,          // of its plane, any length
    before: vec3<f32>,          // normals of its sides within the plane, outward
    end: vec3<f32>,
    behind: vec3<f32>,
}

fn fan_of(light: Light, start: vec3<f32>, end: vec3<f32>) -> Fan {
    let is_sun = light.kind == DIRECTIONAL;
    // a directional light is looked for as far as there are boxes
    let root = occluder_nodes.items[0];
    let of_start = max(abs(root.low - start), abs(root.high - start));
    let of_end = max(abs(root.low - end), abs(root.high - end));
    let sun_way = -length(max(of_start, of_end)) * light.direction;
    let to_light = select(light.position - start, sun_way, is_sun);
    let from_end = select(light.position - end, sun_way, is_sun);
    let nearer = min(start, end);
    let farther = max(start, end);
    let low = min(nearer, select(light.position, nearer + sun_way, is_sun));
    let high = max(farther, select(light.position, farther + sun_way, is_sun));
    let normal = cross(end - start, to_light);
    // outward, as (e x l) x l has no part along e that is above 0
    let before = cross(normal, to_light);
    let behind = cross(from_end, normal);
    return Fan(start, low, high, normal, before, end, behind);
}

// Whether all of a box is on the outer side of a plane through a point.
fn is_outside(centre: vec3<f32>, extent: vec3<f32>, normal: vec3<f32>, point: vec3<f32>) -> bool {
    let away = centre - point;
    return dot(normal, away) > dot(abs(normal), extent + BOX_SLACK * abs(away));
}

fn meets(node: OccluderNode, fan: Fan) -> bool {
    let slack = BOX_SLACK * (abs(fan.low) + abs(fan.high));
    let apart = any(node.low > fan.high + slack) || any(node.high < fan.low - slack);
    let centre = 0.5 * (node.low + node.high);
    let extent = 0.5 * (node.high - node.low);
    return !(apart || is_outside(centre, extent, fan.normal, fan.start) || is_outside(centre, extent, -fan.normal, fan.start)
        || is_outside(centre, extent, fan.before, fan.start) || is_outside(centre, extent, fan.behind, fan.end));
}

// The interval of a ray that is left of x to y where height + rise x >= 0, m.
fn clipped(interval: vec2<f32>, height: f32, rise: f32) -> vec2<f32> {
    // along a plane, all or nothing: the plane is met far behind the ray's start or far before it
    let steepness = select(rise, 1e-30, rise == 0.0);
    let at = -height / steepness;
    return vec2<f32>(select(interval.x, max(interval.x, at), steepness > 0.0), select(interval.y, min(interval.y, at), steepness < 0.0));
}

// The interval of a ray in the shadow of a triangle, empty where x > y.
fn shadow_of_triangle(first: u32, light: Light, ray: Ray) -> vec2<f32> {
    let is_sun = light.kind == DIRECTIONAL;
    // from the light; of a sun from the ray's origin
    let origin = select(light.position, ray.origin, is_sun);
    let corners = array(occluder_corners.items[first].xyz, occluder_corners.items[first + 1u].xyz,
        occluder_corners.items[first + 2u].xyz);
    let a = corners[0] - origin;
    let b = corners[1] - origin;
    let c = corners[2] - origin;
    let eye = ray.origin - origin;
    let normal = cross(b - a, c - a);
    let away = dot(normal, select(a, light.direction, is_sun));
    let largest = max(max(abs(corners[0]), abs(corners[1])), max(abs(corners[2]), abs(origin)));
    let rounded = select(dot(abs(normal), largest), length(normal), is_sun);
    let sides = mat3x3<f32>(
        select(cross(a, b), cross(b - a, light.direction), is_sun),
        select(cross(b, c), cross(c - b, light.direction), is_sun),
        select(cross(c, a), cross(a - c, light.direction), is_sun),
    );
    let turn = sign(dot(sides[0], c - a));
    var interval = vec2<f32>(-1e30, 1e30);
    interval = clipped(interval, turn * dot(sides[0], eye - a), turn * dot(sides[0], ray.direction));
    interval = clipped(interval, turn * dot(sides[1], eye - b), turn * dot(sides[1], ray.direction));
    interval = clipped(interval, turn * dot(sides[2], eye - c), turn * dot(sides[2], ray.direction));
    interval = clipped(interval, sign(away) * dot(normal, eye - a), sign(away) * dot(normal, ray.direction));
    let is_seen = abs(away) > ROUNDED * rounded;
    return select(vec2<f32>(1.0, 0.0), interval, is_seen);
}

// Bits of the points from x metres in steps of dx that are within an interval.
fn points_within(interval: vec2<f32>, x: f32, dx: f32) -> u32 {
    let first = u32(clamp(ceil((interval.x - x) / dx), 0.0, 32.0));
    let end = u32(clamp(floor((interval.y - x) / dx) + 1.0, 0.0, 32.0));
    let below_end = select((1u << (end & 31u)) - 1u, 0xffffffffu, end == 32u);
    let below_first = select((1u << (first & 31u)) - 1u, 0xffffffffu, first == 32u);
    return below_end & ~below_first;
}

// Of a leaf's triangle of this number, where it has so many.
fn points_of_leaf(node: OccluderNode, number: u32, triangles: u32, light: Light, ray: Ray, x: f32, dx: f32) -> u32 {
    let shadow = shadow_of_triangle(3u * (node.first + select(0u, number, number < triangles)), light, ray);
    return select(0u, points_within(shadow, x, dx), number < triangles && shadow.x <= shadow.y);
}

// Of 32 points of a ray from x metres in steps of dx those that a light does not reach, the first in the lowest bit.
fn hidden_points(light: Light, ray: Ray, x: f32, dx: f32) -> u32 {
    let start = ray.origin + x * ray.direction;
    let fan = fan_of(light, start, start + 31.0 * dx * ray.direction);
    let count = occluder_nodes.count;
    var at = 0u;
    var hidden = 0u;
    loop {
        // on to the next leaf that is met
        var node: OccluderNode;
        var triangles = 0u;
        loop {
            node = occluder_nodes.items[at];
            let inside = count > 0u && meets(node, fan);
            triangles = select(0u, node.triangles, inside);
            at = select(node.skip, at + 1u, inside || count == 0u);
            if triangles > 0u || at >= count { break; }
        }
        hidden |= points_of_leaf(node, 0u, triangles, light, ray, x, dx);
        hidden |= points_of_leaf(node, 1u, triangles, light, ray, x, dx);
        hidden |= points_of_leaf(node, 2u, triangles, light, ray, x, dx);
        hidden |= points_of_leaf(node, 3u, triangles, light, ray, x, dx);
        if at >= count || hidden == 0xffffffffu { break; }
    }
    occluders_missed = occluders_missed || (at < count && hidden != 0xffffffffu);
    return hidden;
}
