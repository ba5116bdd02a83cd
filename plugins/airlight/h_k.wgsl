// Hong's H_0 to H_3, one to a channel: see shaders/airlight_table.wgsl. They depend on nothing at all.
#import airlight_table

struct Params {
    size: u32,
}

var<uniform> params: Params;
var table: texture_storage_2d<rgba32float, write>;

@compute @workgroup_size(8, 8)
fn main(@builtin(global_invocation_id) id: vec3<u32>) {
    let size = vec2<u32>(params.size);
    let nodes = nodes_of_texel(id.xy, size, 1.0);
    var sum = vec4<f32>(0.0);
    var i = 0u;
    loop {
        let node = tau_node(nodes, i);
        sum += node.weight * legendre_polynomials(1.0 - 2.0 * node.w);
        i++;
        if i >= TAU_NODES { break; }
    }
    if all(id.xy < size) {
        textureStore(table, id.xy, select(sum, vec4<f32>(0.0), id.y == 0u));
    }
}
