// Third pass: the airlight of each pixel, looked up at its depth: linear between the four nearest columns, and within a
// slice as light that is scattered evenly in it accumulates. Nothing is known beyond the far end.
//
//   d0, d1   borders of the pixel's slice, m
//   L0, L1   what reaches the eye from all slices before it, and with it
//   f        (1 - e^(-sigma_t (x - d0)))/(1 - e^(-sigma_t (d1 - d0))), x the pixel's depth
#import scene
#import medium
#import "grid.wgsl"

var<uniform> medium: Medium;
var<uniform> grid: Grid;
var accumulated: texture_3d<f32>;
var depth: texture_2d<f32>;
var radiance: texture_storage_2d<rgba32float, write>;

fn in_column(column: vec2<i32>, slice: u32, part: vec3<f32>) -> vec3<f32> {
    let last = vec2<i32>(textureDimensions(accumulated).xy) - 1;
    let at = vec3<i32>(clamp(column, vec2<i32>(0), last), i32(slice));
    let with_slice = textureLoad(accumulated, at, 0).rgb;
    let before = textureLoad(accumulated, max(at - vec3<i32>(0, 0, 1), vec3<i32>(0)), 0).rgb;
    return mix(select(before, vec3<f32>(0.0), slice == 0u), with_slice, part);
}

@compute @workgroup_size(8, 8)
fn main(@builtin(global_invocation_id) id: vec3<u32>) {
    let size = textureDimensions(radiance);
    if any(id.xy >= size) {
        return;
    }
    let columns = textureDimensions(accumulated);
    let way = min(textureLoad(depth, id.xy, 0).x, grid.far);
    let slice = slice_of_distance(grid, way, columns.z);
    let start = distance_of_border(grid, f32(slice), columns.z);
    let end = distance_of_border(grid, f32(slice + 1u), columns.z);
    // without extinction nothing is scattered, so any share will do
    let share = opacity(medium, max(way - start, 0.0)) / max(opacity(medium, end - start), vec3<f32>(1e-30));
    let part = min(share, vec3<f32>(1.0));

    // centres of columns are at whole numbers
    let at = (vec2<f32>(id.xy) + 0.5) / vec2<f32>(size) * vec2<f32>(columns.xy) - 0.5;
    let corner = vec2<i32>(floor(at));
    let f = at - floor(at);
    let top = mix(in_column(corner, slice, part), in_column(corner + vec2<i32>(1, 0), slice, part), f.x);
    let below = vec2<i32>(0, 1);
    let bottom = mix(in_column(corner + below, slice, part), in_column(corner + vec2<i32>(1, 1), slice, part), f.x);
    textureStore(radiance, id.xy, vec4<f32>(mix(top, bottom, f.y), 1.0));
}
