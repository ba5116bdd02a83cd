// A shadow map of the lamps of the scene, see shaders/shadow_map.wgsl: a ray through the middle of each texel, at all
// triangles that cast shadows.
#import scene
#import shadow_map
#import unfinished
#import "occluder_data.wgsl"

struct Params {
    size: u32,
}

var<uniform> params: Params;
var<storage, read> lights: Lights;
var distances: texture_storage_2d_array<r32float, write>;

// Where nothing is met, m.
const NOTHING: f32 = 3e38;
// Boxes are larger by this part, so that rounding errors lose none.
const BOX_SLACK: f32 = 1e-5;

// Whether a walk ended before it was done.
var<private> missed: bool = false;

// Whether a ray meets a box nearer than `nearest`.
fn meets(node: OccluderNode, origin: vec3<f32>, inverse: vec3<f32>, nearest: f32) -> bool {
    let slack = BOX_SLACK * (abs(node.low) + abs(node.high) + abs(origin));
    let a = (node.low - slack - origin) * inverse;
    let b = (node.high + slack - origin) * inverse;
    let start = max(max(min(a.x, b.x), min(a.y, b.y)), max(min(a.z, b.z), 0.0));
    let end = min(min(max(a.x, b.x), max(a.y, b.y)), min(max(a.z, b.z), nearest));
    return start <= end;
}

// Distance of a triangle (Möller and Trumbore 1997).
fn distance_of(first: u32, origin: vec3<f32>, direction: vec3<f32>) -> f32 {
    let a = occluder_corners.items[first].xyz;
    let to_b = occluder_corners.items[first + 1u].xyz - a;
    let to_c = occluder_corners.items[first + 2u].xyz - a;
    let from_a = origin - a;
    let across = cross(direction, to_c);
    let determinant = dot(to_b, across);
    let turned = cross(from_a, to_b);
    let u = dot(from_a, across) / determinant;
    let v = dot(direction, turned) / determinant;
    let way = dot(to_c, turned) / determinant;
    let is_met = determinant != 0.0 && u >= 0.0 && v >= 0.0 && u + v <= 1.0 && way > 0.0;
    return select(NOTHING, way, is_met);
}

fn nearest_along(origin: vec3<f32>, direction: vec3<f32>) -> f32 {
    let inverse = 1.0 / select(direction, vec3<f32>(1e-30), abs(direction) < vec3<f32>(1e-30));
    let count = occluder_nodes.count;
    var nearest = NOTHING;
    var at = 0u;
    loop {
        // on to the next leaf that is met
        var node: OccluderNode;
        var triangles = 0u;
        loop {
            node = occluder_nodes.items[at];
            let inside = count > 0u && meets(node, origin, inverse, nearest);
            triangles = select(0u, node.triangles, inside);
            at = select(node.skip, at + 1u, inside || count == 0u);
            if triangles > 0u || at >= count { break; }
        }
        var number = 0u;
        loop {
            let way = distance_of(3u * (node.first + select(0u, number, number < triangles)), origin, direction);
            nearest = select(nearest, min(nearest, way), number < triangles);
            number++;
            if number >= triangles { break; }
        }
        if at >= count { break; }
    }
    missed = at < count;
    return nearest;
}

@compute @workgroup_size(8, 8)
fn main(@builtin(global_invocation_id) id: vec3<u32>) {
    let size = textureDimensions(distances);
    let tiles = tiles_of(lights.count, params.size);
    let tile = id.xy / tiles.edge;
    let index = tile.y * tiles.across + tile.x;
    let is_mapped = all(tile < vec2<u32>(tiles.across)) && index < lights.count;
    // behind the last light any of them, which is not used
    let light = lights.items[index];
    let nearest = nearest_along(light.position, normalize(map_direction(tiles, id.xy, id.z)));
    if all(id.xy < size) {
        let seen = select(NOTHING, nearest, is_mapped && light.kind != DIRECTIONAL);
        textureStore(distances, id.xy, id.z, vec4<f32>(seen, 0.0, 0.0, 1.0));
        if missed && is_mapped {
            tell_unfinished();
        }
    }
}
