// A homogeneous medium along a ray.
//
//   sigma_t   extinction, 1/m
//   x         length of the way, m; infinite where the ray meets nothing
//   T         transmittance, e^(-sigma_t x)

#import scene

// A way of this length, m, or more has no end: what textures hold where a ray meets nothing is infinite.
const ENDLESS: f32 = 1e30;

// T along a way: 1 where there is no extinction, however long the way is.
fn transmittance(medium: Medium, way: f32) -> vec3<f32> {
    return exp(-medium.extinction * min(way, ENDLESS));
}

// 1 - e^(-x) without cancellation: its series where x is small, of which the first term left out is x^5/120.
fn opacity(depth: vec3<f32>) -> vec3<f32> {
    let series = depth * (1.0 - depth * (0.5 - depth * (1.0 / 6.0 - depth * (1.0 / 24.0))));
    return select(1.0 - exp(-depth), series, depth < vec3<f32>(0.1));
}

// More than any extinction, 1/m.
const NO_EXTINCTION_IS_MORE: f32 = 3e38;

// The least extinction of the channels that scatter, 1/m; 0 where none does.
fn least_extinction(medium: Medium) -> f32 {
    let of_scattering = select(vec3<f32>(NO_EXTINCTION_IS_MORE), medium.extinction, medium.scattering > vec3<f32>(0.0));
    let least = min(min(of_scattering.x, of_scattering.y), of_scattering.z);
    return select(0.0, least, least < NO_EXTINCTION_IS_MORE);
}
