// Second pass: along each column from the eye to the back, what reaches the eye from all slices up to and with each one.
//
//   L_k   sum over the slices j up to k of S_j e^(-sigma_t d(j)) (1 - e^(-sigma_t (d(j+1) - d(j))))/sigma_t
//
// Within a slice S is taken as constant and the rest is exact, so that thick slices lose and gain nothing (Hillaire 2015,
// "Physically based and unified volumetric rendering in Frostbite", slide 28), per channel.
#import scene
#import medium
#import "grid.wgsl"

var<uniform> medium: Medium;
var<uniform> grid: Grid;
var scattered: texture_3d<f32>;
var whole: texture_storage_2d<rgba32float, write>;
var accumulated: texture_storage_3d<rgba32float, write>;

@compute @workgroup_size(8, 8)
fn main(@builtin(global_invocation_id) id: vec3<u32>) {
    let size = textureDimensions(scattered);
    if any(id.xy >= size.xy) {
        return;
    }
    var sum = vec3<f32>(0.0);
    var near = 0.0;
    var slice = 0u;
    loop {
        let far = distance_of_border(grid, f32(slice + 1u), size.z);
        let seen = transmittance(medium, near) * opacity(medium, far - near) / max(medium.extinction, vec3<f32>(1e-30));
        sum += textureLoad(scattered, vec3<u32>(id.xy, slice), 0).rgb * seen;
        textureStore(accumulated, vec3<u32>(id.xy, slice), vec4<f32>(sum, 1.0));
        near = far;
        slice++;
        if slice >= size.z { break; }
    }
    textureStore(whole, id.xy, vec4<f32>(sum, 1.0));
}
