// What reaches a point from a light, without what the medium takes, and what a surface there makes of it.
//
//   d         distance of the light, m
//   rho       Lambert reflectance; the BRDF is rho/pi
//   k_s, n    Phong lobe
//   alpha     angle between the light and the mirrored view ray

#import scene
#import cone
#import medium

// Which lights reach a point: a bit for each, 32 in each of four channels.
const BITS_OF_CHANNEL: u32 = 32u;

// The bit of a light; none beyond the 128 that there is room for.
fn bit_of_light(light: u32) -> vec4<u32> {
    let channel = vec4<u32>(0u, 1u, 2u, 3u) == vec4<u32>(light / BITS_OF_CHANNEL);
    return select(vec4<u32>(0u), vec4<u32>(1u << (light % BITS_OF_CHANNEL)), channel);
}

// Whether a light is among them; beyond those that there is room for all are.
fn has_light(bits: vec4<u32>, light: u32) -> bool {
    let bit = bit_of_light(light);
    return all((bits & bit) == bit);
}

struct IncidentLight {
    to_light: vec3<f32>,        // unit vector
    irradiance: vec3<f32>,      // W/m^2 on a surface that faces the light, before extinction
    on_axis: vec3<f32>,         // the same if the point lay on the axis of the spot
    way: f32,                   // m through the medium; Directional: 0, its irradiance reaches every point as it is
}

// Point and spot I/d^2, d floored at the light's radius. At the light itself it comes from nowhere.
fn incident_light(light: Light, position: vec3<f32>) -> IncidentLight {
    if light.kind == DIRECTIONAL {
        return IncidentLight(-light.direction, light.intensity, light.intensity, 0.0);
    }
    let away = light.position - position;
    let distance = max(length(away), 1e-12);
    let d = max(distance, light.radius);
    let to_light = away / distance;
    let falloff = select(1.0, spot_falloff(light, -dot(light.direction, to_light)), light.kind == SPOT);
    let on_axis = finite(light.intensity / (d * d));
    return IncidentLight(to_light, on_axis * falloff, on_axis, d);
}

// The part of a light's irradiance that a surface sends to the eye: rho/pi n.l + k_s cos^n alpha, where n.l > 0, else 0
// (Hong 2006, eq. 4.12, with the BRDF rho/pi). The Phong term has no cosine of incidence, as in the papers. `normal` is
// turned to the eye; all vectors are unit vectors.
fn direct_share(rho: vec3<f32>, k_s: vec3<f32>, n: f32, normal: vec3<f32>, mirrored: vec3<f32>, to_light: vec3<f32>) -> vec3<f32> {
    let cosine = dot(normal, to_light);
    let cos_alpha = dot(mirrored, to_light);
    let lobe = select(0.0, pow(max(cos_alpha, 1e-30), n), cos_alpha > 0.0);
    return select(vec3<f32>(0.0), rho / PI * cosine + k_s * lobe, cosine > 0.0);
}
