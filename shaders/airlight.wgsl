// Light scattered once toward the eye along a ray through a homogeneous medium (airlight): see airlight_pieces.wgsl.

#import scene
#import medium
#import phase
#import cone
#import ray
#import airlight_pieces
#import node_sum

alias Integrand = Piece;

// A node's share of the sum.
fn at_node(piece: Piece, node: vec2<f32>) -> vec3<f32> {
    let sample = sample_of(piece, node);
    return sample.share * exp2(sample.falloff + piece.rate * max(piece.t + piece.h * sample.v, 0.0));
}

// Airlight of a piece without sigma_s I.
fn piece_airlight(piece: Piece, nodes: u32) -> vec3<f32> {
    return piece.weight * sum_over_nodes(piece, nodes);
}

// Where in which lobe of which light the next piece starts.
struct Cursor {
    light: u32,
    lobe: u32,
    start: f32,                 // v; of a spot, which may need several pieces: all other lights have one
}

struct PieceOfAirlight {
    radiance: vec3<f32>,        // W/(sr m^2)
    next: Cursor,
}

// Airlight of one piece of one lobe of a light over `way` metres of the ray, infinite to the sky, and what comes next.
fn airlight(cursor: Cursor, light: Light, medium: Medium, phase: Phase, ray: Ray, way: f32, nodes: u32) -> PieceOfAirlight {
    let found = piece_at(cursor, light, medium, phase, ray, vec2<f32>(0.0, way));
    return airlight_of_piece(found, piece_airlight(found.piece, nodes), opacity(medium, way), light, medium, phase, ray);
}

// A piece where a cursor stands, and where it stands behind that.
struct PieceAt {
    piece: Piece,
    interval: Interval,
    lobe: u32,
    next: Cursor,
}

fn piece_at(cursor: Cursor, light: Light, medium: Medium, phase: Phase, ray: Ray, part: vec2<f32>) -> PieceAt {
    let lobe = lobe_of(phase, cursor.lobe);
    let beside = light_beside_ray(light, ray);
    let depth_of_v = max(least_extinction(medium) * beside.h, 1e-30);
    let whole = interval_between(beside, part.x, part.y);
    let spot = spot_beside_ray(light, ray.direction, beside.from_light, whole.start, whole.start + whole.width, depth_of_v);
    var chunk = Chunk(Interval(whole.start, min(whole.width, DEPTH_MAX / depth_of_v)), false);
    if phase_table_count != 0u && light.kind == POINT {
        chunk = chunk_of_table(depth_of_v, whole, cursor.start);
    }
    if light.kind == SPOT {
        chunk = chunk_of_spot(spot, light.exponent, lobe.rho, depth_of_v, whole, cursor.start);
    }
    var piece: Piece;
    if phase_table_count != 0u {
        piece = piece_of_table(light, spot, beside, medium, depth_of_v, chunk.interval);
    } else {
        piece = piece_of(lobe, light, spot, beside, medium, depth_of_v, chunk.interval);
    }
    let more_lobes = cursor.lobe + 1u < phase.lobe_count;
    let next_lobe = select(select(0u, cursor.lobe + 1u, more_lobes), cursor.lobe, chunk.more);
    let next_light = cursor.light + select(1u, 0u, chunk.more || more_lobes);
    let next_start = select(0.0, chunk.interval.start + chunk.interval.width, chunk.more);
    return PieceAt(piece, chunk.interval, cursor.lobe, Cursor(next_light, next_lobe, next_start));
}

// What `piece_airlight` gives of it, as radiance; a directional light needs none of that, but what of the medium is seen there:
// the difference of the transmittances to both ends.
fn airlight_of_piece(found: PieceAt, sum: vec3<f32>, seen: vec3<f32>, light: Light, medium: Medium, phase: Phase, ray: Ray) -> PieceOfAirlight {
    let scattered = finite(medium.scattering * light.intensity * sum);
    let directional = directional_airlight(light, lobe_of(phase, found.lobe), medium, ray, seen);
    return PieceOfAirlight(select(scattered, directional, light.kind == DIRECTIONAL), found.next);
}

// Airlight of one lobe of a directional light, whose irradiance E reaches every point unattenuated:
// albedo p E (e^(-sigma_t x0) - e^(-sigma_t x1)), and 0 where there is no extinction.
fn directional_airlight(light: Light, lobe: Lobe, medium: Medium, ray: Ray, seen: vec3<f32>) -> vec3<f32> {
    return albedo(medium) * light.intensity * directional_phase(light, lobe, ray) * seen;
}
