// Light that a medium scatters once onto a surface, which reflects it, by a table over two numbers: Hong's J and J_k.
//
//   d         distance of the point light from the surface, m
//   T         sigma_t d
//   theta_s   angle between the light and the lobe's axis: the normal (Lambert) or the mirrored view ray (Phong)
//   n         exponent of the lobe: of Lambert's 1
//   gamma     angle between the light and the way that scattered light comes from
//   tau       see shaders/airlight_table.wgsl; along that way from tan(gamma/2) to infinity
//   K(gamma)  integral of max(cos, 0)^n over the directions at gamma about the light, cos taken from the lobe's axis
//
//   J(T, theta_s) = integral of K(gamma) A(gamma) dgamma over 0..pi                     (Hong 2006, eq. 4.13, 4.14)
//   A(gamma) = e^-T integral of p(mu) e^(-T sin(gamma) (tau - tan(gamma/2))) dtheta
//   J_k: P_k(mu) in place of p(mu), k = 0..3                                            (eq. 4.19)
//   L = I sigma_s/d (rho/pi J with n = 1 + k_s J with the lobe's n)                     (eq. 4.15)
// where eq. 4.13's e^(-T cos(gamma))/sin(gamma) (H - H) is A(gamma)/sin(gamma), in a form that neither cancels nor divides.
//
// What is not as printed: sigma_s for sigma_t, rho/pi for k_d, the 1/(4 pi) of eq. 4.20. The Phong lobe keeps the papers'
// hemisphere about the mirrored ray, not cut at the surface.
//
// The table is linear in both coordinates and holds both ends: texel (i, j) of n x n is J(10 i/(n-1), pi/2 j/(n-1)).
// Beyond T = 10 the lookup clamps. Beyond theta_s = pi/2 the thesis has no table: there the light is left out, so what
// turns away from a lamp stays black, although fog lights it.
//
// Biri, Arques and Michelin (2006, section III.C) have a table of T alone for Lambert, and one of T and cos(phi_S) for Phong,
// phi_S as theta_s there. With Gamma_l(T) = integral of P_l(cos gamma) A(gamma) dgamma over 0..pi:
//
//   published   2 pi cos(phi_n) Gamma_1                                                 (eq. 10 and 11)
//   clamped     sum over l = 0, 1, 2, 4 of 2 pi c_l P_l(cos phi_n) Gamma_l              in place of J^1
//   Gamma_P(T, phi_S) = J^n(T, phi_S)                                                   (eq. 12 and 13)
// Eq. 9 integrates over the whole sphere, so light from behind the surface is taken off: the sum is a vector irradiance. Its
// clamped form is the same field, convolved with max(cos, 0) = sum of c_l P_l up to degree 4 (Ramamoorthi and Hanrahan 2001).
// What is not as printed: in the exponents cos(alpha - phi) + sin(phi) for cos(alpha - phi) + 1; one l too many before eq. 10;
// in eq. 12 and 13 sin(phi)/sin(phi'), d phi d theta, and phi_S for phi'; a phase function with the integral 1.

#import scene
#import quadrature
#import airlight_table

// Light below this share of the lobe's largest value is left out: e^-16.
const LOBE_LEFT_OUT: f32 = 16.0;

// Nodes over gamma, of each of two pieces for broad lobes, whose K has a kink where the way runs in the surface; of one
// for sharp lobes.
const GAMMA_NODES: u32 = 48u;
const SHARP: f32 = 8.0;
const GAMMA_REACH: f32 = 11.0;  // of s, at an end: e^-11 of the piece is left out there

// What a texel stands for.
struct SurfacePlace {
    depth: f32,                 // T
    angle: f32,                 // theta_s, rad
}

fn depth_of_texel(texel: u32, size: u32) -> f32 {
    return TABLE_DEPTH * f32(texel) / f32(size - 1u);
}

fn place_of_texel(texel: vec2<u32>, size: vec2<u32>) -> SurfacePlace {
    let angle = HALF_PI * f32(texel.y) / f32(size.y - 1u);
    return SurfacePlace(depth_of_texel(texel.x, size.x), angle);
}

fn lobe_at(a: f32, b: f32, n: f32, phi: f32) -> f32 {
    return pow(max(a + b * cos(phi), 1e-30), n);
}

fn pair_at(a: f32, b: f32, n: f32, half: f32, node: vec2<f32>) -> f32 {
    return node.y * (lobe_at(a, b, n, half * (1.0 - node.x)) + lobe_at(a, b, n, half * (1.0 + node.x)));
}

// K by 12 Gauss-Legendre nodes over the half circle, or over its part that counts.
fn lobe_over_circle(gamma: f32, angle: f32, n: f32) -> f32 {
    let a = cos(gamma) * cos(angle);
    let b = sin(gamma) * sin(angle);
    let least = max(a + b, 0.0) * exp(-LOBE_LEFT_OUT / n);
    let half = 0.5 * acos(clamp((least - a) / max(b, 1e-30), -1.0, 1.0));
    let sum = pair_at(a, b, n, half, gauss_legendre(12u, 6u)) + pair_at(a, b, n, half, gauss_legendre(12u, 7u))
        + pair_at(a, b, n, half, gauss_legendre(12u, 8u)) + pair_at(a, b, n, half, gauss_legendre(12u, 9u))
        + pair_at(a, b, n, half, gauss_legendre(12u, 10u)) + pair_at(a, b, n, half, gauss_legendre(12u, 11u));
    return select(0.0, 2.0 * half * sum, a + b > 0.0);
}

// The same in a table whose rows are even in the cosine of the angle, from -1 to 1.
fn place_by_cosine(texel: vec2<u32>, size: vec2<u32>) -> SurfacePlace {
    let place = place_of_texel(texel, size);
    return SurfacePlace(place.depth, acos(clamp(place.angle / HALF_PI * 2.0 - 1.0, -1.0, 1.0)));
}

// A ring of directions about the light: dgamma, or a lobe's share K dgamma of it, and what comes along it from the light.
// The sum over a ring's nodes of weight f(w) is A(gamma) e^T.
struct Ring {
    gamma: f32,
    weight: f32,
    nodes: TauNodes,
}

// Ring i of GAMMA_NODES between two angles. gamma = start + length/(1 + e^-s), in equal steps of s; what comes from beside
// the light changes on the scale of the phase function's narrowest lobe, `width`.
fn ring_between(start: f32, length: f32, depth: f32, width: f32, i: u32) -> Ring {
    let least = select(-GAMMA_REACH, log(TAU_LEFT_OUT * min(1.0, width / length)), start == 0.0);
    let step = (GAMMA_REACH - least) / f32(GAMMA_NODES);
    let e = exp(-(least + (f32(i) + 0.5) * step));
    let share = 1.0 / (1.0 + e);
    let gamma = start + length * share;
    let weight = step * length * share * (e * share);
    return Ring(gamma, weight, tau_nodes(tan(0.5 * gamma), TAU_ENDLESS, depth * sin(gamma), width));
}

// Ring i of those of a lobe; `width` is that of the narrowest lobe of the phase function.
fn ring_of_lobe(place: SurfacePlace, n: f32, width: f32, i: u32) -> Ring {
    let reach = acos(exp(-LOBE_LEFT_OUT / n));
    let low = max(place.angle - reach, 0.0);
    let high = min(place.angle + reach, PI);
    let kink = clamp(HALF_PI - place.angle, low, high);
    let first = i < GAMMA_NODES;
    let broad = n < SHARP;
    let start = select(low, kink, broad && !first);
    let length = max(select(high, kink, broad && first) - start, 1e-6);
    var ring = ring_between(start, length, place.depth, width, i % GAMMA_NODES);
    ring.weight *= lobe_over_circle(ring.gamma, place.angle, n);
    return ring;
}

// J of a channel, 0 where the light is not in front.
fn j_at(table: texture_2d<f32>, weights: vec4<f32>, depth: f32, cosine: f32) -> f32 {
    let place = vec2<f32>(depth / TABLE_DEPTH, acos(saturate(cosine)) / HALF_PI);
    return select(0.0, dot(weights, bilinear(table, place)), cosine >= 0.0);
}

// P_0, P_1, P_2 and P_4.
fn zonal_polynomials(cosine: f32) -> vec4<f32> {
    let square = cosine * cosine;
    return vec4<f32>(1.0, cosine, 1.5 * square - 0.5, (4.375 * square - 3.75) * square + 0.375);
}

// c_l of max(cos, 0), l = 0, 1, 2, 4.
const CLAMPED_COSINE: vec4<f32> = vec4<f32>(0.25, 0.5, 0.3125, -0.09375);
