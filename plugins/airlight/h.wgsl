// Hong's H(u, theta) of the scene's phase function: see shaders/airlight_table.wgsl. It depends on nothing else.
#import scene
#import phase
#import airlight_table

struct Params {
    size: u32,
}

var<uniform> params: Params;
var<uniform> phase: Phase;
var table: texture_storage_2d<r32float, write>;

@compute @workgroup_size(8, 8)
fn main(@builtin(global_invocation_id) id: vec3<u32>) {
    let size = vec2<u32>(params.size);
    // read before the loop, see shaders/every_light.wgsl
    let scattering = phase;
    let nodes = nodes_of_texel(id.xy, size, least_width(scattering));
    var sum = 0.0;
    var i = 0u;
    loop {
        let node = tau_node(nodes, i);
        sum += node.weight * phase_at(scattering, node.w);
        i++;
        if i >= TAU_NODES { break; }
    }
    if all(id.xy < size) {
        textureStore(table, id.xy, vec4<f32>(select(sum, 0.0, id.y == 0u), 0.0, 0.0, 1.0));
    }
}
