// Airlight by the table of `airlight.h`: see shaders/airlight_table.wgsl.
#import "lookup.wgsl"

fn scattered_of_sun(receiver: Receiver, w: f32) -> f32 {
    return phase_at(receiver.scattering, w);
}

@compute @workgroup_size(8, 8)
fn main(@builtin(global_invocation_id) id: vec3<u32>) {
    airlight_of_pixel(id.xy, vec4<f32>(1.0, 0.0, 0.0, 0.0));
}
