// Light -> surface -> eye, of every light of the scene, in a homogeneous medium or in height fog.
#import scene
#import ray
#import medium
#import lights

var<uniform> camera: Camera;
var<uniform> medium: Medium;
var<uniform> height_fog: HeightFog;
var<storage, read> lights: Lights;
var depth: texture_2d<f32>;
var normal: texture_2d<f32>;
var material: texture_2d_array<f32>;
var radiance: texture_storage_2d<rgba32float, write>;

// L of one light at a surface, before the way to the eye; see direct_share of shaders/lights.wgsl.
fn reflected(light: Light, position: vec3<f32>, normal: vec3<f32>, mirrored: vec3<f32>, rho: vec3<f32>, phong: vec4<f32>) -> vec3<f32> {
    let incident = incident_light(light, position);
    let through = effective_way(height_fog, position.y, incident.to_light.y, incident.way);
    return direct_share(rho, phong.xyz, phong.w, normal, mirrored, incident.to_light) * incident.irradiance * transmittance(medium, through);
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
        let outward = textureLoad(normal, id.xy, 0).xyz;
        let toward_eye = select(outward, -outward, dot(outward, ray.direction) > 0.0);
        let mirrored = reflect(ray.direction, toward_eye);
        let position = ray.origin + way * ray.direction;
        let rho = textureLoad(material, id.xy, 0, 0).xyz;
        let phong = textureLoad(material, id.xy, 1, 0);
        // a list without lights holds one of intensity 0; why the test stands at the end: see shaders/airlight.wgsl
        var i = 0u;
        loop {
            sum += reflected(lights.items[i], position, toward_eye, mirrored, rho, phong);
            i++;
            if i >= lights.count { break; }
        }
        sum *= transmittance(medium, effective_way(height_fog, ray.origin.y, ray.direction.y, way));
    }
    textureStore(radiance, id.xy, vec4<f32>(sum, 1.0));
}
