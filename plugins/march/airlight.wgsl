// Airlight by brute force, to compare with: equal steps along the ray, the integrand at their middles, with the phase
// functions, falloffs and floor of h of all other passes (shaders/phase.wgsl, cone.wgsl, airlight_pieces.wgsl).
//
//   x, t, h, s, r   as in shaders/airlight_pieces.wgsl
//   w               sin^2 of half the scattering angle, (r + s)/(2 r), known to 1e-7: of lobes with g above 0.99 the peak
//                   is off by 0.3 % and more, as 1e-7 is no longer small beside ((1-g)/(1+g))^2
//
// Where shadows are asked for, a ray at the triangles says of every point whether the light reaches it; or, with `maps`, a
// shadow map does, as in engines.
//
// L = sum over the steps of sigma_s p(w) I/r^2 e^(-sigma_t (x + r)) dx, to the surface or to MARCH_DEPTH.
#import scene
#import ray
#import medium
#import phase
#import cone
#import airlight_pieces
#import light_sum
#import shadow_map
#import unfinished
#import "occluders.wgsl"

// Optical depth along the ray, of the channel of least extinction, at which the march ends.
const MARCH_DEPTH: f32 = 16.0;

// Whether a march ended before it was done.
var<private> stopped: bool = false;

override steps: u32 = 256;
override shadows: bool = false;
override maps: bool = false;

var<uniform> camera: Camera;
var<uniform> medium: Medium;
var<uniform> phase: Phase;
var depth: texture_2d<f32>;
var shadow_map: texture_2d_array<f32>;
var radiance: texture_storage_2d<rgba32float, write>;

// What there is at a point x metres along the ray.
struct Sample {
    density: f32,               // p/r^2, 1/(sr m^2)
    path: f32,                  // x + r, m
    sine: f32,                  // s/r and h/r: of the angle theta at the light
    cosine: f32,
}

fn sample_at(x: f32, beside: LightBesideRay, scattering: Phase) -> Sample {
    let s = x - beside.t;
    let r2 = beside.h * beside.h + s * s;
    let inverse_r = inverseSqrt(r2);
    let r = r2 * inverse_r;
    let w = 0.5 + 0.5 * s * inverse_r;
    return Sample(phase_at(scattering, w) * inverse_r * inverse_r, x + r, s * inverse_r, beside.h * inverse_r);
}

// A light of the list, and its place in the shadow map.
struct Marched {
    light: Light,
    index: u32,
    tiles: Tiles,
}

// Of the steps from this one on those that the light does not reach, as bits: of rays looked up anew for every 32nd step,
// of a map this step alone.
fn hidden_steps(known: u32, marched: Marched, ray: Ray, step: u32, dx: f32) -> u32 {
    var hidden = known >> 1u;
    let x = (f32(step) + 0.5) * dx;
    if shadows && maps {
        hidden = u32(is_hidden_in_map(shadow_map, marched.tiles, marched.light, marched.index, ray.origin + x * ray.direction));
    } else if shadows && step % 32u == 0u {
        hidden = hidden_points(marched.light, ray, x, dx);
    }
    return hidden;
}

fn march_point(marched: Marched, beside: LightBesideRay, scattering: Phase, ray: Ray, way: f32) -> vec3<f32> {
    let light = marched.light;
    let dx = way / f32(steps);
    let count = select(0u, steps, light.kind == POINT);
    var sum = vec3<f32>(0.0);
    var hidden = 0u;
    var i = 0u;
    for (; i < count; i++) {
        hidden = hidden_steps(hidden, marched, ray, i, dx);
        let point = sample_at((f32(i) + 0.5) * dx, beside, scattering);
        sum += f32(~hidden & 1u) * point.density * exp(-medium.extinction * point.path);
    }
    stopped = stopped || i < count;
    return finite(medium.scattering * light.intensity * (sum * dx));
}

fn march_spot(marched: Marched, beside: LightBesideRay, scattering: Phase, ray: Ray, way: f32) -> vec3<f32> {
    let light = marched.light;
    let dx = way / f32(steps);
    let count = select(0u, steps, light.kind == SPOT);
    let along = dot(light.direction, ray.direction);
    let across = dot(light.direction, beside.from_light);
    var sum = vec3<f32>(0.0);
    var hidden = 0u;
    var i = 0u;
    for (; i < count; i++) {
        hidden = hidden_steps(hidden, marched, ray, i, dx);
        let point = sample_at((f32(i) + 0.5) * dx, beside, scattering);
        let falloff = spot_falloff(light, along * point.sine + across * point.cosine);
        sum += f32(~hidden & 1u) * point.density * falloff * exp(-medium.extinction * point.path);
    }
    stopped = stopped || i < count;
    return finite(medium.scattering * light.intensity * (sum * dx));
}

// The irradiance of a directional light reaches every point unattenuated.
fn march_directional(marched: Marched, scattering: Phase, ray: Ray, way: f32) -> vec3<f32> {
    let light = marched.light;
    let dx = way / f32(steps);
    let count = select(0u, steps, light.kind == DIRECTIONAL);
    var sum = vec3<f32>(0.0);
    var hidden = 0u;
    var i = 0u;
    for (; i < count; i++) {
        hidden = hidden_steps(hidden, marched, ray, i, dx);
        sum += f32(~hidden & 1u) * exp(-medium.extinction * ((f32(i) + 0.5) * dx));
    }
    stopped = stopped || i < count;
    let scattered = phase_at(scattering, w_toward_eye(light.direction + ray.direction));
    return finite(medium.scattering * light.intensity * (scattered * sum * dx));
}

struct Receiver {
    ray: Ray,
    way: f32,                   // m
    scattering: Phase,
    tiles: Tiles,
}

fn received(light: Light, index: u32, receiver: Receiver) -> vec3<f32> {
    let marched = Marched(light, index, receiver.tiles);
    let beside = light_beside_ray(light, receiver.ray);
    return march_point(marched, beside, receiver.scattering, receiver.ray, receiver.way)
        + march_spot(marched, beside, receiver.scattering, receiver.ray, receiver.way)
        + march_directional(marched, receiver.scattering, receiver.ray, receiver.way);
}

@compute @workgroup_size(8, 8)
fn main(@builtin(global_invocation_id) id: vec3<u32>) {
    let size = textureDimensions(radiance);
    let ray = ray_of_pixel(camera, id.xy, size);
    let least = max(least_extinction(medium), 1e-30);
    let way = min(textureLoad(depth, id.xy, 0).x, min(MARCH_DEPTH / least, WAY_MAX));
    let tiles = tiles_of(lights.count, textureDimensions(shadow_map).x);
    let sum = received_of_all(Receiver(ray, way, phase, tiles));
    if all(id.xy < size) {
        textureStore(radiance, id.xy, vec4<f32>(select(vec3<f32>(0.0), sum, medium.scattering > vec3<f32>(0.0)), 1.0));
        if lights_missed || stopped || occluders_missed {
            tell_unfinished();
        }
    }
}
