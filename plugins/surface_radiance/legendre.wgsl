// Light scattered onto surfaces by the tables of `surface_radiance.j_k`, for the phase function as it is now: see
// shaders/surface_table.wgsl.
#import "lookup.wgsl"

var<uniform> phase: Phase;

@compute @workgroup_size(8, 8)
fn main(@builtin(global_invocation_id) id: vec3<u32>) {
    scattered_to_pixel(id.xy, series_weights(phase));
}
