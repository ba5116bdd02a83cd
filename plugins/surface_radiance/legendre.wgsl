// Light scattered onto surfaces by the tables of `surface_radiance.j_k`, for the phase function as it is now: see
// shaders/surface_table.wgsl.
#import "lookup.wgsl"

var<uniform> phase: Phase;
var lambert: texture_2d<f32>;
var phong: texture_2d<f32>;

// Of the tables' channels.
var<private> weights: vec4<f32>;

fn lobes_at(depth: f32, cosines: vec2<f32>) -> vec2<f32> {
    return vec2<f32>(j_at(lambert, weights, depth, cosines.x), j_at(phong, weights, depth, cosines.y));
}

@compute @workgroup_size(8, 8)
fn main(@builtin(global_invocation_id) id: vec3<u32>) {
    weights = series_weights(phase);
    scattered_to_pixel(id.xy);
}
