// The light that the medium scatters to a surface, summed over each lobe that a surface of the scene has: the table that
// shaders/reflection.wgsl reads. Lambert's first, then one layer for each cosine lobe, of a Phong surface or of a spot.
//
//   J^n, A, T, theta, n   see shaders/reflection.wgsl
//   gamma, glow, F_l      see zonal.wgsl
//   K_l       2 pi * integral of max(0, cos)^n P_l dcos: a lobe's zonal coefficients
//   phi       azimuth about the way to the light, from the axis of the lobe
//
// Broad lobes by zonal coefficients: J = sum of (2l+1)/(4 pi) F_l K_l P_l(cos(theta)). Sharp ones, which would need about
// 3 sqrt(n) of them, and those of spots, which end at an edge, by the integral itself: J = integral of
// glow(gamma) K(gamma, theta) dgamma, where K = integral of (1 - x)^n dphi over the phi within the cutoff,
// x = 1 - cos(gamma - theta) + 2 sin(gamma) sin(theta) sin^2(phi/2).
#import scene
#import reflection
#import "lobe_data.wgsl"

// The largest shininess that zonal coefficients are used for.
const ZONAL_MOST: f32 = 30.0;

var glow: texture_2d<f32>;
var coefficients: texture_2d<f32>;
var table: texture_storage_2d_array<rgba32float, write>;

// An angle from the sine of its half: asin() of software Vulkan is off by 1e-4, which is much of a sharp lobe.
fn angle_of(sine_of_half: f32) -> f32 {
    return 2.0 * atan2(sine_of_half, sqrt(max(1.0 - sine_of_half * sine_of_half, 0.0)));
}

// J of a row by its series, at two angles.
fn zonal_sums(n: f32, cosines: vec2<f32>, row: u32) -> vec2<f32> {
    let terms = textureDimensions(coefficients).x;
    var sums = vec2<f32>(0.0);
    // P_(l-1) and P_l; K_l, K_(l+1), by K_(l+2) = K_l (n-l)/(n+l+3)
    var p = vec2<f32>(1.0);
    var before = p; // multiplied by 0 first
    var k = 2.0 * PI * vec2<f32>(1.0 / (n + 1.0), 1.0 / (n + 2.0));
    for (var l = 0u; l < terms; l++) {
        let degree = f32(l);
        sums += (2.0 * degree + 1.0) / (4.0 * PI) * k.x * textureLoad(coefficients, vec2<u32>(l, row), 0).x * p;
        let next = ((2.0 * degree + 1.0) * cosines * p - degree * before) / (degree + 1.0);
        before = p;
        p = next;
        k = vec2<f32>(k.y, k.x * (n - degree) / (n + degree + 3.0));
    }
    return sums;
}

// (1 - x)^n, without the loss of x beside 1.
fn power_of_rest(x: f32, n: f32) -> f32 {
    let series = -x * (1.0 + x * (0.5 + x * (1.0 / 3.0 + x * 0.25)));
    let exponent = select(log(max(1.0 - x, 1e-30)), series, x < 0.02);
    // where n = 0 a lobe may be wider than a hemisphere
    return select(0.0, exp(n * exponent), x < 1.0 || n == 0.0);
}

// Half the nodes around: the other half is alike.
const AZIMUTHS: u32 = 16u;

// K. In phi' with tan(phi/2) = width tan(phi'/2) no lobe is narrow.
fn azimuthal_sum(lobe: CosineLobe, theta: f32, gamma: f32) -> f32 {
    let n = lobe.exponent;
    let half_turn = sin(0.5 * (gamma - theta));
    let nearest = 2.0 * half_turn * half_turn;
    let swing = 2.0 * max(sin(gamma) * sin(theta), 0.0);
    let width2 = 1.0 / (1.0 + 0.5 * n * swing / max(1.0 - nearest, 0.05));
    let width = sqrt(width2);
    // sin^2(phi/2) at the cutoff, and phi'/2 there
    let edge = clamp((1.0 - lobe.cos_cutoff - nearest) / max(swing, 1e-20), 0.0, 1.0);
    let end = atan2(sqrt(edge), width * sqrt(1.0 - edge));
    var sum = 0.0;
    for (var i = 0u; i < AZIMUTHS; i++) {
        let t = tan(end / f32(AZIMUTHS) * (f32(i) + 0.5));
        let q = 1.0 / (1.0 + width2 * t * t);
        sum += power_of_rest(nearest + swing * width2 * t * t * q, n) * q * (1.0 + t * t);
    }
    return 4.0 * end * width / f32(AZIMUTHS) * sum;
}

// Nodes across a sharp lobe, and half as many on either side of the middle; gamma = middle + half the width * tanh(s), with
// s in equal steps: they crowd at the light.
const ACROSS: u32 = 81u;
const ACROSS_HALF: f32 = 40.0;
const ACROSS_STEP: f32 = 0.16;
// Where cos^n is e^-18 a lobe ends.
const REACH_EXPONENT: f32 = 18.0;

// A node across a lobe: the first of the four nodes of the glow around it, and what each of them counts.
struct Node {
    first: u32,
    shares: vec4<f32>,
}

fn node_across(lobe: CosineLobe, theta: f32, index: u32) -> Node {
    let least = max(exp(-REACH_EXPONENT / max(lobe.exponent, 1e-3)), lobe.cos_cutoff);
    let reach = angle_of(sqrt(0.5 * (1.0 - select(least, lobe.cos_cutoff, lobe.exponent == 0.0))));
    let low = max(theta - reach, 0.0);
    let width = min(theta + reach, PI) - low;
    let step = f32(index) - ACROSS_HALF;
    let e = exp(-2.0 * ACROSS_STEP * abs(step));
    // the share of the width on this side of the node, and its change with s
    let share = select(1.0, e, step < 0.0) / (1.0 + e);
    let change = 2.0 * e / ((1.0 + e) * (1.0 + e));
    let gamma = clamp(low + width * share, 1e-7, PI - 1e-6);
    let sought = (log(tan(0.5 * gamma)) - FIRST_NODE) / NODE_STEP;
    let at = clamp(sought, 1.0, f32(GLOW_NODES) - 3.0);
    // behind the last node, away from the light, the glow falls like pi - gamma
    let beyond = exp(-NODE_STEP * max(sought - at, 0.0));
    let second = floor(at);
    let weight = azimuthal_sum(lobe, theta, gamma) * change * width * ACROSS_STEP * beyond;
    // cubic between the four
    let x = at - second;
    let shares = vec4<f32>(-x * (x - 1.0) * (x - 2.0) / 6.0, (x + 1.0) * (x - 1.0) * (x - 2.0) / 2.0,
        -(x + 1.0) * x * (x - 2.0) / 2.0, (x + 1.0) * x * (x - 1.0) / 6.0);
    return Node(u32(second) - 1u, weight * shares);
}

// Nodes of the glow, see zonal.wgsl.
const GLOW_NODES: u32 = 256u;

// One workgroup for each cell of angles, all layers one after another: a thread for each depth, and for the directional light
// at the end. (Software Vulkan takes as long for a workgroup that has nothing to do as for another one.)
const POINTS: u32 = 97u;

// Nodes across the lobe at the first and at the second angle.
var<workgroup> across: array<array<Node, ACROSS>, 2>;
// What a node of the glow counts at both.
var<workgroup> shares: array<vec2<f32>, GLOW_NODES>;
// What each thread has found, at both.
var<workgroup> found: array<vec2<f32>, POINTS>;

// What a node of the glow counts at an angle: those nodes across the lobe that stand around it. They stand in order.
fn share_of(side: u32, glow_node: u32) -> f32 {
    // the first one whose four nodes reach this one, by bisection
    var start = 0u;
    var length = 64u;
    loop {
        let middle = start + length;
        start = select(start, middle, middle <= ACROSS && across[side][min(middle, ACROSS) - 1u].first + 3u < glow_node);
        length /= 2u;
        if length == 0u { break; }
    }
    var sum = 0.0;
    loop {
        let node = across[side][min(start, ACROSS - 1u)];
        let reaches = start < ACROSS && node.first <= glow_node && glow_node <= node.first + 3u;
        sum += select(0.0, node.shares[min(glow_node - node.first, 3u)], reaches);
        start++;
        if !reaches { break; }
    }
    return sum;
}

@compute @workgroup_size(1, POINTS, 1)
fn main(@builtin(global_invocation_id) id: vec3<u32>) {
    let size = textureDimensions(table);
    let count = cosine_lobes.count;
    var layer = 0u;
    loop {
        // Lambert's, then those of the scene
        var lobe = CosineLobe(1.0, 0.0, 0u, 0u);
        if layer > 0u {
            lobe = cosine_lobes.items[layer - 1u];
        }
        let n = lobe.exponent;
        let is_spot = lobe.is_spot != 0u;
        let axis = angle_axis(lobe_width(n, select(-1.0, lobe.cos_cutoff, is_spot)), f32(size.x));
        let angles = vec2<f32>(angle_of(sine_of_half_at(axis, f32(id.x))), angle_of(sine_of_half_at(axis, f32(id.x + 1u))));
        var sums = vec2<f32>(0.0);
        if n <= ZONAL_MOST && !is_spot {
            sums = zonal_sums(n, cos(angles), id.y);
        } else {
            if id.y < ACROSS {
                across[0][id.y] = node_across(lobe, angles.x, id.y);
                across[1][id.y] = node_across(lobe, angles.y, id.y);
            }
            workgroupBarrier();
            let first = min(across[0][0].first, across[1][0].first);
            let end = max(across[0][ACROSS - 1u].first, across[1][ACROSS - 1u].first) + 4u;
            for (var i = first + id.y; i < end; i += POINTS) {
                shares[i] = vec2<f32>(share_of(0u, i), share_of(1u, i));
            }
            workgroupBarrier();
            for (var i = first; i < end; i++) {
                sums += shares[i] * textureLoad(glow, vec2<u32>(i, id.y), 0).x;
            }
        }
        let unit = select(2.0 * PI / (n + 1.0), textureLoad(coefficients, vec2<u32>(0u, id.y), 0).x, is_spot);
        // what a series leaves of a value near 0 may be below it
        found[id.y] = max(sums / unit, vec2<f32>(0.0));
        workgroupBarrier();
        // the last two threads have no cell of their own: one is the last depth, one the directional light's, the last row
        if id.y + 2u < POINTS {
            textureStore(table, id.xy, layer, vec4<f32>(found[id.y], found[id.y + 1u]));
        } else if id.y + 1u == POINTS {
            textureStore(table, vec2<u32>(id.x, size.y - 1u), layer, vec4<f32>(found[id.y], found[id.y]));
        }
        workgroupBarrier();
        layer++;
        if layer > count { break; }
    }
    // what the scene has no lobe for
    for (; layer < textureNumLayers(table); layer++) {
        if id.y < size.y {
            textureStore(table, id.xy, layer, vec4<f32>(0.0));
        }
    }
}
