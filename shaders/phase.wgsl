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
// of a scene file is one or two lobes  scale * q^(-3/2 or -2) * (1 + c mu^2), worked out in phase.rs:
//   Isotropic          1/(4 pi), which is Henyey and Greenstein's with g = 0
//   HenyeyGreenstein   (1-g^2)/(4 pi (1 + g^2 - 2 g mu)^(3/2))            (Henyey and Greenstein 1941, eq. 2)
//   Schlick            (1-k^2)/(4 pi (1 - k mu)^2)                        (Blasi, Le Saec and Schlick 1993, eq. 3)
//   Rayleigh           3 (1 + mu^2)/(16 pi)
//   CornetteShanks     HenyeyGreenstein * 3 (1 + mu^2)/(2 (2 + g^2))      (Cornette and Shanks 1992, eq. 8)
// No branch depends on the kind: where threads run in lockstep without jumps (software Vulkan), all branches are paid for.

#import scene

// A lobe at w, 1/sr.
fn lobe_phase(lobe: Lobe, w: f32) -> f32 {
    let root = inverseSqrt(lobe.rho * lobe.rho * (1.0 - w) + w);
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

// The phase function at w, 1/sr.
fn phase_at(phase: Phase, w: f32) -> f32 {
    return lobe_phase(phase.lobes[0], w) + lobe_phase(phase.lobes[1], w);
}
