// What reaches a point from a light, without what the medium takes.
//
//   d     distance of the light, m

#import scene
#import cone

struct Incident {
    to_light: vec3<f32>,        // unit vector
    irradiance: vec3<f32>,      // W/m^2 on a surface that faces the light, before extinction
    way: f32,                   // m through the medium; Directional: 0, its irradiance reaches every point as it is
}

// Point and spot I/d^2; d is floored like h (see airlight.wgsl): at the light's radius.
fn incident(light: Light, position: vec3<f32>) -> Incident {
    if light.kind == DIRECTIONAL {
        return Incident(-light.direction, light.intensity, 0.0);
    }
    let away = light.position - position;
    let d = max(length(away), max(light.radius, 1e-12));
    let to_light = away / d;
    var intensity = light.intensity;
    if light.kind == SPOT {
        intensity *= spot_falloff(light, -dot(light.direction, to_light));
    }
    return Incident(to_light, intensity / (d * d), d);
}
