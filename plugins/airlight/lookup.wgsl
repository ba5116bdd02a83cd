// Airlight of every light of the scene by a table, for the passes that differ in what the table holds.
#import scene
#import ray
#import airlight_table

var<uniform> camera: Camera;
var<uniform> medium: Medium;
var<uniform> phase: Phase;
var<storage, read> lights: Lights;
var depth: texture_2d<f32>;
var table: texture_2d<f32>;
var radiance: texture_storage_2d<rgba32float, write>;

// `weights` of the table's channels; `series`: the phase function is what its first four polynomials leave of it.
fn airlight_of_pixel(pixel: vec2<u32>, weights: vec4<f32>, series: bool) {
    let size = textureDimensions(radiance);
    let count = lights.count;
    let scattering = phase;
    let ray = ray_of_pixel(camera, pixel, size);
    let way = textureLoad(depth, pixel, 0).x;
    var sum = vec3<f32>(0.0);
    // a list without lights holds one of intensity 0; why the test stands at the end: see shaders/airlight.wgsl
    var i = 0u;
    loop {
        let light = lights.items[i];
        let w = directional_w(light, ray);
        let p = select(phase_at(scattering, w), dot(weights, legendre_polynomials(1.0 - 2.0 * w)), series);
        sum += airlight_by_table(table, weights, light, medium, ray, way, p);
        i++;
        if i >= count { break; }
    }
    // no early return above: outside of branches software Vulkan reads the scene's data once for all threads
    if all(pixel < size) {
        textureStore(radiance, pixel, vec4<f32>(sum, 1.0));
    }
}
