// Airlight of every light of the scene: see shaders/airlight.wgsl.
#import scene
#import ray
#import airlight
#import every_light

override nodes: u32 = 12;

var<uniform> camera: Camera;
var<uniform> medium: Medium;
var<uniform> phase: Phase;
var depth: texture_2d<f32>;
var radiance: texture_storage_2d<rgba32float, write>;

struct Gathered {
    light: u32,
    radiance: vec3<f32>,
    next: Cursor,
    ray: Ray,
    way: f32,
}

fn gather(before: Gathered, light: Light) -> Gathered {
    let piece = airlight(before.next, light, medium, phase, before.ray, before.way, nodes);
    var after = before;
    after.light = piece.next.light;
    after.radiance += piece.radiance;
    after.next = piece.next;
    return after;
}

@compute @workgroup_size(8, 8)
fn main(@builtin(global_invocation_id) id: vec3<u32>) {
    let size = textureDimensions(radiance);
    let ray = ray_of_pixel(camera, id.xy, size);
    let way = textureLoad(depth, id.xy, 0).x;
    let gathered = gather_lights(Gathered(0u, vec3<f32>(0.0), Cursor(), ray, way));
    if all(id.xy < size) {
        textureStore(radiance, id.xy, vec4<f32>(gathered.radiance, 1.0));
    }
}
