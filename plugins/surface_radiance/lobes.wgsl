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

// The largest shininess that zonal coefficients are used for.
const ZONAL_MOST: f32 = 30.0;

// As in zonal.wgsl.
const FIRST_NODE: f32 = -12.5;
const NODE_STEP: f32 = 0.075;

var<storage, read> cosine_lobes: CosineLobes;
var glow: texture_2d<f32>;
var coefficients: texture_2d<f32>;
var table: texture_storage_2d_array<rgba32float, write>;

// Of two rows, the sum of the series.
fn zonal_sum(n: f32, theta: f32, rows: vec2<u32>) -> vec2<f32> {
    let terms = textureDimensions(coefficients).x;
    let cosine = cos(theta);
    var sum = vec2<f32>(0.0);
    // P_(l-1), P_l; K_l, K_(l+1), by K_(l+2) = K_l (n-l)/(n+l+3)
    var p = vec2<f32>(0.0, 1.0);
    var k = 2.0 * PI * vec2<f32>(1.0 / (n + 1.0), 1.0 / (n + 2.0));
    for (var l = 0u; l < terms; l++) {
        let f = vec2<f32>(textureLoad(coefficients, vec2<u32>(l, rows.x), 0).x, textureLoad(coefficients, vec2<u32>(l, rows.y), 0).x);
        let degree = f32(l);
        sum += (2.0 * degree + 1.0) / (4.0 * PI) * k.x * p.y * f;
        p = vec2<f32>(p.y, ((2.0 * degree + 1.0) * cosine * p.y - degree * p.x) / (degree + 1.0));
        k = vec2<f32>(k.y, k.x * (n - degree) / (n + degree + 3.0));
    }
    return sum;
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

// The glow of two rows between nodes, cubic.
fn glow_between(gamma: f32, rows: vec2<u32>) -> vec2<f32> {
    let last = f32(textureDimensions(glow).x) - 3.0;
    let at = clamp((log(tan(0.5 * gamma)) - FIRST_NODE) / NODE_STEP, 1.0, last);
    let node = u32(at);
    let x = at - f32(node);
    let weights = vec4<f32>(-x * (x - 1.0) * (x - 2.0) / 6.0, (x + 1.0) * (x - 1.0) * (x - 2.0) / 2.0,
        -(x + 1.0) * x * (x - 2.0) / 2.0, (x + 1.0) * x * (x - 1.0) / 6.0);
    var values = vec2<f32>(0.0);
    for (var i = 0u; i < 4u; i++) {
        let value = vec2<f32>(textureLoad(glow, vec2<u32>(node + i - 1u, rows.x), 0).x, textureLoad(glow, vec2<u32>(node + i - 1u, rows.y), 0).x);
        values += weights[i] * value;
    }
    return values;
}

// Half the nodes across a lobe, and their step in s, gamma = middle + half the width * tanh(s): they crowd at the light.
const ACROSS: i32 = 40;
const ACROSS_STEP: f32 = 0.16;
const REACH_EXPONENT: f32 = 18.0;

fn sharp_lobe(lobe: CosineLobe, theta: f32, rows: vec2<u32>) -> vec2<f32> {
    // where cos^n is e^-18, or the cutoff
    let least = max(exp(-REACH_EXPONENT / max(lobe.exponent, 1e-3)), lobe.cos_cutoff);
    let reach = 2.0 * asin(sqrt(0.5 * (1.0 - select(least, lobe.cos_cutoff, lobe.exponent == 0.0))));
    let low = max(theta - reach, 0.0);
    let width = min(theta + reach, PI) - low;
    var sum = vec2<f32>(0.0);
    for (var i = -ACROSS; i <= ACROSS; i++) {
        let e = exp(-2.0 * ACROSS_STEP * abs(f32(i)));
        // the share of the width on this side of the node, and its change with s
        let share = select(1.0 / (1.0 + e), e / (1.0 + e), i < 0);
        let gamma = clamp(low + width * share, 1e-7, PI - 1e-6);
        sum += glow_between(gamma, rows) * (azimuthal_sum(lobe, theta, gamma) * 2.0 * e / ((1.0 + e) * (1.0 + e)));
    }
    return sum * width * ACROSS_STEP;
}

@compute @workgroup_size(8, 8, 1)
fn main(@builtin(global_invocation_id) id: vec3<u32>) {
    let size = textureDimensions(table);
    if any(id.xy >= size) {
        return;
    }
    let depths = size.y - 1u;
    // the last row is the directional light's, which stands behind the last depth
    let rows = select(vec2<u32>(id.y, id.y + 1u), vec2<u32>(id.y + 1u), id.y == depths);
    let used = id.z <= cosine_lobes.count;
    var lobe = CosineLobe(1.0, 0.0, 0u, 0u);
    if id.z > 0u && used {
        lobe = cosine_lobes.items[id.z - 1u];
    }
    let n = lobe.exponent;
    let is_spot = lobe.is_spot != 0u;
    let axis = angle_axis(lobe_width(n, select(-1.0, lobe.cos_cutoff, is_spot)), f32(size.x));
    let theta0 = 2.0 * asin(sine_of_half_at(axis, f32(id.x)));
    let theta1 = 2.0 * asin(sine_of_half_at(axis, f32(id.x + 1u)));
    var corners = vec4<f32>(0.0);
    let zonal = n <= ZONAL_MOST && !is_spot;
    if used && zonal {
        corners = vec4<f32>(zonal_sum(n, theta0, rows), zonal_sum(n, theta1, rows));
    }
    if used && !zonal {
        corners = vec4<f32>(sharp_lobe(lobe, theta0, rows), sharp_lobe(lobe, theta1, rows));
    }
    // what a series leaves of a value near 0 may be below it
    let whole = vec2<f32>(textureLoad(coefficients, vec2<u32>(0u, rows.x), 0).x, textureLoad(coefficients, vec2<u32>(0u, rows.y), 0).x);
    let unit = select(vec2<f32>(2.0 * PI / (n + 1.0)), whole, is_spot);
    let scaled = max(corners.xzyw / unit.xxyy, vec4<f32>(0.0));
    textureStore(table, id.xy, id.z, scaled);
}
