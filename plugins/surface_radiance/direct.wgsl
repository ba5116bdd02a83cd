// Light -> surface -> eye, of every light of the scene, in a homogeneous medium or in height fog.
#import scene
#import ray
#import medium
#import lights
#import light_sum

var<uniform> camera: Camera;
var<uniform> medium: Medium;
var<uniform> height_fog: HeightFog;
var depth: texture_2d<f32>;
var normal: texture_2d<f32>;
var material: texture_2d_array<f32>;
var radiance: texture_storage_2d<rgba32float, write>;

// A point of a surface, see direct_share of shaders/lights.wgsl.
struct Receiver {
    position: vec3<f32>,        // m
    normal: vec3<f32>,
    mirrored: vec3<f32>,
    rho: vec3<f32>,
    phong: vec4<f32>,           // k_s, n
}

// L of one light, before the way to the eye.
fn received(light: Light, index: u32, receiver: Receiver) -> vec3<f32> {
    let incident = incident_light(light, receiver.position);
    let through = effective_way(height_fog, receiver.position.y, incident.to_light.y, incident.way);
    let share = direct_share(receiver.rho, receiver.phong.xyz, receiver.phong.w, receiver.normal, receiver.mirrored, incident.to_light);
    return share * incident.irradiance * transmittance(medium, through);
}

@compute @workgroup_size(8, 8)
fn main(@builtin(global_invocation_id) id: vec3<u32>) {
    let size = textureDimensions(radiance);
    if any(id.xy >= size) {
        return;
    }
    let way = textureLoad(depth, id.xy, 0).x;
    var sum = vec3<f32>(0.0);
    if way < ENDLESS {
        let ray = ray_of_pixel(camera, id.xy, size);
        let toward_eye = textureLoad(normal, id.xy, 0).xyz;
        let receiver = Receiver(ray.origin + way * ray.direction, toward_eye, reflect(ray.direction, toward_eye),
            textureLoad(material, id.xy, 0, 0).xyz, textureLoad(material, id.xy, 1, 0));
        sum = received_of_all(receiver) * transmittance(medium, effective_way(height_fog, ray.origin.y, ray.direction.y, way));
    }
    textureStore(radiance, id.xy, vec4<f32>(sum, 1.0));
}
