// Light scattered onto surfaces by the tables of `surface_radiance.gamma_l` and, with rows of cosines, of `surface_radiance.j`:
// see shaders/surface_table.wgsl.
#import "lookup.wgsl"

override clamped: bool = true;

var lambert: texture_2d<f32>;
var phong: texture_2d<f32>;

fn lobes_at(depth: f32, cosines: vec2<f32>) -> vec2<f32> {
    let along = depth / TABLE_DEPTH;
    let zonal = bilinear(lambert, vec2<f32>(along, 0.0));
    let published = zonal.y * cosines.x;
    let irradiance = select(published, dot(zonal, CLAMPED_COSINE * zonal_polynomials(cosines.x)), clamped);
    let glossy = bilinear(phong, vec2<f32>(along, 0.5 + 0.5 * cosines.y)).x;
    // the published shader asks whether the mirrored ray is in front of the lamp
    return vec2<f32>(2.0 * PI * max(irradiance, 0.0), select(0.0, glossy, clamped || cosines.y > 0.0));
}

@compute @workgroup_size(8, 8)
fn main(@builtin(global_invocation_id) id: vec3<u32>) {
    scattered_to_pixel(id.xy);
}
