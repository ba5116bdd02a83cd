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

// 1 - T without cancellation: where sigma_t x is small its series, of which the first term left out is 1e-7 of the sum.
fn opacity(medium: Medium, way: f32) -> vec3<f32> {
    let depth = medium.extinction * min(way, ENDLESS);
    let series = depth * (1.0 - depth * (0.5 - depth * (1.0 / 6.0 - depth * (1.0 / 24.0))));
    return select(1.0 - exp(-depth), series, depth < vec3<f32>(0.06));
}

// More than any extinction, 1/m.
const BEYOND_EXTINCTION: f32 = 3e38;

// The least extinction of the channels that scatter, 1/m; 0 where none does.
fn least_extinction(medium: Medium) -> f32 {
    let of_scattering = select(vec3<f32>(BEYOND_EXTINCTION), medium.extinction, medium.scattering > vec3<f32>(0.0));
    let least = min(min(of_scattering.x, of_scattering.y), of_scattering.z);
    return select(0.0, least, least < BEYOND_EXTINCTION);
}
