// Airlight by the table of `airlight.h`: see shaders/airlight_table.wgsl.
#import "lookup.wgsl"

@compute @workgroup_size(8, 8)
fn main(@builtin(global_invocation_id) id: vec3<u32>) {
    let count = lights.count;
    let scattering = phase;
    let ray = ray_of(id.xy);
    var sum = vec3<f32>(0.0);
    // a list without lights holds one of intensity 0; why the test stands at the end: see shaders/airlight.wgsl
    var i = 0u;
    loop {
        let light = lights.items[i];
        let w = directional_w(light, ray);
        sum += airlight_of(light, ray, id.xy, vec4<f32>(1.0, 0.0, 0.0, 0.0), phase_at(scattering, w));
        i++;
        if i >= count { break; }
    }
    store(id.xy, sum);
}
