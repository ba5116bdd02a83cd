// Which lights reach the surfaces that are seen, by rays at the triangles, to compare with.
#import scene
#import ray
#import lights
#import every_light
#import unfinished
#import "occluders.wgsl"

// Part of the way at which it is asked: before the surface, so that it does not hide itself from what it faces.
const BEFORE_SURFACE: f32 = 0.99999;
// The other points that are asked for at once follow in steps of this part of the way: near, so that few boxes are looked into,
// and not so near that the plane of all of them is lost in rounding.
const NEXT_POINT: f32 = 0.01;
// Where there is no surface, m: no farther, for what is met is asked of boxes that grow with the way, and no more than needed.
const FARTHEST: f32 = 1e4;

var<uniform> camera: Camera;
var depth: texture_2d<f32>;
var lit: texture_storage_2d<rgba32uint, write>;

struct Gathered {
    light: u32,
    lit: vec4<u32>,             // see lights.wgsl
    ray: Ray,
    x: f32,                     // m; where on the ray it is asked
}

fn gather(before: Gathered, light: Light) -> Gathered {
    let is_lit = (hidden_points(light, before.ray, before.x, NEXT_POINT * before.x) & 1u) == 0u;
    let lit = before.lit | select(vec4<u32>(0u), bit_of_light(before.light), is_lit);
    return Gathered(before.light + 1u, lit, before.ray, before.x);
}

@compute @workgroup_size(8, 8)
fn main(@builtin(global_invocation_id) id: vec3<u32>) {
    let size = textureDimensions(lit);
    let ray = ray_of_pixel(camera, id.xy, size);
    let met = textureLoad(depth, id.xy, 0).x;
    let way = select(met, FARTHEST, met > 1e30);
    let gathered = gather_lights(Gathered(0u, vec4<u32>(0u), ray, BEFORE_SURFACE * way));
    if all(id.xy < size) {
        textureStore(lit, id.xy, gathered.lit);
        if lights_missed || occluders_missed {
            tell_unfinished();
        }
    }
}
