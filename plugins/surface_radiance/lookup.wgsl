// Light of every lamp that the medium scatters onto the nearest surface, and what of it goes to the eye, by tables, for the
// passes that differ in what the tables hold: see shaders/surface_table.wgsl.
#import scene
#import ray
#import medium
#import lights
#import light_sum
#import surface_table

var<uniform> camera: Camera;
var<uniform> medium: Medium;
var depth: texture_2d<f32>;
var normal: texture_2d<f32>;
var material: texture_2d_array<f32>;
var lambert: texture_2d<f32>;
var phong: texture_2d<f32>;
var radiance: texture_storage_2d<rgba32float, write>;

// A point of a surface.
struct Receiver {
    position: vec3<f32>,        // m
    normal: vec3<f32>,          // turned to the eye
    mirrored: vec3<f32>,        // the view ray, mirrored
    diffuse: vec3<f32>,         // rho
    specular: vec3<f32>,        // k_s
    weights: vec4<f32>,         // of the tables' channels
}

// Of one light, before the way to the eye. A spot counts as a point light of the intensity that it sends this way: the
// papers have none. No directional light is counted: it has no T.
fn received(light: Light, index: u32, receiver: Receiver) -> vec3<f32> {
    let incident = incident_light(light, receiver.position);
    let d = incident.way;
    let t = medium.extinction * d;
    let diffuse = j_of_channels(lambert, receiver.weights, t, dot(receiver.normal, incident.to_light));
    let specular = j_of_channels(phong, receiver.weights, t, dot(receiver.mirrored, incident.to_light));
    // irradiance is I/d^2
    let scale = select(incident.irradiance * d, vec3<f32>(0.0), light.kind == DIRECTIONAL);
    return scale * medium.scattering * (receiver.diffuse / PI * diffuse + receiver.specular * specular);
}

fn scattered_to_pixel(pixel: vec2<u32>, weights: vec4<f32>) {
    let size = textureDimensions(radiance);
    if any(pixel >= size) {
        return;
    }
    let way = textureLoad(depth, pixel, 0).x;
    var sum = vec3<f32>(0.0);
    if way < ENDLESS {
        let ray = ray_of_pixel(camera, pixel, size);
        let toward_eye = normal_toward_eye(textureLoad(normal, pixel, 0).xyz, ray.direction);
        let receiver = Receiver(ray.origin + way * ray.direction, toward_eye, reflect(ray.direction, toward_eye),
            textureLoad(material, pixel, 0, 0).xyz, textureLoad(material, pixel, 1, 0).xyz, weights);
        sum = received_of_all(receiver) * transmittance(medium, way);
    }
    textureStore(radiance, pixel, vec4<f32>(sum, 1.0));
}
