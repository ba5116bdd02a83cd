// Phase functions: the share of the light scattered at a point that goes into each direction, 1/sr. Each integrates to 1
// over the sphere.
//
//   mu     cosine of the scattering angle, between the way the light comes and the way it goes on; 1 is forward
//   w      sin^2 of half the scattering angle, (1 - mu)/2: what is given, as 1 - mu is lost in f32 near mu = 1
//   g      mean cosine of the Henyey-Greenstein function (of Cornette and Shanks: their g, which is not the mean)
//   k      Schlick's parameter, above 0 forward
//   f      weight of the second lobe of the double Henyey-Greenstein function
//   rho    width of a lobe: (1-g)/(1+g), of Schlick's sqrt((1-k)/(1+k)), of the isotropic and Rayleigh functions 1
//   q      rho^2 (1-w) + w
//
// With rho, 1 + g^2 - 2 g mu = (1+g)^2 q and 1 - k mu = 2 q/(1+rho^2): nothing cancels at |g| near 1. So every function
// of a scene file is one or two lobes  scale * q^(-3/2 or -2) * (1 or 1 + mu^2):
//   Isotropic          1/(4 pi), which is Henyey and Greenstein's with g = 0
//   HenyeyGreenstein   (1-g^2)/(4 pi (1 + g^2 - 2 g mu)^(3/2))            (Henyey and Greenstein 1941, eq. 2)
//   Schlick            (1-k^2)/(4 pi (1 - k mu)^2)                        (Blasi, Le Saec and Schlick 1993, eq. 3)
//   Rayleigh           3 (1 + mu^2)/(16 pi)
//   CornetteShanks     HenyeyGreenstein * 3 (1 + mu^2)/(2 (2 + g^2))      (Cornette and Shanks 1992, eq. 8)
// No branch depends on the kind: where threads run in lockstep without jumps (software Vulkan), all branches are paid for.

#import scene

const FOUR_PI: f32 = 12.566370614359172;

// One lobe of a phase function.
struct Lobe {
    rho: f32,
    scale: f32,
    squared: bool,              // q^(-2), Schlick; else q^(-3/2)
    mu_squared: f32,            // 1 where the lobe has the factor 1 + mu^2, else 0
}

// Lobes of the medium's phase function.
fn lobe_count(medium: Medium) -> u32 {
    return select(1u, 2u, medium.phase == DOUBLE_HENYEY_GREENSTEIN);
}

// Lobe 0 or 1 of the medium's phase function; the second of a function with one lobe is 0 everywhere.
fn lobe_of(medium: Medium, index: u32) -> Lobe {
    let second = index == 1u;
    let rho = select(medium.rho1, medium.rho2, second);
    let is_schlick = medium.phase == SCHLICK;
    // (1-g^2)/(1+g)^3 = rho (1+rho)/2; of Schlick's function (1-k^2) ((1+rho^2)/2)^2 = rho^2
    var scale = rho * select(0.5 * (1.0 + rho), rho, is_schlick) / FOUR_PI;
    let is_double = medium.phase == DOUBLE_HENYEY_GREENSTEIN;
    scale *= select(select(1.0, 0.0, second), select(1.0 - medium.weight, medium.weight, second), is_double);
    let has_mu_squared = medium.phase == RAYLEIGH || medium.phase == CORNETTE_SHANKS;
    scale *= select(1.0, 1.5 / (2.0 + medium.g1 * medium.g1), has_mu_squared);
    return Lobe(rho, scale, is_schlick, select(0.0, 1.0, has_mu_squared));
}

// A lobe at w, 1/sr.
fn lobe_phase(lobe: Lobe, w: f32) -> f32 {
    let root = inverseSqrt(lobe.rho * lobe.rho * (1.0 - w) + w);
    let mu = 1.0 - 2.0 * w;
    return lobe.scale * root * root * root * select(1.0, root, lobe.squared) * (1.0 + lobe.mu_squared * mu * mu);
}

// A phase function: the sum of its lobes.
struct Phase {
    first: Lobe,
    second: Lobe,
}

// The medium's phase function. Compilers do not move this out of a loop over points, so make it before.
fn phase_of(medium: Medium) -> Phase {
    return Phase(lobe_of(medium, 0u), lobe_of(medium, 1u));
}

// The phase function at w, 1/sr.
fn phase_at(phase: Phase, w: f32) -> f32 {
    return lobe_phase(phase.first, w) + lobe_phase(phase.second, w);
}
