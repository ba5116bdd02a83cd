// What the passes share that find airlight in a table: which ray a pixel has, and what is written of it.
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

fn ray_of(pixel: vec2<u32>) -> Ray {
    return ray_of_pixel(camera, pixel, textureDimensions(radiance));
}

// Airlight of a light; `weights` of the table's channels, `share` what goes of a directional light toward the eye, 1/sr.
fn airlight_of(light: Light, ray: Ray, pixel: vec2<u32>, weights: vec4<f32>, share: f32) -> vec3<f32> {
    return airlight_by_table(table, weights, light, medium, ray, textureLoad(depth, pixel, 0).x, share);
}

// No pass returns before this: outside of branches software Vulkan reads the scene's data once for all threads.
fn store(pixel: vec2<u32>, sum: vec3<f32>) {
    if all(pixel < textureDimensions(radiance)) {
        textureStore(radiance, pixel, vec4<f32>(sum, 1.0));
    }
}
