// Light -> surface -> eye and light -> medium -> surface -> eye, of every light of the scene: see shaders/reflection.wgsl.
#import scene
#import ray
#import medium
#import lights
#import light_sum
#import reflection
#import "ambient.wgsl"
#import "lobe_data.wgsl"

override direct: bool = true;
override scattered: bool = true;

var<uniform> camera: Camera;
var<uniform> medium: Medium;
var depth: texture_2d<f32>;
var normal: texture_2d<f32>;
var material: texture_2d_array<f32>;
var table: texture_2d_array<f32>;
var lit: texture_2d<u32>;
var radiance: texture_storage_2d<rgba32float, write>;

struct Receiver {
    surface: Surface,
    lit: vec4<u32>,             // which lights reach it, see lights.wgsl
}

fn received(light: Light, index: u32, receiver: Receiver) -> vec3<f32> {
    let is_lit = direct && has_light(receiver.lit, index);
    return reflected(light, spot_layers.items[index], medium, receiver.surface, is_lit, scattered, table);
}

@compute @workgroup_size(8, 8)
fn main(@builtin(global_invocation_id) id: vec3<u32>) {
    let size = textureDimensions(radiance);
    let way = textureLoad(depth, id.xy, 0).x;
    let ray = ray_of_pixel(camera, id.xy, size);
    let toward_eye = textureLoad(normal, id.xy, 0).xyz;
    let lambert = textureLoad(material, id.xy, 0, 0);
    let phong = textureLoad(material, id.xy, 1, 0);
    let phong_layer = shininess_layers.items[min(u32(lambert.w), shininess_layers.count - 1u)];
    let surface = Surface(ray.origin + min(way, ENDLESS) * ray.direction, lambert.xyz, phong.xyz, phong.w,
        lookup_of(toward_eye, 0u, 1.0, table),
        lookup_of(reflect(ray.direction, toward_eye), phong_layer, phong.w, table));
    var sum = received_of_all(Receiver(surface, textureLoad(lit, id.xy, 0)));
    sum += select(vec3<f32>(0.0), ambient_reflected(medium, lambert.xyz, phong.xyz, phong.w), scattered);
    if all(id.xy < size) {
        let found = select(vec3<f32>(0.0), sum * transmittance(medium, way), way < ENDLESS);
        textureStore(radiance, id.xy, vec4<f32>(found, 1.0));
    }
}
