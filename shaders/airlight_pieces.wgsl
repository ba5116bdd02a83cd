// Light scattered once toward the eye along a ray through a homogeneous medium (airlight), by Gauss-Legendre quadrature.
//
//   x         distance from the eye along the ray, m
//   l         distance of the light from the eye, m
//   t         where the ray is nearest to the light (its foot), m; below 0 behind the eye
//   h         distance of the light from the ray, m, floored
//   s, r      x - t, and the distance of the light from the point, sqrt(h^2 + s^2), m
//   v         (r + s)/h = tan(pi/4 + theta/2), theta = atan(s/h) the angle at the light (the papers' theta)
//   sigma_t, sigma_s   extinction and scattering coefficient, 1/m
//   p, mu, rho         phase function, cosine of the scattering angle, width of a lobe: see phase.wgsl
//   psi       angle of a node: v = rho tan(psi/2), 0..pi along an endless line
//   y         tan(psi/2 - psi_m/2), psi_m the middle of the interval in psi; from -reach to reach
//
// With v, both optical paths and the scattering angle are rational: x + r = t + h v, mu = (1 - v^2)/(1 + v^2), and
//   L = sigma_s I/h * integral of p(mu) e^(-sigma_t (t + h v)) 2/(1 + v^2) dv
// (Hong 2006, eq. 4.3; Biri, Arques and Michelin 2006, eq. 4; both in theta). In psi a lobe is nearly constant:
//   p 2/(1 + v^2) dv = scale/rho^2 * Q^(1/2) dpsi,   Q = cos^2(psi/2) + rho^2 sin^2(psi/2)
// and, of Schlick's function, scale/rho^3 * Q dpsi. In y all of it is algebraic: no trigonometric function is needed.
//
// A measured phase function is not a lobe. There the nodes are spaced evenly in its own integral instead:
//   rest      integral of p over scattering angles a from the point's on, 0..pi; v = tan(a/2)
//   L = sigma_s I/h * integral of e^(-sigma_t (t + h v)) d rest
// so what is left to integrate is smooth whatever the function is: importance sampling without chance.
//
// Loops have the shape that every_light.wgsl gives reasons for, and branches are choices between values: software Vulkan runs
// both sides of every branch.

#import scene
#import medium
#import phase
#import cone
#import ray

// Ways longer than this, m, count as this long, so that squares stay finite.
const WAY_MAX: f32 = 1e12;

// Where a light stands beside a ray.
struct LightBesideRay {
    t: f32,
    h: f32,
    from_light: vec3<f32>,      // unit vector from the light to the foot; no unit vector where the ray meets the light
}

// h is floored at the light's radius and at 1e-6 of the light's distance, as airlight grows like 1/h.
fn light_beside_ray(light: Light, ray: Ray) -> LightBesideRay {
    let to_light = light.position - ray.origin;
    // by cross products, as to_light - t * direction cancels near the light
    let away = cross(to_light, ray.direction);
    let true_h2 = dot(away, away);
    let floor_h2 = max(light.radius * light.radius, max(1e-12 * dot(to_light, to_light), 1e-24));
    let from_light = cross(away, ray.direction) * inverseSqrt(max(true_h2, 1e-30));
    return LightBesideRay(dot(to_light, ray.direction), sqrt(max(true_h2, floor_h2)), from_light);
}

// So that squares of v stay finite.
const MOST_V: f32 = 1e15;

// A part of the ray in v. The width is kept beside the start, as their difference would cancel.
struct Interval {
    start: f32,
    width: f32,
}

// The first `way` metres of the ray.
fn interval_of_way(beside: LightBesideRay, way: f32) -> Interval {
    return interval_between(beside, 0.0, way);
}

// From x0 to x1 metres of the ray: v = (r + s)/h, behind the foot h/(r - s), and v1 - v0 = (x1 - x0) (v0 + v1)/(r0 + r1).
fn interval_between(beside: LightBesideRay, near: f32, far: f32) -> Interval {
    let x0 = clamp(near, 0.0, WAY_MAX);
    let x = clamp(far, 0.0, WAY_MAX) - x0;
    let h = beside.h;
    let s0 = x0 - beside.t;
    let s1 = x0 + x - beside.t;
    let r0 = sqrt(h * h + s0 * s0);
    let r1 = sqrt(h * h + s1 * s1);
    let v0 = select(h, r0 + s0, s0 > 0.0) / select(r0 - s0, h, s0 > 0.0);
    let v1 = select(h, r1 + s1, s1 > 0.0) / select(r1 - s1, h, s1 > 0.0);
    return Interval(min(v0, MOST_V), clamp(x * (v0 + v1) / (r0 + r1), 0.0, MOST_V));
}

// A piece of a ray, ready for its nodes.
struct Piece {
    rho: f32,
    squared: u32,               // see Lobe
    mu_squared: f32,
    middle: f32,                // sin(psi_m/2); of a table the rest in the middle
    slope: f32,                 // cos(psi_m/2); of a table what v_of_rest lacks at the start
    reach: f32,
    bend: f32,                  // how far nodes move to the far end
    weight: f32,                // of the sum of the nodes
    t: f32,
    h: f32,
    rate: vec3<f32>,            // -sigma_t/ln 2
    along: f32,                 // of a spot's axis, see cone.wgsl
    across: f32,
    exponent: f32,              // N of a spot, else 0
}

// Optical depth beyond that at the near end after which no light that counts is left: e^-9 is 1e-4.
const DEPTH_MAX: f32 = 9.0;

// Where the exponential is still near 1 in the middle of a piece, it falls in a small part of psi at the far end. So
// nodes x move to x + bend (1 - x^2). That takes the worst error of 6 nodes from 0.5 % to 0.2 %, of 8 from 0.28 % to
// 0.1 %. In thick media the light is at the near end, and nodes stay where they are: then a bend would do harm.
const BEND_MAX: f32 = 0.3;
const BEND_LOSS: f32 = 0.15;    // per optical depth of the middle

fn bend_of(depth_of_v: f32, half_width: f32, width: f32) -> f32 {
    return clamp(BEND_MAX - BEND_LOSS * depth_of_v * half_width, 0.0, BEND_MAX) * min(1.0, depth_of_v * width);
}

fn piece_of(lobe: Lobe, light: Light, spot: SpotBesideRay, beside: LightBesideRay, medium: Medium, depth_of_v: f32, part: Interval) -> Piece {
    let start = part.start;
    let width = part.width;
    let end = start + width;
    let rho2 = lobe.rho * lobe.rho;
    let d0 = sqrt(rho2 + start * start);
    let d1 = sqrt(rho2 + end * end);
    // the middle in psi lies in the direction (rho, start)/d0 + (rho, end)/d1
    let middle = (start * d1 + end * d0) / (d0 + d1);
    let slope = middle / lobe.rho;
    let reach = lobe.rho * width / (d0 * d1 + rho2 + start * end);
    let bend = bend_of(depth_of_v, middle - start, width);
    let cosine = inverseSqrt(1.0 + slope * slope);
    let weight = 2.0 * lobe.scale / (beside.h * rho2) * reach * select(1.0, 1.0 / lobe.rho, lobe.squared != 0u);
    let rate = medium.extinction * -1.4426950408889634;
    let exponent = select(0.0, light.exponent, light.kind == SPOT);
    return Piece(lobe.rho, lobe.squared, lobe.mu_squared, slope * cosine, cosine, reach, bend, weight, beside.t, beside.h, rate,
        spot.along, spot.across, exponent);
}

// The same of a measured phase function: `middle` and `reach` are of the rest, which falls along the ray.
fn piece_of_table(light: Light, spot: SpotBesideRay, beside: LightBesideRay, medium: Medium, depth_of_v: f32, part: Interval) -> Piece {
    // xi = s/(1 + s), s = sqrt(v); the width of s from that of v, without cancellation
    let s0 = sqrt(part.start);
    let s1 = sqrt(part.start + part.width);
    let xi0 = s0 / (1.0 + s0);
    let xi1 = s1 / (1.0 + s1);
    let width = part.width / (max(s0 + s1, 1e-15) * (1.0 + s0) * (1.0 + s1));
    let rest0 = rest_of_table(xi0);
    // narrower than the table's steps: the differences of what it holds would be rounding errors
    let narrow = 0.5 * (measured_phase(xi0) * angle_per_xi(xi0) + measured_phase(xi1) * angle_per_xi(xi1)) * width;
    let fallen = select(max(rest0 - rest_of_table(xi1), 0.0), narrow, width * f32(phase_table_count) < 1.0);
    let middle = rest0 - 0.5 * fallen;
    let bend = bend_of(depth_of_v, v_of_rest(middle) - part.start, part.width);
    let rate = medium.extinction * -1.4426950408889634;
    let exponent = select(0.0, light.exponent, light.kind == SPOT);
    return Piece(1.0, 0u, 0.0, middle, part.start - v_of_rest(rest0), 0.5 * fallen, bend, 0.5 * fallen / beside.h, beside.t, beside.h,
        rate, spot.along, spot.across, exponent);
}

// A node of a piece: what stands there but for the extinction.
struct NodeSample {
    v: f32,
    share: f32,                 // of the sum
    falloff: f32,               // of a spot: its power of 2
}

// Where the phase function is a table.
fn sample_of_table(piece: Piece, node: vec2<f32>) -> NodeSample {
    let x = node.x;
    let v = max(v_of_rest(piece.middle - piece.reach * (x + piece.bend * (1.0 - x * x))) + piece.slope, 0.0);
    // also where v^2 would overflow
    let inverse = 1.0 / (1.0 + v);
    let c = inverse * inverse;
    let s = v * inverse;
    let q = 1.0 / (c + s * s);
    let cosine = (2.0 * s * inverse * piece.across - (c - s * s) * piece.along) * q;
    let weight = node.y - 2.0 * node.x * node.y * piece.bend;
    return NodeSample(v, weight, piece.exponent * log2(max(cosine, 1e-30)));
}

// Where the phase function is made of lobes.
fn sample_of_lobe(piece: Piece, node: vec2<f32>) -> NodeSample {
    let x = node.x;
    let y = piece.reach * (x + piece.bend * (1.0 - x * x));
    // cos and sin of psi/2, times sqrt(b); the latter times rho. So neither grows with v, which may be any
    let c = piece.slope - piece.middle * y;
    let s = piece.rho * (piece.middle + piece.slope * y);
    let b = 1.0 + y * y;
    let q = c * c + s * s;
    // v = s/c, mu = (c^2 - s^2)/q and 1/b from one division
    let cb = c * b;
    let inverse = 1.0 / (cb * q);
    let v = s * b * q * inverse;
    let mu = (c * c - s * s) * cb * inverse;
    let inverse_b = c * q * inverse;
    let root = sqrt(q * inverse_b);
    let density = inverse_b * root * select(1.0, root, piece.squared != 0u) * (1.0 + piece.mu_squared * mu * mu);
    let cosine = 2.0 * c * s * cb * inverse * piece.across - mu * piece.along;
    let weight = node.y - 2.0 * node.x * node.y * piece.bend;
    return NodeSample(v, weight * density, piece.exponent * log2(max(cosine, 1e-30)));
}

// `node` is x in -1..1 and its weight.
fn sample_of(piece: Piece, node: vec2<f32>) -> NodeSample {
    var sample: NodeSample;
    if phase_table_count != 0u {
        sample = sample_of_table(piece, node);
    } else {
        sample = sample_of_lobe(piece, node);
    }
    return sample;
}

// One piece of the lit part of a ray.
struct Chunk {
    interval: Interval,
    more: bool,                 // there is another one behind it
}

// In a table's integral, nodes are dense where the function is large, not where light is left: so the ray is cut where the
// optical depth has grown by this much. That takes the worst error of 12 nodes from 1 % to 0.2 %.
const CHUNK_DEPTH_OF_TABLE: f32 = 1.0;

// The part of the ray before the cut, or behind it.
fn chunk_of_table(depth_of_v: f32, whole: Interval, from_v: f32) -> Chunk {
    let width = min(whole.width, DEPTH_MAX / depth_of_v);
    let near = CHUNK_DEPTH_OF_TABLE / depth_of_v;
    if from_v > whole.start {
        return Chunk(Interval(from_v, max(width - near, 0.0)), false);
    }
    return Chunk(Interval(whole.start, min(width, near)), width > near);
}

// A piece of a spot's ray is so short that 8 nodes know all that happens in it (measured: 0.2 % at most, N to 64):
const CHUNK_TURN: f32 = 2.2;    // the angle at the light grows by no more than this over sqrt(N), the width of cos^N, rad
const CHUNK_RATIO: f32 = 8.0;   // v grows by no more than this factor, beyond the width of the lobe
const CHUNK_DEPTH: f32 = 6.0;   // optical depth grows by no more than this
const CHUNK_OF_TABLE: f32 = 0.4; // of a measured function all of these are so much shorter
const CHUNKS_DEPTH: f32 = 40.0; // behind this optical depth in all nothing follows

// The first such piece that starts at or behind `from_v`.
fn chunk_of_spot(spot: SpotBesideRay, exponent: f32, rho: f32, depth_of_v: f32, whole: Interval, from_v: f32) -> Chunk {
    let whole_end = whole.start + whole.width;
    let first_end = min(spot.first.y, whole_end);
    let in_first = max(from_v, spot.first.x) < first_end;
    let lit = select(spot.second, spot.first, in_first);
    let low = max(max(lit.x, whole.start), from_v);
    let high = max(min(lit.y, whole_end), low);
    // v where theta is `turn` more than at low; tan(x) is nearly x/(1 - 0.4 x^2), and beyond half a turn there is no end.
    // An exponent of 0 is not looked at
    let shorter = select(1.0, CHUNK_OF_TABLE, phase_table_count != 0u);
    let turn = shorter * CHUNK_TURN * inverseSqrt(exponent);
    let rise = 0.5 * turn;
    let run = 1.0 - 0.1 * turn * turn;
    let turned = select((low * run + rise) / (run - low * rise), V_MAX, low * rise >= run);
    let falling = select(V_MAX, min(turned, CHUNK_RATIO * max(low, rho)), exponent > 0.0);
    let end = min(high, min(falling, low + shorter * CHUNK_DEPTH / depth_of_v));
    let uncut = low == whole.start && end == whole_end;
    let more_of_part = end < high && depth_of_v * (end - max(spot.first.x, whole.start)) < CHUNKS_DEPTH;
    let more_parts = end >= high && in_first && spot.second.x < min(spot.second.y, whole_end);
    return Chunk(Interval(low, select(end - low, whole.width, uncut)), more_of_part || more_parts);
}

// What a lobe scatters of a directional light toward the eye, 1/sr.
fn directional_phase(light: Light, lobe: Lobe, ray: Ray) -> f32 {
    return lobe_or_table(lobe, w_toward_eye(light.direction + ray.direction));
}
