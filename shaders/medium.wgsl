// A medium along a ray: homogeneous, or with a density that falls exponentially with the height y.
//
//   sigma_t   extinction, 1/m; in height fog where the density is 1
//   density   e^(-(y - base height) * falloff), 1 in a homogeneous medium
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

// More than any light that is meant: what is brighter counts as this, so that products with it stay numbers.
const MOST_LIGHT: f32 = 1e30;

fn finite(light: vec3<f32>) -> vec3<f32> {
    return min(light, vec3<f32>(MOST_LIGHT));
}

// sigma_s/sigma_t; 0 where there is no extinction.
fn albedo(medium: Medium) -> vec3<f32> {
    return medium.scattering / max(medium.extinction, vec3<f32>(1e-30));
}

// The largest exponent of a density: what is denser counts as opaque.
const DENSITY_MAX: f32 = 80.0;

// At a height, m.
fn density_at(fog: HeightFog, height: f32) -> f32 {
    return exp(min((fog.base_height - height) * fog.falloff, DENSITY_MAX));
}

// The length of a way of density 1 that is as thick as `way` metres of a ray: the integral of the density along it, in
// closed form. The ray starts at `height` and climbs by `climb` in every metre. All that takes a way (transmittance,
// opacity) takes this one as well; in a homogeneous medium it is the way itself.
fn effective_way(fog: HeightFog, height: f32, climb: f32, way: f32) -> f32 {
    let x = min(way, ENDLESS);
    let rate = fog.falloff * climb;
    let z = rate * x;
    let density = density_at(fog, height);
    let end = exp(min((fog.base_height - height) * fog.falloff - z, DENSITY_MAX));
    // (1 - e^-z)/z by its series where z is small: the first term left out is 8e-7 of the sum, as is what the difference loses
    let series = density * x * (1.0 - z * (0.5 - z * (1.0 / 6.0 - z * (1.0 / 24.0))));
    let whole = (density - end) / rate;
    // the density is nowhere less than at both ends, also where both are more than f32 can tell apart
    return max(select(whole, series, abs(z) < 0.1), min(density, end) * x);
}

// Mean density along a straight way, from the densities at its ends; z is the logarithm of their ratio.
fn mean_density(start: f32, end: f32, z: f32) -> f32 {
    let series = start * (1.0 - z * (0.5 - z * (1.0 / 6.0 - z * (1.0 / 24.0))));
    return max(select((start - end) / z, series, abs(z) < 0.1), min(start, end));
}

// More than any extinction, 1/m.
const BEYOND_EXTINCTION: f32 = 3e38;

// The least extinction of the channels that scatter, 1/m; 0 where none does.
fn least_extinction(medium: Medium) -> f32 {
    let of_scattering = select(vec3<f32>(BEYOND_EXTINCTION), medium.extinction, medium.scattering > vec3<f32>(0.0));
    let least = min(min(of_scattering.x, of_scattering.y), of_scattering.z);
    return select(0.0, least, least < BEYOND_EXTINCTION);
}
