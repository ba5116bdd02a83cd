// The air of a scene, worked out once for all passes that see through it: see air.wgsl.
#import scene
#import "air.wgsl"

struct Params {
    rayleigh: vec3<f32>,
    mie: vec3<f32>,
    absorption: vec3<f32>,
    g: vec3<f32>,
    rayleigh_height: f32,
    mie_height: f32,
    sky: u32,
    sunlight: u32,
}

var<uniform> params: Params;
var<storage, read_write> air: Air;

const DOME: u32 = 1u;
const SPACE: u32 = 1u;

// Henyey and Greenstein's function as a lobe, see phase.wgsl and phase.rs; 1 - g is exact in f32 where g is near 1.
fn haze_lobe(g: f32) -> Lobe {
    let rho = (1.0 - g) / (1.0 + g);
    return Lobe(rho, rho * (1.0 + rho) / 25.132741228718345, 0u, 0.0);
}

@compute @workgroup_size(1)
fn main() {
    let aerosols = params.mie + params.absorption;
    air.medium.extinction = params.rayleigh + aerosols;
    air.medium.scattering = params.rayleigh + params.mie;
    air.medium.pad0 = 0.0;
    air.medium.pad1 = 0.0;
    air.rayleigh = params.rayleigh;
    air.dome = select(0.0, params.rayleigh_height, params.sky == DOME);
    air.mie = params.mie;
    air.from_space = select(0u, 1u, params.sunlight == SPACE);
    air.zenith_depth = params.rayleigh_height * params.rayleigh + params.mie_height * aerosols;
    air.pad0 = 0.0;
    air.haze[0] = haze_lobe(params.g.x);
    air.haze[1] = haze_lobe(params.g.y);
    air.haze[2] = haze_lobe(params.g.z);
}
