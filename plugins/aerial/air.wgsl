// Extinction and in-scattering of sunlight in air of constant density: Hoffman and Preetham 2002, "Rendering Outdoor
// Light Scattering in Real Time"; the optical lengths from the SIGGRAPH 2003 course "Light and Color in the Outdoors".
// Twin: src/air.rs. README.md says where this departs from the papers.
//
//   beta_R, beta_M   scattering coefficients of molecules (Rayleigh) and of aerosols (Mie), 1/m
//   beta_ex          extinction coefficient, beta_R + beta_M + absorption, 1/m
//   f_R, f_HG        phase functions of the two, 1/sr
//   w                sin^2 of half the scattering angle, see phase.wgsl
//   s                length of the ray in the air, m
//   E                irradiance of the sun on a surface that faces it, W/m^2
//   F_ex             e^(-beta_ex s)
//   L_in             E (beta_R f_R + beta_M f_HG)/beta_ex (1 - F_ex), W/(sr m^2)
//   l, m             optical length of a way out of the atmosphere: of how much air as dense as on the ground, m; and
//                    its ratio to that of the zenith, the relative optical (air) mass

#import scene
#import medium
#import phase

// What the passes of this plugin know of the air; worked out once by atmosphere.wgsl.
struct Air {
    medium: Medium,             // beta_ex, and beta_R + beta_M
    rayleigh: vec3<f32>,        // beta_R, 1/m
    dome: f32,                  // height of the sky dome at the zenith, m; 0 where the sky has no end
    mie: vec3<f32>,             // beta_M, 1/m
    from_space: u32,            // 1 where the light's irradiance is that above the atmosphere
    zenith_depth: vec3<f32>,    // optical depth of the whole atmosphere toward the zenith
    pad0: f32,
    haze: array<Lobe, 3>,       // f_HG of each channel
}

// 3/(16 pi) (1 + mu^2), as a lobe.
const RAYLEIGH_SCALE: f32 = 0.059683103659460754;

// beta_R f_R + beta_M f_HG, 1/(m sr).
fn angular_scattering(air: Air, w: f32) -> vec3<f32> {
    let f_r = lobe_phase(Lobe(1.0, RAYLEIGH_SCALE, 0u, 1.0), w);
    let f_hg = vec3<f32>(lobe_phase(air.haze[0], w), lobe_phase(air.haze[1], w), lobe_phase(air.haze[2], w));
    return air.rayleigh * f_r + air.mie * f_hg;
}

// Elevation of a direction above the horizon, degrees; by both of its parts, as acos is poor in f32.
fn elevation_degrees(direction: vec3<f32>) -> f32 {
    return degrees(atan2(direction.y, length(direction.xz)));
}

// m toward a direction: Kasten 1965 as the course has it (Iqbal 1983), 1 at the zenith, 36.5 at the horizon; below the
// horizon as at the horizon.
fn air_mass(direction: vec3<f32>) -> f32 {
    let elevation = max(elevation_degrees(direction), 0.0);
    return 1.0 / (max(direction.y, 0.0) + 0.15 * pow(3.885 + elevation, -1.253));
}

// s: to the surface, or where there is none without end, or to the sky dome of Hoffman and Preetham: as long as the
// optical length of that direction.
fn way_in_air(air: Air, direction: vec3<f32>, way: f32) -> f32 {
    let sky = select(way, air.dome * air_mass(direction), air.dome > 0.0);
    return select(way, sky, way >= ENDLESS);
}

// F_ex.
fn extinction_factor(air: Air, s: f32) -> vec3<f32> {
    return transmittance(air.medium, s);
}

// Half the angle under which the sun is seen, degrees.
const SUN_RADIUS_DEGREES: f32 = 0.267;

// What is left of a directional light where it reaches the ground: all of it where its irradiance is that at ground
// level. From space it has come through m times the atmosphere of the zenith, and of the disc of a sun that sets the part
// above the horizon shines.
fn sunlight(air: Air, light: Light) -> vec3<f32> {
    let to_sun = -light.direction;
    let x = elevation_degrees(to_sun) / SUN_RADIUS_DEGREES;
    // no chord, and all of the disc or nothing, where the horizon does not cross it
    let half_chord = sqrt(max(1.0 - x * x, 0.0));
    let above = 0.5 + (atan2(x, half_chord) + x * half_chord) / 3.14159265358979;
    let left = saturate(above) * exp(-air_mass(to_sun) * air.zenith_depth);
    return select(vec3<f32>(1.0), left, air.from_space != 0u);
}

// E (beta_R f_R + beta_M f_HG) of one light, W/(sr m^3); 0 of a light that is not directional.
fn source_of_sun(air: Air, light: Light, direction: vec3<f32>) -> vec3<f32> {
    let w = w_toward_eye(light.direction + direction);
    let source = light.intensity * sunlight(air, light) * angular_scattering(air, w);
    return select(vec3<f32>(0.0), source, light.kind == DIRECTIONAL);
}

// L_in of a source along s; 0 where there is no extinction, and so no air.
fn in_scattering(air: Air, source: vec3<f32>, s: f32) -> vec3<f32> {
    return source / max(air.medium.extinction, vec3<f32>(1e-30)) * opacity(air.medium, s);
}
