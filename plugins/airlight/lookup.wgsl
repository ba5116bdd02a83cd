// Airlight of every light of the scene by a table, for the passes that differ in what the table holds.
#import scene
#import ray
#import phase
#import airlight_table
#import light_sum

// What a directional light, which needs no table, scatters toward the eye, 1/sr; w as in phase.wgsl.
#require fn scattered_of_sun(receiver: Receiver, w: f32) -> f32

var<uniform> camera: Camera;
var<uniform> medium: Medium;
var<uniform> phase: Phase;
var depth: texture_2d<f32>;
var table: texture_2d<f32>;
var radiance: texture_storage_2d<rgba32float, write>;

struct Receiver {
    ray: Ray,
    way: f32,                   // m
    weights: vec4<f32>,         // of the table's channels
    scattering: Phase,
}

fn received(light: Light, index: u32, receiver: Receiver) -> vec3<f32> {
    let of_sun = scattered_of_sun(receiver, w_toward_eye(light.direction + receiver.ray.direction));
    return airlight_by_table(table, receiver.weights, light, medium, receiver.ray, receiver.way, of_sun);
}

fn airlight_of_pixel(pixel: vec2<u32>, weights: vec4<f32>) {
    let size = textureDimensions(radiance);
    let ray = ray_of_pixel(camera, pixel, size);
    let sum = received_of_all(Receiver(ray, textureLoad(depth, pixel, 0).x, weights, phase));
    if all(pixel < size) {
        textureStore(radiance, pixel, vec4<f32>(sum, 1.0));
    }
}
