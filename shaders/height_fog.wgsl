// Light scattered once toward the eye in a medium whose density falls exponentially with the height y (height fog).
//
//   glossary of airlight_pieces.wgsl, and
//   density   e^(-(y - base height) k), k = 1/scale height: sigma_t and sigma_s are those of density 1, times this
//   climb     y of the ray's direction
//   E, E_l    integral of the density along the ray from the eye, and from a point to the light, m (effective ways)
//
// Of a point light or spot
//   L = sigma_s I/h * integral of p(mu) density e^(-sigma_t (E + E_l)) 2/(1 + v^2) dv
// E and E_l are in closed form; the integral is done by the nodes of airlight_pieces.wgsl, in pieces within which the density
// changes by no more than PIECE_DENSITY. Of a directional light all is in closed form, as the depth grows with E alone.

#import scene
#import medium
#import airlight_pieces
#import node_sum

// By how much, as a power of e, the density changes in a piece at most.
const PIECE_DENSITY: f32 = 3.0;
// Optical depth of a piece at most, and after how much of it nothing follows, beyond that of the light at the eye.
const PIECE_DEPTH: f32 = 4.0;
const PIECES_DEPTH: f32 = 12.0;
// Nor behind this optical depth, wherever the light stands: e^-100 is 0 in f32.
const LAST_DEPTH: f32 = 100.0;
// Where the density is e^-14 of that at the eye, 1e-6, nothing follows.
const PIECES_DENSITY: f32 = 14.0;

// The ray in height fog.
struct Climb {
    density: f32,               // at the eye
    height: f32,                // of the eye above the base, times k
    rate: f32,                  // k climb: the density falls by e^(-rate x)
}

fn climb_of(fog: HeightFog, ray: Ray) -> Climb {
    let height = (ray.origin.y - fog.base_height) * fog.falloff;
    return Climb(exp(min(-height, DENSITY_MAX)), height, fog.falloff * ray.direction.y);
}

fn density_along(climb: Climb, x: f32) -> f32 {
    return exp(min(-climb.height - climb.rate * x, DENSITY_MAX));
}

// About how far along the ray E grows to `effective` from where the density is `density`: at most WAY_MAX. Pieces end there.
fn way_of(climb: Climb, density: f32, effective: f32) -> f32 {
    let least = effective / max(density, 1e-30);
    let u = least * climb.rate;
    let whole = select(WAY_MAX, -log(max(1.0 - u, 1e-30)) / climb.rate, u < 1.0);
    return min(select(whole, least, abs(u) < 1e-3), WAY_MAX);
}

struct Integrand {
    piece: Piece,
    climb: Climb,
    light_height: f32,          // of the light above the base, times k
}

// A node's share of the sum.
fn at_node(integrand: Integrand, node: vec2<f32>) -> vec3<f32> {
    let piece = integrand.piece;
    let climb = integrand.climb;
    let sample = sample_of(piece, node);
    let inverse = 1.0 / max(sample.v, 1e-18);
    let x = max(piece.t + 0.5 * piece.h * (sample.v - inverse), 0.0);
    let r = 0.5 * piece.h * (sample.v + inverse);
    let density = density_along(climb, x);
    let eye = x * mean_density(climb.density, density, climb.rate * x);
    let z = integrand.light_height - climb.height - climb.rate * x;
    let light = r * mean_density(density, exp(min(-integrand.light_height, DENSITY_MAX)), z);
    return sample.share * density * exp2(sample.falloff + piece.rate * (eye + light));
}

// Where in which lobe of which light the next piece starts.
struct HeightCursor {
    light: u32,
    lobe: u32,
    x: f32,                     // m along the ray
    v: f32,                     // of a spot, which may need several pieces between two x
}

struct HeightPiece {
    radiance: vec3<f32>,        // W/(sr m^2)
    next: HeightCursor,
}

// As airlight of airlight.wgsl, in height fog.
fn height_airlight(cursor: HeightCursor, light: Light, medium: Medium, fog: HeightFog, phase: Phase, ray: Ray, way: f32, attenuated_sun: bool, nodes: u32) -> HeightPiece {
    let lobe = lobe_of(phase, cursor.lobe);
    let beside = light_beside_ray(light, ray);
    let climb = climb_of(fog, ray);
    let least = max(least_extinction(medium), 1e-30);

    // where the ray ends, and where this piece of it
    let light_height = (light.position.y - fog.base_height) * fog.falloff;
    let l = length(light.position - ray.origin);
    let light_density = exp(min(-light_height, DENSITY_MAX));
    let depth_of_light = l * mean_density(climb.density, light_density, light_height - climb.height);
    let last = way_of(climb, climb.density, min(depth_of_light, LAST_DEPTH / least) + PIECES_DEPTH / least);
    let thin = select(WAY_MAX, PIECES_DENSITY / climb.rate, climb.rate > 0.0);
    let end = min(min(way, WAY_MAX), min(last, thin));
    let start_density = density_along(climb, cursor.x);
    let falling = PIECE_DENSITY / max(abs(climb.rate), 1e-30);
    let dimming = way_of(climb, start_density, PIECE_DEPTH / least);
    let stop = min(end, cursor.x + min(falling, dimming));
    let before = interval_of_way(beside, cursor.x);
    let through = interval_of_way(beside, stop);
    // one from the eye has its width exactly; of others the part before is taken away
    let start = before.start + before.width;
    let whole = Interval(start, max(through.width - before.width, 0.0));

    let middle_density = density_along(climb, 0.5 * (cursor.x + stop));
    let depth_of_v = max(least * middle_density * beside.h, 1e-30);
    let spot = spot_beside_ray(light, ray.direction, beside.from_light, whole.start, whole.start + whole.width, depth_of_v);
    var chunk = Chunk(whole, false);
    if light.kind == SPOT {
        chunk = chunk_of_spot(spot, light.exponent, lobe.rho, depth_of_v, whole, cursor.v);
    }
    var piece: Piece;
    if phase_table_count != 0u {
        piece = piece_of_table(light, spot, beside, medium, depth_of_v, chunk.interval);
    } else {
        piece = piece_of(lobe, light, spot, beside, medium, depth_of_v, chunk.interval);
    }
    let sum = piece.weight * sum_over_nodes(Integrand(piece, climb, light_height), nodes);
    let scattered = finite(medium.scattering * light.intensity * sum);
    let is_sun = light.kind == DIRECTIONAL;
    let sun = light.intensity * directional_phase(light, lobe, ray) * sunlit(light, medium, fog, ray, way, attenuated_sun);

    // a piece too short for f32 would have no end
    let more_of_ray = !is_sun && stop < end && stop > cursor.x;
    let more = chunk.more || more_of_ray;
    let more_lobes = cursor.lobe + 1u < phase.lobe_count;
    let next_lobe = select(select(0u, cursor.lobe + 1u, more_lobes), cursor.lobe, more);
    let next_light = cursor.light + select(1u, 0u, more || more_lobes);
    let next_x = select(select(0.0, stop, more_of_ray), cursor.x, chunk.more);
    let next_v = select(0.0, chunk.interval.start + chunk.interval.width, chunk.more);
    return HeightPiece(select(scattered, sun, is_sun), HeightCursor(next_light, next_lobe, next_x, next_v));
}

// What a medium scatters of a directional light's irradiance over `way` metres of the ray, for a phase function of 1:
// albedo (1 - e^(-sigma_t E)) where every point has the whole irradiance. Where the medium takes of it on its way down, as
// it does outdoors: with s the sine of the light's elevation, a point's way to the light is density/(k s), and
// density = density at the eye - k climb E. So the exponent is linear in E:
//   sigma_s * integral over E of e^(-sigma_t (E + density/(k s)))
fn sunlit(light: Light, medium: Medium, fog: HeightFog, ray: Ray, way: f32, attenuated: bool) -> vec3<f32> {
    let effective = effective_way(fog, ray.origin.y, ray.direction.y, way);
    let whole = albedo(medium) * opacity(medium, effective);
    // a light from below or along the ground, or without falloff, has an endless medium before it
    let sine = max(-light.direction.y, 1e-6);
    let toward = select(0.0, fog.falloff * sine, -light.direction.y > 1e-6);
    let climb = climb_of(fog, ray);
    let x = min(way, ENDLESS);
    let to_light = 1.0 / max(toward, 1e-30);
    let near = medium.extinction * min(climb.density * to_light, ENDLESS);
    let far = medium.extinction * min(min(effective, ENDLESS) + density_along(climb, x) * to_light, ENDLESS);
    // per metre of E the exponent grows by sigma_t (1 - climb/s)
    let slope = 1.0 - ray.direction.y / sine;
    let growth = medium.extinction * slope * min(effective, ENDLESS);
    let series = medium.scattering * min(effective, ENDLESS) * exp(-near) * (1.0 - growth * (0.5 - growth / 6.0));
    let steep = albedo(medium) * (exp(-near) - exp(-far)) / slope;
    // by choices between values: software Vulkan (Mesa 22.3) crashes on an early return here
    return select(whole, select(steep, series, abs(growth) < vec3<f32>(0.01)), attenuated);
}
