// Airlight of every light of the scene in height fog: see shaders/height_fog.wgsl.
#import scene
#import ray
#import height_fog

override nodes: u32 = 12;

struct Params {
    attenuated_sun: u32,
}

var<uniform> params: Params;
var<uniform> camera: Camera;
var<uniform> medium: Medium;
var<uniform> height_fog: HeightFog;
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
    let attenuated = params.attenuated_sun != 0u;
    var sum = vec3<f32>(0.0);
    // a list without lights holds one of intensity 0; why the test stands at the end: see shaders/airlight.wgsl
    var cursor = HeightCursor(0u, 0u, 0.0, 0.0);
    loop {
        let piece = height_airlight(cursor, lights.items[cursor.light], medium, height_fog, phase, ray, way, attenuated, nodes);
        sum += piece.radiance;
        cursor = piece.next;
        if cursor.light >= count { break; }
    }
    if all(id.xy < size) {
        textureStore(radiance, id.xy, vec4<f32>(sum, 1.0));
    }
}
