// Phase functions: the share of the light scattered at a point that goes into each direction, 1/sr. Each integrates to 1
// over the sphere.
//
//   mu     cosine of the scattering angle, between the way the light comes and the way it goes on; 1 is forward
//   w      sin^2 of half the scattering angle, (1 - mu)/2: what is given, as 1 - mu is lost in f32 near mu = 1
//   g      mean cosine of the Henyey-Greenstein function
//   k      Schlick's parameter, above 0 forward
//   rho    width of a lobe: (1-g)/(1+g), of Schlick's sqrt((1-k)/(1+k)), of the isotropic and Rayleigh functions 1
//   q      rho^2 (1-w) + w
//
// With rho, 1 + g^2 - 2 g mu = (1+g)^2 q and 1 - k mu = 2 q/(1+rho^2): nothing cancels at |g| near 1. So every function
// of a scene file is one or two lobes  scale * q^(-3/2 or -2) * (1 + c mu^2); phase_functions.rs has them, and their sources.
// No branch depends on the kind: where threads run in lockstep without jumps (software Vulkan), all branches are paid for.
// A measured function is a table instead. Whether there is one is a constant of the pipeline, so that all others do not
// pay for it.

#import scene

// w of light that is scattered toward the eye, by the sum of its direction and that of the view ray: without cancellation.
fn w_toward_eye(sum_of_directions: vec3<f32>) -> f32 {
    return 0.25 * dot(sum_of_directions, sum_of_directions);
}

// Elements of the table: 0 where the phase function is made of lobes. Set from the scene when the pipeline is made.
override phase_table_count: u32 = 0;

var<storage, read> phase_table: PhaseTable;

// A place in the table of a measured function, by the coordinate
//   xi = sqrt(v)/(1 + sqrt(v)), v = tan of half the scattering angle,
// in which the narrow peaks at both ends are wide: 0 forward, 1/2 at a right angle, 1 back.
struct TablePlace {
    before: vec4<f32>,
    after: vec4<f32>,
    along: f32,                 // from `before` to `after`, 0..1
}

// At a share of the table, 0..1.
fn table_place(share: f32) -> TablePlace {
    let last = max(phase_table_count, 2u) - 1u;
    let place = saturate(share) * f32(last);
    let index = u32(place);
    return TablePlace(phase_table.items[index], phase_table.items[min(index + 1u, last)], place - f32(index));
}

// The measured function, 1/sr, at xi.
fn measured_phase(xi: f32) -> f32 {
    let place = table_place(xi);
    return mix(place.before.x, place.after.x, place.along);
}

// The measured function, 1/sr, at w, of which 1 - w is `rest`: v = sqrt(w/(1 - w)).
fn measured_phase_at(w: f32, rest: f32) -> f32 {
    let forward = sqrt(sqrt(abs(w)));
    let backward = sqrt(sqrt(abs(rest)));
    return measured_phase(forward / (forward + backward));
}

// Scattering angle a, rad, per xi.
fn angle_per_xi(xi: f32) -> f32 {
    let back = 1.0 - xi;
    return 4.0 * xi * back / (back * back * back * back + xi * xi * xi * xi);
}

// The integral of the measured function over scattering angles from that of xi to pi, 1/sr: between the table's steps by
// the cubic that has the function as slope.
fn rest_of_table(xi: f32) -> f32 {
    let place = table_place(xi);
    let step = 1.0 / f32(max(phase_table_count, 2u) - 1u);
    let low = xi - place.along * step;
    let slope0 = -place.before.x * angle_per_xi(low) * step;
    let slope1 = -place.after.x * angle_per_xi(low + step) * step;
    let x = place.along;
    let fallen = place.after.y - place.before.y;
    let bend = x * (1.0 - x) * ((1.0 - x) * (slope0 - fallen) - x * (slope1 - fallen));
    return place.before.y + x * fallen + bend;
}

// v where that integral has this value.
fn v_of_rest(rest: f32) -> f32 {
    // the table is even in the third root
    let share = pow(max(rest / phase_table.total, 1e-30), 1.0 / 3.0);
    let place = table_place(share);
    let xi = mix(place.before.z, place.after.z, place.along);
    // a little more than 1, as xi may be 1
    let ratio = xi / (1.000001 - xi);
    return ratio * ratio;
}

// A lobe at w, 1/sr.
fn lobe_phase(lobe: Lobe, w: f32) -> f32 {
    return lobe_phase_of(lobe, w, 1.0 - w);
}

// The same where 1 - w is known apart, as `rest`: in f32 it is lost near w = 1, where backward lobes have their peak.
fn lobe_phase_of(lobe: Lobe, w: f32, rest: f32) -> f32 {
    let root = inverseSqrt(lobe.rho * lobe.rho * rest + w);
    let mu = 1.0 - 2.0 * w;
    return lobe.scale * root * root * root * select(1.0, root, lobe.squared != 0u) * (1.0 + lobe.mu_squared * mu * mu);
}

// Lobe 0 or 1, by a choice between values: memory at a place that threads do not share is slow to read.
fn lobe_of(phase: Phase, index: u32) -> Lobe {
    let first = phase.lobes[0];
    let second = phase.lobes[1];
    let is_second = index == 1u;
    return Lobe(select(first.rho, second.rho, is_second), select(first.scale, second.scale, is_second),
        select(first.squared, second.squared, is_second), select(first.mu_squared, second.mu_squared, is_second));
}

// What a lobe adds to the phase function at w, 1/sr; a measured one is all in the first.
fn lobe_or_table(lobe: Lobe, w: f32) -> f32 {
    var value: f32;
    if phase_table_count != 0u {
        value = measured_phase_at(w, 1.0 - w);
    } else {
        value = lobe_phase(lobe, w);
    }
    return value;
}

// The phase function at w, 1/sr.
fn phase_at(phase: Phase, w: f32) -> f32 {
    return phase_of(phase, w, 1.0 - w);
}

// The same where 1 - w is known apart, as `rest`.
fn phase_of(phase: Phase, w: f32, rest: f32) -> f32 {
    var value: f32;
    if phase_table_count != 0u {
        value = measured_phase_at(w, rest);
    } else {
        value = lobe_phase_of(phase.lobes[0], w, rest) + lobe_phase_of(phase.lobes[1], w, rest);
    }
    return value;
}
