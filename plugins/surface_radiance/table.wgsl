// Light scattered onto surfaces by the tables of `surface_radiance.j`: see shaders/surface_table.wgsl.
#import "lookup.wgsl"

@compute @workgroup_size(8, 8)
fn main(@builtin(global_invocation_id) id: vec3<u32>) {
    scattered_to_pixel(id.xy, vec4<f32>(1.0, 0.0, 0.0, 0.0));
}
