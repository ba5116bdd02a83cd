// Airlight of a part of a ray by the nodes that it needs: behind a tree a ray has tens of lit parts, and most are short.
//
// All nodes stand in rounds of four, so that a short piece ends after one: software Vulkan runs both sides of a branch,
// and leaves a loop when all its threads are done.
#import scene
#import ray
#import airlight
#import quadrature

// Whether the loop here ended before it was done.
var<private> stopped: bool = false;

// As many nodes as a short piece needs.
const ROUND: u32 = 4u;

// In a short piece v grows by no more than this part of itself, or of the width of the lobe,
const SHORT_RATIO: f32 = 2.0;
// psi by no more than four times the angle that has this tangent,
const SHORT_REACH: f32 = 0.2;
// the optical depth by no more than this,
const SHORT_DEPTH: f32 = 3.0;
// and the angle at a spot by no more than this over sqrt(N), rad.
const SHORT_TURN: f32 = 0.6;

// Whether four nodes do. Over 200,000 such pieces of any lobe and extinction they err by 2.3e-6 (p99) and 2.6e-4 (at
// most), where 12 nodes over pieces of any length err by 1.0e-4 and 3.7e-4.
fn is_short(found: PieceAt, light: Light, medium: Medium) -> bool {
    let start = found.interval.start;
    let width = found.interval.width;
    let extinction = max(max(medium.extinction.x, medium.extinction.y), medium.extinction.z);
    let narrow = width <= SHORT_RATIO * max(start, found.piece.rho) && found.piece.reach <= SHORT_REACH;
    let thin = extinction * found.piece.h * width <= SHORT_DEPTH;
    let turn = 2.0 * width / (1.0 + start * (start + width));
    let steady = found.piece.exponent * turn * turn <= SHORT_TURN * SHORT_TURN;
    return phase_table_count == 0u && ((narrow && thin && steady) || light.kind == DIRECTIONAL);
}

// Of weight 0 behind the last.
fn node_or_none(nodes: u32, i: u32) -> vec2<f32> {
    return select(vec2<f32>(0.0), gauss_legendre(nodes, min(i, nodes - 1u)), i < nodes);
}

// Node i of a round; of the one round of a short piece, of its own rule.
fn node_of_round(nodes: u32, short: bool, round: u32, i: u32) -> vec2<f32> {
    var node = node_or_none(nodes, i);
    node = select(node, node_or_none(nodes, ROUND + i), round == 1u);
    node = select(node, node_or_none(nodes, 2u * ROUND + i), round == 2u);
    node = select(node, node_or_none(nodes, 3u * ROUND + i), round == 3u);
    return select(node, node_or_none(min(nodes, ROUND), i), short);
}

// `piece_airlight` by four nodes where that does.
fn piece_airlight_by_few(piece: Piece, nodes: u32, short: bool) -> vec3<f32> {
    let rounds = select((nodes + ROUND - 1u) / ROUND, 1u, short);
    var sum = vec3<f32>(0.0);
    var round = 0u;
    loop {
        sum += at_node(piece, node_of_round(nodes, short, round, 0u));
        sum += at_node(piece, node_of_round(nodes, short, round, 1u));
        sum += at_node(piece, node_of_round(nodes, short, round, 2u));
        sum += at_node(piece, node_of_round(nodes, short, round, 3u));
        round++;
        if round >= rounds { break; }
    }
    stopped = stopped || round < rounds;
    return piece.weight * sum;
}

// `airlight` of a part of the ray, from x to y metres, by four nodes where that does or `roughly` is enough; but of a whole ray
// as without shadows, to the last bit.
fn airlight_of_part(cursor: Cursor, light: Light, medium: Medium, phase: Phase, ray: Ray, part: vec2<f32>, way: f32, nodes: u32, roughly: bool) -> PieceOfAirlight {
    let found = piece_at(cursor, light, medium, phase, ray, part);
    let is_whole = part.x <= 0.0 && part.y >= way;
    let sum = piece_airlight_by_few(found.piece, nodes, roughly || (!is_whole && is_short(found, light, medium)));
    let near = min(part.x, ENDLESS);
    let seen = transmittance(medium, near) * opacity(medium, max(part.y - near, 0.0));
    return airlight_of_piece(found, sum, seen, light, medium, phase, ray);
}
