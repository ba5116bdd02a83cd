// Airlight of every light of the scene in height fog: see shaders/height_fog.wgsl.
#import scene
#import ray
#import height_fog
#import every_light

override nodes: u32 = 12;

struct Params {
    attenuated_sun: u32,
}

var<uniform> params: Params;
var<uniform> camera: Camera;
var<uniform> medium: Medium;
var<uniform> height_fog: HeightFog;
var<uniform> phase: Phase;
var depth: texture_2d<f32>;
var radiance: texture_storage_2d<rgba32float, write>;

struct Gathered {
    light: u32,
    radiance: vec3<f32>,
    next: HeightCursor,
    ray: Ray,
    way: f32,
    attenuated_sun: bool,
}

fn gather(before: Gathered, light: Light) -> Gathered {
    let piece = height_airlight(before.next, light, medium, height_fog, phase, before.ray, before.way, before.attenuated_sun, nodes);
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
    let attenuated_sun = params.attenuated_sun != 0u;
    let gathered = gather_lights(Gathered(0u, vec3<f32>(0.0), HeightCursor(), ray, way, attenuated_sun));
    if all(id.xy < size) {
        textureStore(radiance, id.xy, vec4<f32>(gathered.radiance, 1.0));
    }
}
