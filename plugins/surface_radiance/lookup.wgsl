// Light of every lamp that the medium scatters onto the nearest surface, and what of it goes to the eye, by tables, for the
// passes that differ in what the tables hold: see shaders/surface_table.wgsl.
#import scene
#import ray
#import medium
#import lights
#import light_sum
#import surface_table
#import "ambient.wgsl"

var<uniform> camera: Camera;
var<uniform> medium: Medium;
var depth: texture_2d<f32>;
var normal: texture_2d<f32>;
var material: texture_2d_array<f32>;
var radiance: texture_storage_2d<rgba32float, write>;

// What a lobe of factor 1 receives, as J does: Lambert's (x) and Phong's (y), by T and the cosines of the angles between the
// light and the lobes' axes.
#require fn lobes_at(depth: f32, cosines: vec2<f32>) -> vec2<f32>

// A point of a surface.
struct Receiver {
    position: vec3<f32>,        // m
    normal: vec3<f32>,          // turned to the eye
    mirrored: vec3<f32>,        // the view ray, mirrored
    diffuse: vec3<f32>,         // rho
    specular: vec3<f32>,        // k_s
}

// Of one light, before the way to the eye. A spot counts as a point light of the intensity that it sends this way: the
// papers have none. No directional light is counted: it has no T.
fn received(light: Light, index: u32, receiver: Receiver) -> vec3<f32> {
    let incident = incident_light(light, receiver.position);
    let cosines = vec2<f32>(dot(receiver.normal, incident.to_light), dot(receiver.mirrored, incident.to_light));
    let depth = medium.extinction * incident.way;
    let lobes = transpose(mat3x2<f32>(
        lobes_at(depth.x, cosines), lobes_at(depth.y, cosines), lobes_at(depth.z, cosines)));
    // irradiance is I/d^2
    let scale = select(incident.irradiance * incident.way, vec3<f32>(0.0), light.kind == DIRECTIONAL);
    return scale * medium.scattering * (receiver.diffuse / PI * lobes[0] + receiver.specular * lobes[1]);
}

fn scattered_to_pixel(pixel: vec2<u32>) {
    let size = textureDimensions(radiance);
    if any(pixel >= size) {
        return;
    }
    let way = textureLoad(depth, pixel, 0).x;
    var sum = vec3<f32>(0.0);
    if way < ENDLESS {
        let ray = ray_of_pixel(camera, pixel, size);
        let toward_eye = textureLoad(normal, pixel, 0).xyz;
        let diffuse = textureLoad(material, pixel, 0, 0).xyz;
        let phong = textureLoad(material, pixel, 1, 0);
        let receiver = Receiver(ray.origin + way * ray.direction, toward_eye, reflect(ray.direction, toward_eye),
            diffuse, phong.xyz);
        let from_medium = ambient_reflected(medium, diffuse, phong.xyz, phong.w);
        sum = (received_of_all(receiver) + from_medium) * transmittance(medium, way);
    }
    textureStore(radiance, pixel, vec4<f32>(sum, 1.0));
}
