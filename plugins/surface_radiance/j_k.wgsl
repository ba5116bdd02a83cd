// Hong's J_0 to J_3 of one lobe, one to a channel: see shaders/surface_table.wgsl.
#import surface_table
#import "table_lobe.wgsl"

struct Params {
    size: u32,
    lobe: u32,                  // 0 Lambert, 1 Phong
}

var<uniform> params: Params;

var table: texture_storage_2d<rgba32float, write>;

@compute @workgroup_size(8, 8)
fn main(@builtin(global_invocation_id) id: vec3<u32>) {
    let size = vec2<u32>(params.size);
    let place = place_of_texel(id.xy, size);
    let n = exponent_of_table(params.lobe);
    var sum = vec4<f32>(0.0);
    var i = 0u;
    loop {
        let ring = ring_of_lobe(place, n, 1.0, i);
        var along = vec4<f32>(0.0);
        var k = 0u;
        loop {
            let node = tau_node(ring.nodes, k);
            along += node.weight * legendre_polynomials(1.0 - 2.0 * node.w);
            k++;
            if k >= TAU_NODES { break; }
        }
        sum += ring.weight * along;
        i++;
        if i >= 2u * GAMMA_NODES || (i >= GAMMA_NODES && n >= SHARP) { break; }
    }
    if all(id.xy < size) {
        textureStore(table, id.xy, sum * exp(-place.depth));
    }
}
