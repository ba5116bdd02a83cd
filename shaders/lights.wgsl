// What reaches a point from a light, without what the medium takes.
//
//   d     distance of the light, m

#import scene
#import cone

struct IncidentLight {
    to_light: vec3<f32>,        // unit vector
    irradiance: vec3<f32>,      // W/m^2 on a surface that faces the light, before extinction
    on_axis: vec3<f32>,         // the same if the point lay on the axis of the spot
    way: f32,                   // m through the medium; Directional: 0, its irradiance reaches every point as it is
}

// Point and spot I/d^2, d floored at the light's radius. At the light itself it comes from above.
fn incident_light(light: Light, position: vec3<f32>) -> IncidentLight {
    if light.kind == DIRECTIONAL {
        return IncidentLight(-light.direction, light.intensity, light.intensity, 0.0);
    }
    let away = light.position - position;
    let distance = length(away);
    let d = max(distance, max(light.radius, 1e-12));
    let to_light = select(vec3<f32>(0.0, 1.0, 0.0), away / distance, distance > 1e-12);
    let falloff = select(1.0, spot_falloff(light, -dot(light.direction, to_light)), light.kind == SPOT);
    let on_axis = light.intensity / (d * d);
    return IncidentLight(to_light, on_axis * falloff, on_axis, d);
}
