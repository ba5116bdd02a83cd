// Airlight of a point light by a table over two numbers, as the papers look it up: Hong's H and H_k.
//
//   theta     angle at the light from the ray's nearest point, the foot; grows along the ray from -pi/2 to pi/2
//   tau       tan(theta/2 + pi/4) = (1 + sin(theta))/cos(theta), 0 to infinity: v of airlight_pieces.wgsl
//   u         sigma_t h, the optical depth of the light's distance h from the ray
//   w         sin^2 of half the scattering angle, tau^2/(1 + tau^2); mu = 1 - 2 w = -sin(theta)
//   t, x      foot of the ray and a place on it, m from the eye
//   b_k       mean of P_k over the phase function, `Phase.legendre`; of Henyey and Greenstein's function g^k
//
//   H(u, theta)   = integral of p(mu) e^(-u tau) dtheta from -pi/2 to theta             (Hong 2006, eq. 4.7)
//   H_k(u, theta) = the same of P_k(mu) in place of p(mu), k = 0..3                     (eq. 4.17)
//   L = sigma_s I e^(-sigma_t t)/h (H(u, theta_d) - H(u, theta_0))                      (eq. 4.6)
//   H = sum of (2k + 1)/(4 pi) b_k H_k, where the series of the phase function ends at k = 3    (eq. 4.16, 4.18)
// Biri's Gamma (Biri, Arques and Michelin 2006, eq. 6) is 4 pi (H(u, theta) - H(u, 0)): the same function from another
// zero, for phase functions whose integral is 4 pi. Differences of the two are the same, so their pictures are, too.
//
// What is not as printed: sigma_s = albedo sigma_t stands in front (the thesis has sigma_t), theta = atan2(x - t, h) has a
// sign (Table 4.1 and figures 4.8 and 4.9 lose it), the sum of eq. 4.18 has its 1/(4 pi), and the exponent of eq. 6 is
// -lambda tau, without a second k_t.
//
// The table is linear in both coordinates and holds both ends: texel (i, j) of n x n is H(10 i/(n-1), pi (j/(n-1) - 1/2)).
// The papers say no more of the range than the axes of their figures; beyond u = 10 their lookup clamps, and so does this.

#import scene
#import medium
#import ray
#import cone
#import airlight_pieces

// The largest u of the table.
const TABLE_DEPTH: f32 = 10.0;

// P_0 to P_3.
fn legendre_polynomials(mu: f32) -> vec4<f32> {
    return vec4<f32>(1.0, mu, 1.5 * mu * mu - 0.5, mu * (2.5 * mu * mu - 1.5));
}

// (2k + 1)/(4 pi) b_k: what a sum over H_k, J_k or P_k is weighted with.
fn series_weights(phase: Phase) -> vec4<f32> {
    return vec4<f32>(1.0, 3.0, 5.0, 7.0) * 0.07957747154594767 * phase.legendre;
}

// The narrower lobe's width; 1 for polynomials, and of a lobe that is not there.
fn least_width(phase: Phase) -> f32 {
    return min(phase.lobes[0].rho, phase.lobes[1].rho);
}

// Nodes of the integral of f(w) e^(-rate z) dtheta over tau = start + z, 0 <= z <= length. With z = reach/(1 + e^-s) all
// that happens in z has a width near 1 in s, however narrow a lobe is, and the integrand falls to 0 at both ends: equal
// steps in s then err by 1e-5 at most, where at an end of the range 1e-6 is left out.
struct TauNodes {
    start: f32,
    rate: f32,
    reach: f32,
    low: f32,
    step: f32,
}

const TAU_NODES: u32 = 64u;
const TAU_LEFT_OUT: f32 = 1e-6;
const TAU_ENDLESS: f32 = 1e30;

// `width` is that of the narrowest lobe of f.
fn tau_nodes(start: f32, length: f32, rate: f32, width: f32) -> TauNodes {
    // behind twice 17/rate, or far beyond 1, nothing is left; a cut there goes through the middle, s = 0
    let fading = 1.0 / max(rate, 1e-30);
    let end = min(2.0 * max(1.0, start) / TAU_LEFT_OUT, 34.0 * fading);
    let reach = min(length, end);
    let high = select(14.0, 0.0, end < length);
    let scale = min(min(max(start, width), 1.0), min(fading, reach));
    let low = log(TAU_LEFT_OUT * scale / reach);
    return TauNodes(start, rate, reach, low, (high - low) / f32(TAU_NODES));
}

struct TauNode {
    w: f32,
    weight: f32,
}

fn tau_node(nodes: TauNodes, i: u32) -> TauNode {
    let s = nodes.low + (f32(i) + 0.5) * nodes.step;
    let e = exp(-s);
    let share = 1.0 / (1.0 + e);
    let z = nodes.reach * share;
    let tau = nodes.start + z;
    let inverse = 1.0 / (1.0 + tau * tau);
    let weight = nodes.step * z * (e * share) * 2.0 * inverse * exp(-nodes.rate * z);
    return TauNode(tau * tau * inverse, weight);
}

// The nodes of H at a texel; `width` is that of the narrowest lobe of the phase function.
fn nodes_of_texel(texel: vec2<u32>, size: vec2<u32>, width: f32) -> TauNodes {
    let share = vec2<f32>(texel) / vec2<f32>(max(size, vec2<u32>(2u)) - 1u);
    // the tangent of half a right angle more than theta/2, where theta = pi/2 has none
    let length = select(tan(HALF_PI * share.y), TAU_ENDLESS, texel.y + 1u >= size.y);
    return tau_nodes(0.0, length, TABLE_DEPTH * share.x, width);
}

// A table at a place, 0 to 1 from its first to its last texels, clamped, bilinear. By hand: not every device filters f32.
fn bilinear(table: texture_2d<f32>, place: vec2<f32>) -> vec4<f32> {
    let last = vec2<f32>(textureDimensions(table)) - 1.0;
    let at = saturate(place) * last;
    let low = floor(at);
    let part = at - low;
    let a = vec2<u32>(low);
    let b = vec2<u32>(min(low + 1.0, last));
    let first = mix(textureLoad(table, a, 0), textureLoad(table, vec2<u32>(b.x, a.y), 0), part.x);
    let second = mix(textureLoad(table, vec2<u32>(a.x, b.y), 0), textureLoad(table, b, 0), part.x);
    return mix(first, second, part.y);
}

// H of each channel's u.
fn h_at(table: texture_2d<f32>, weights: vec4<f32>, u: vec3<f32>, theta: f32) -> vec3<f32> {
    let across = u / TABLE_DEPTH;
    let up = theta / (2.0 * HALF_PI) + 0.5;
    return vec3<f32>(
        dot(weights, bilinear(table, vec2<f32>(across.x, up))),
        dot(weights, bilinear(table, vec2<f32>(across.y, up))),
        dot(weights, bilinear(table, vec2<f32>(across.z, up))),
    );
}

// Parts of a spot's lit interval, over each of which cos^N is taken as it is in the middle: the thesis finds no way to
// bring it out of the integral (section 6.2.1), so this is a sum over differences of H.
const SPOT_PARTS: u32 = 8u;

// Where a part of an interval, given in tau, lies in theta.
fn angles_of(lit: vec2<f32>, whole: vec2<f32>) -> vec2<f32> {
    let angles = 2.0 * atan(lit) - HALF_PI;
    let low = clamp(angles.x, whole.x, whole.y);
    return vec2<f32>(low, clamp(angles.y, low, whole.y));
}

// Light of a lamp without sigma_s I: e^(-sigma_t t)/h (H(u, theta_d) - H(u, theta_0)), the difference in parts for a spot.
// A light so far behind the eye that the first factor has no number in f32 leaves nothing.
fn lamp_by_table(table: texture_2d<f32>, weights: vec4<f32>, light: Light, ray: Ray, way: f32, extinction: vec3<f32>) -> vec3<f32> {
    let beside = light_beside_ray(light, ray);
    let whole = vec2<f32>(atan2(-beside.t, beside.h), atan2(min(way, WAY_MAX) - beside.t, beside.h));
    let is_spot = light.kind == SPOT;
    let spot = spot_beside_ray(light, ray.direction, beside.from_light, tan(0.5 * whole.x + QUARTER_PI), V_MAX, 1.0);
    let first = select(whole, angles_of(spot.first, whole), is_spot);
    let second = angles_of(spot.second, whole);
    let parts = select(1u, SPOT_PARTS, is_spot);
    let edges = (parts + 1u) * select(1u, 2u, is_spot && second.y > second.x);
    var sum = vec3<f32>(0.0);
    var before = vec3<f32>(0.0);
    // over the edges of the parts, in a loop as every_light.wgsl has it
    var i = 0u;
    loop {
        let edge = i % (parts + 1u);
        let lit = select(first, second, i > parts);
        let part = (lit.y - lit.x) / f32(parts);
        let h = h_at(table, weights, extinction * beside.h, lit.x + f32(edge) * part);
        let middle = lit.x + (f32(edge) - 0.5) * part;
        let cosine = spot.along * sin(middle) + spot.across * cos(middle);
        let falloff = select(1.0, pow(max(cosine, 1e-30), light.exponent), is_spot);
        sum += select(0.0, falloff, edge > 0u) * (h - before);
        before = h;
        i++;
        if i >= edges { break; }
    }
    let exponent = -extinction * beside.t;
    return select(vec3<f32>(0.0), sum * exp(exponent) / beside.h, exponent < vec3<f32>(80.0));
}

// Airlight of one light over `way` metres of the ray. `scattering` is the phase function at the angle between a directional
// light and the ray: that light needs no table, as it reaches every point unattenuated (see directional_airlight).
fn airlight_by_table(table: texture_2d<f32>, weights: vec4<f32>, light: Light, medium: Medium, ray: Ray, way: f32, scattering: f32) -> vec3<f32> {
    if light.kind == DIRECTIONAL {
        return albedo(medium) * light.intensity * scattering * opacity(medium, way);
    }
    return medium.scattering * light.intensity * lamp_by_table(table, weights, light, ray, way, medium.extinction);
}
