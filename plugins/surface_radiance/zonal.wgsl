// What the medium scatters once to a point from all around, as zonal coefficients about the way to the light.
//
//   gamma     angle between a direction and the way to the light
//   a         tan(gamma/2)
//   T         optical depth of the way to the light, see shaders/reflection.wgsl
//   v         along a direction, see shaders/airlight_pieces.wgsl: its paths to the light and back are T (cos gamma + v sin gamma)
//   F         radiance in that direction is I sigma_s/d F(T, gamma)
//   P_l       Legendre polynomials
//   F_l       2 pi * integral of F P_l dcos(gamma): F = sum of (2l+1)/(4 pi) F_l P_l
//
// Of an endless ray, e^T F sin(gamma) = integral from v = a on of p(v) e^(-T sin(gamma) (v - a)) 2/(1 + v^2) dv, as
// cos(gamma) + a sin(gamma) = 1 (Hong 2006, section 4.2.2, with H written out). In ln(v - a), and in ln a, all scales are
// alike, whatever the phase function: equal steps do, and their error falls exponentially with the step.
//
// Of a directional light, which has no T, the last row: F = p.
#import scene
#import phase
#import reflection

// Of gamma: a texel of `glow` each.
const NODES: u32 = 256u;

// ln(v - a), from where nothing is left out to where nothing comes.
const FIRST_STEP: f32 = -14.0;
const STEPS: u32 = 113u;
const STEP: f32 = 0.25;

// Widths of a phase function's lobes that are told apart: far narrower than any lobe of a surface, and wide enough for the
// nodes. What is narrower (g above 0.9999, below -0.993) counts as that wide, and scatters as much.
const NARROWEST: f32 = 5e-5;
const NARROWEST_BACKWARD: f32 = 300.0;

var<uniform> phase: Phase;
var glow: texture_storage_2d<r32float, write>;
var coefficients: texture_storage_2d<r32float, write>;

// cos(gamma) and what a node adds to a coefficient, without P_l.
var<workgroup> nodes: array<vec2<f32>, NODES>;

// A lobe that the nodes see. Its integral is the scale over rho (1 + rho), or over rho^2 (Schlick).
fn widened(lobe: Lobe) -> Lobe {
    let rho = clamp(lobe.rho, NARROWEST, NARROWEST_BACKWARD);
    let ratio = rho / lobe.rho;
    let scale = lobe.scale * ratio * select((1.0 + rho) / (1.0 + lobe.rho), ratio, lobe.squared != 0u);
    return Lobe(rho, scale, lobe.squared, lobe.mu_squared);
}

// e^T F sin(gamma).
fn glow_at(scattering: Phase, depth: f32, a: f32) -> f32 {
    let rate = depth * 2.0 * a / (1.0 + a * a);
    // below the first step p and the exponential do not change
    var sum = phase_of(scattering, a * a / (1.0 + a * a), 1.0 / (1.0 + a * a)) / (1.0 + a * a) * exp(FIRST_STEP - 0.5 * STEP) / STEP;
    var i = 0u;
    loop {
        let x = exp(FIRST_STEP + STEP * f32(i));
        let v = a + x;
        let q = 1.0 / (1.0 + v * v);
        sum += phase_of(scattering, v * v * q, q) * exp(-rate * x) * x * q;
        i++;
        if i >= STEPS { break; }
    }
    return 2.0 * STEP * sum;
}

// P_l by its recurrence.
fn legendre(l: u32, cosine: f32) -> f32 {
    var value = 1.0;
    var below = value; // multiplied by 0 first
    var k = 0.0;
    loop {
        let next = ((2.0 * k + 1.0) * cosine * value - k * below) / (k + 1.0);
        let more = k < f32(l);
        below = select(below, value, more);
        value = select(value, next, more);
        k += 1.0;
        if k >= f32(l) { break; }
    }
    return value;
}

@compute @workgroup_size(256, 1, 1)
fn main(@builtin(global_invocation_id) id: vec3<u32>) {
    let row = id.y;
    let depths = textureDimensions(glow).y - 1u;
    let a = exp(FIRST_NODE + NODE_STEP * f32(id.x));
    let cosine = (1.0 - a * a) / (1.0 + a * a);
    let sine = 2.0 * a / (1.0 + a * a);
    var scattering = phase;
    scattering.lobes = array<Lobe, 2>(widened(phase.lobes[0]), widened(phase.lobes[1]));
    var value = phase_of(scattering, a * a / (1.0 + a * a), 1.0 / (1.0 + a * a)) * sine;
    if row < depths {
        value = glow_at(scattering, depth_at(f32(row), f32(depths - 1u)), a);
    }
    // dgamma = sin(gamma) d(ln a); the first node stands for all that is nearer to the light
    let first = select(0.0, 2.0 * a * exp(-0.5 * NODE_STEP), id.x == 0u);
    nodes[id.x] = vec2<f32>(cosine, 2.0 * PI * value * (NODE_STEP * sine + first));
    textureStore(glow, id.xy, vec4<f32>(value));
    workgroupBarrier();
    if id.x < textureDimensions(coefficients).x {
        var sum = 0.0;
        for (var i = 0u; i < NODES; i++) {
            sum += nodes[i].y * legendre(id.x, nodes[i].x);
        }
        textureStore(coefficients, id.xy, vec4<f32>(sum));
    }
}
