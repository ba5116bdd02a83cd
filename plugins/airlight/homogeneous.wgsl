// Airlight of every light of the scene: see shaders/airlight.wgsl.
#import scene
#import ray
#import airlight

override nodes: u32 = 12;

var<uniform> camera: Camera;
var<uniform> medium: Medium;
var<uniform> phase: Phase;
var<storage, read> lights: Lights;
var depth: texture_2d<f32>;
var radiance: texture_storage_2d<rgba32float, write>;

@compute @workgroup_size(8, 8)
fn main(@builtin(global_invocation_id) id: vec3<u32>) {
    let size = textureDimensions(radiance);
    let count = lights.count;
    let ray = ray_of_pixel(camera, id.xy, size);
    let way = textureLoad(depth, id.xy, 0).x;
    var sum = vec3<f32>(0.0);
    // a list without lights holds one of intensity 0
    var cursor = Cursor(0u, 0u, 0.0);
    loop {
        let piece = airlight(cursor, lights.items[cursor.light], medium, phase, ray, way, nodes);
        sum += piece.radiance;
        cursor = piece.next;
        if cursor.light >= count { break; }
    }
    // no early return above: outside of branches software Vulkan reads the scene's data once for all threads
    if all(id.xy < size) {
        textureStore(radiance, id.xy, vec4<f32>(sum, 1.0));
    }
}
