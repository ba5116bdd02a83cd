// Phase functions: the share of the light scattered at a point that goes into each direction, 1/sr. Each integrates to 1
// over the sphere.
//
//   mu     cosine of the scattering angle, between the way the light comes and the way it goes on; 1 is forward
//   w      sin^2 of half the scattering angle, (1 - mu)/2: what is given, as 1 - mu is lost in f32 near mu = 1
//   g      mean cosine of the Henyey-Greenstein function (of Cornette and Shanks: their g, which is not the mean)
//   k      Schlick's parameter, above 0 forward
//   rho    width of a lobe: (1-g)/(1+g), Schlick: sqrt((1-k)/(1+k)). With it
//          1 + g^2 - 2 g mu = (1-g)^2 (q/rho^2)  and  1 - k mu = 2 q/(1+rho^2),  where  q = rho^2 (1-w) + w

#import scene

const FOUR_PI: f32 = 12.566370614359172;

// Henyey and Greenstein 1941, (1-g^2) / (4 pi (1 + g^2 - 2 g mu)^(3/2)), written in rho, so that nothing cancels at |g|
// near 1.
fn henyey_greenstein(rho: f32, w: f32) -> f32 {
    let root = inverseSqrt(rho * rho * (1.0 - w) + w);
    return rho * (1.0 + rho) / (2.0 * FOUR_PI) * root * root * root;
}

// Blasi, Le Saec and Schlick 1993, eq. 3, with k above 0 forward: (1-k^2) / (4 pi (1 - k mu)^2), written in rho.
fn schlick(rho: f32, w: f32) -> f32 {
    let q = rho * rho * (1.0 - w) + w;
    return rho * rho / (FOUR_PI * q * q);
}

// 3/(16 pi) (1 + mu^2).
fn rayleigh(w: f32) -> f32 {
    let mu = 1.0 - 2.0 * w;
    return 0.75 / FOUR_PI * (1.0 + mu * mu);
}

// Cornette and Shanks 1992, eq. 8: Henyey and Greenstein's times 3 (1 + mu^2) / (2 (2 + g^2)).
fn cornette_shanks(rho: f32, g: f32, w: f32) -> f32 {
    let mu = 1.0 - 2.0 * w;
    return henyey_greenstein(rho, w) * 1.5 * (1.0 + mu * mu) / (2.0 + g * g);
}

// The phase function of the medium, 1/sr, at w = (1 - mu)/2.
fn phase(medium: Medium, w: f32) -> f32 {
    switch medium.phase {
        case HENYEY_GREENSTEIN: { return henyey_greenstein(medium.rho1, w); }
        case DOUBLE_HENYEY_GREENSTEIN: {
            return mix(henyey_greenstein(medium.rho1, w), henyey_greenstein(medium.rho2, w), medium.weight);
        }
        case SCHLICK: { return schlick(medium.rho1, w); }
        case RAYLEIGH: { return rayleigh(w); }
        case CORNETTE_SHANKS: { return cornette_shanks(medium.rho1, medium.g1, w); }
        default: { return 1.0 / FOUR_PI; }
    }
}
