// Airlight by brute force, to compare with: equal steps along the ray, the integrand at their middles, the same phase
// function and falloff of spots as everywhere (shaders/phase.wgsl, shaders/cone.wgsl).
//
//   x, t, h, s, r   as in shaders/airlight.wgsl
//   w               sin^2 of half the scattering angle, (r + s)/(2 r)
//
// L = sum over the steps of sigma_s p(w) I(point)/r^2 e^(-sigma_t (x + r)) dx, to the surface, or to DEPTH_MAX.
#import scene
#import ray
#import medium
#import phase
#import cone
#import airlight

// Optical depth along the ray, in the channel of least extinction, at which the march ends.
const MARCH_DEPTH: f32 = 16.0;

override steps: u32 = 256;

var<uniform> camera: Camera;
var<uniform> medium: Medium;
var<storage, read> lights: Lights;
var depth: texture_2d<f32>;
var radiance: texture_storage_2d<rgba32float, write>;

// Airlight of one light over `way` metres of the ray in steps of equal length.
fn march(light: Light, ray: Ray, way: f32) -> vec3<f32> {
    let beside = light_beside_ray(light, ray);
    let is_spot = light.kind == SPOT;
    let dx = way / f32(steps);
    let h2 = beside.h * beside.h;
    var sum = vec3<f32>(0.0);
    for (var i = 0u; i < steps; i++) {
        let x = (f32(i) + 0.5) * dx;
        let s = x - beside.t;
        let inverse_r = inverseSqrt(h2 + s * s);
        let r = (h2 + s * s) * inverse_r;
        let w = 0.5 * inverse_r * select(h2 / (r - s), r + s, s > 0.0);
        var value = phase(medium, w) * inverse_r * inverse_r;
        if is_spot {
            value *= spot_falloff(light, (s * beside.along + beside.h * beside.across) * inverse_r);
        }
        sum += value * exp(-medium.extinction * (x + r));
    }
    return medium.scattering * light.intensity * sum * dx;
}

// The same of a directional light, unattenuated on its way to the ray.
fn march_directional(light: Light, ray: Ray, way: f32) -> vec3<f32> {
    let half = 0.5 * (light.direction + ray.direction);
    let dx = way / f32(steps);
    var sum = vec3<f32>(0.0);
    for (var i = 0u; i < steps; i++) {
        sum += exp(-medium.extinction * ((f32(i) + 0.5) * dx));
    }
    return medium.scattering * light.intensity * phase(medium, dot(half, half)) * sum * dx;
}

@compute @workgroup_size(8, 8)
fn main(@builtin(global_invocation_id) id: vec3<u32>) {
    let size = textureDimensions(radiance);
    if any(id.xy >= size) {
        return;
    }
    let ray = ray_of_pixel(camera, id.xy, size);
    let least = least_extinction(medium);
    var sum = vec3<f32>(0.0);
    if least > 0.0 {
        let way = min(textureLoad(depth, id.xy, 0).x, MARCH_DEPTH / least);
        for (var i = 0u; i < lights.count; i++) {
            if lights.items[i].kind == DIRECTIONAL {
                sum += march_directional(lights.items[i], ray, way);
            } else {
                sum += march(lights.items[i], ray, way);
            }
        }
    }
    textureStore(radiance, id.xy, vec4<f32>(sum, 1.0));
}
