// Airlight by the table of `airlight.h_k`, for the phase function as it is now: see shaders/airlight_table.wgsl.
#import "lookup.wgsl"

fn scattered_of_sun(receiver: Receiver, w: f32) -> f32 {
    return dot(receiver.weights, legendre_polynomials(1.0 - 2.0 * w));
}

@compute @workgroup_size(8, 8)
fn main(@builtin(global_invocation_id) id: vec3<u32>) {
    airlight_of_pixel(id.xy, series_weights(phase));
}
