// Light -> surface -> eye and light -> medium -> surface -> eye, of every light of the scene: see shaders/reflection.wgsl.
#import scene
#import ray
#import medium
#import lights
#import reflection

override direct: bool = true;
override scattered: bool = true;

var<uniform> camera: Camera;
var<uniform> medium: Medium;
var<storage, read> lights: Lights;
var depth: texture_2d<f32>;
var normal: texture_2d<f32>;
var material: texture_2d_array<f32>;
var table: texture_2d_array<f32>;
var lit: texture_2d<f32>;
var radiance: texture_storage_2d<rgba32float, write>;

@compute @workgroup_size(8, 8)
fn main(@builtin(global_invocation_id) id: vec3<u32>) {
    let size = textureDimensions(radiance);
    let count = lights.count;
    let way = textureLoad(depth, id.xy, 0).x;
    let ray = ray_of_pixel(camera, id.xy, size);
    let outward = textureLoad(normal, id.xy, 0).xyz;
    let toward_eye = select(outward, -outward, dot(outward, ray.direction) > 0.0);
    let lambert = textureLoad(material, id.xy, 0, 0);
    let phong = textureLoad(material, id.xy, 1, 0);
    let surface = Surface(ray.origin + min(way, ENDLESS) * ray.direction, lambert.xyz, phong.xyz, phong.w,
        lookup_of(toward_eye, 0u, 1.0, table),
        lookup_of(reflect(ray.direction, toward_eye), u32(lambert.w), phong.w, table));
    let lit_bits = textureLoad(lit, id.xy, 0);
    var sum = vec3<f32>(0.0);
    // a list without lights holds one of intensity 0; why the test stands at the end: see shaders/airlight.wgsl
    var i = 0u;
    loop {
        sum += reflected(lights.items[i], medium, surface, direct && has_light(lit_bits, i), scattered, table);
        i++;
        if i >= count { break; }
    }
    // no early return above: see plugins/march/airlight.wgsl
    if all(id.xy < size) {
        let found = select(vec3<f32>(0.0), sum * transmittance(medium, way), way < ENDLESS);
        textureStore(radiance, id.xy, vec4<f32>(found, 1.0));
    }
}
