// Hong's J(T, theta_s) of the scene's phase function and one lobe: see shaders/surface_table.wgsl.
#import phase
#import surface_table
#import "table_lobe.wgsl"

struct Params {
    size: u32,
    lobe: u32,                  // 0 Lambert, 1 Phong
    rows: u32,                  // 0 angles, 1 cosines
}

var<uniform> params: Params;

var<uniform> phase: Phase;
var table: texture_storage_2d<r32float, write>;

@compute @workgroup_size(8, 8)
fn main(@builtin(global_invocation_id) id: vec3<u32>) {
    let size = vec2<u32>(params.size);
    let by_angle = place_of_texel(id.xy, size);
    let by_cosine = place_by_cosine(id.xy, size);
    let place = SurfacePlace(by_angle.depth, select(by_angle.angle, by_cosine.angle, params.rows == 1u));
    let n = exponent_of_table(params.lobe);
    let scattering = phase;
    let width = least_width(scattering);
    var sum = 0.0;
    var i = 0u;
    loop {
        let ring = ring_of_lobe(place, n, width, i);
        var along = 0.0;
        var k = 0u;
        loop {
            let node = tau_node(ring.nodes, k);
            along += node.weight * phase_at(scattering, node.w);
            k++;
            if k >= TAU_NODES { break; }
        }
        sum += ring.weight * along;
        i++;
        if i >= 2u * GAMMA_NODES || (i >= GAMMA_NODES && n >= SHARP) { break; }
    }
    if all(id.xy < size) {
        textureStore(table, id.xy, vec4<f32>(sum * exp(-place.depth), 0.0, 0.0, 1.0));
    }
}
