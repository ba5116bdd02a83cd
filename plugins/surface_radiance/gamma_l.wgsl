// Biri's table of T for Lambert, with the degrees of its clamped form beside it: see shaders/surface_table.wgsl.
#import phase
#import scene
#import surface_table

struct Params {
    size: u32,
}

var<uniform> params: Params;
var<uniform> phase: Phase;
var table: texture_storage_2d<rgba32float, write>;

@compute @workgroup_size(64)
fn main(@builtin(global_invocation_id) id: vec3<u32>) {
    let size = vec2<u32>(params.size, 1u);
    let depth = depth_of_texel(id.x, params.size);
    let scattering = phase;
    let width = least_width(scattering);
    var sum = vec4<f32>(0.0);
    var i = 0u;
    loop {
        let ring = ring_between(0.0, PI, depth, width, i);
        var along = 0.0;
        var k = 0u;
        loop {
            let node = tau_node(ring.nodes, k);
            along += node.weight * phase_at(scattering, node.w);
            k++;
            if k >= TAU_NODES { break; }
        }
        sum += ring.weight * along * zonal_polynomials(cos(ring.gamma));
        i++;
        if i >= GAMMA_NODES { break; }
    }
    if all(id.xy < size) {
        textureStore(table, id.xy, sum * exp(-depth));
    }
}
