// Which lights reach the surfaces that are seen, by rays at the triangles, to compare with.
#import scene
#import ray
#import lights
#import occluders
#import unfinished

// Part of the way at which it is asked: before the surface, so that it does not hide itself from what it faces.
const BEFORE_SURFACE: f32 = 0.9999;
// Where there is no surface, m: no farther, for what is met is asked of boxes that grow with the way, and no more than needed.
const FARTHEST: f32 = 1e4;

var<uniform> camera: Camera;
var<storage, read> lights: Lights;
var depth: texture_2d<f32>;
var lit: texture_storage_2d<rgba32float, write>;

@compute @workgroup_size(8, 8)
fn main(@builtin(global_invocation_id) id: vec3<u32>) {
    let size = textureDimensions(lit);
    let count = lights.count;
    let ray = ray_of_pixel(camera, id.xy, size);
    let met = textureLoad(depth, id.xy, 0).x;
    let way = select(met, FARTHEST, met > 1e30);
    let x = BEFORE_SURFACE * way;
    var bits = vec4<f32>(0.0);
    // a list without lights holds one of intensity 0; why the test stands at the end: see shaders/airlight.wgsl
    var i = 0u;
    loop {
        bits += select(vec4<f32>(0.0), bit_of_light(i), (hidden_points(lights.items[i], ray, x, 1.0) & 1u) == 0u);
        i++;
        if i >= count { break; }
    }
    if all(id.xy < size) {
        textureStore(lit, id.xy, bits);
        if i < count || occluders_missed {
            tell_unfinished();
        }
    }
}
