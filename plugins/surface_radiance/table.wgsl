// Light scattered onto surfaces by the tables of `surface_radiance.j`: see shaders/surface_table.wgsl.
#import "lookup.wgsl"

var lambert: texture_2d<f32>;
var phong: texture_2d<f32>;

fn lobes_at(depth: f32, cosines: vec2<f32>) -> vec2<f32> {
    let first = vec4<f32>(1.0, 0.0, 0.0, 0.0);
    return vec2<f32>(j_at(lambert, first, depth, cosines.x), j_at(phong, first, depth, cosines.y));
}

@compute @workgroup_size(8, 8)
fn main(@builtin(global_invocation_id) id: vec3<u32>) {
    scattered_to_pixel(id.xy);
}
