// The sum over all lights of what a point, a surface or a ray receives of each, see every_light.wgsl.

#import scene
#import every_light

#require struct Receiver
#require fn received(light: Light, index: u32, receiver: Receiver) -> vec3<f32>

struct Gathered {
    light: u32,
    sum: vec3<f32>,
    receiver: Receiver,
}

fn gather(before: Gathered, light: Light) -> Gathered {
    let sum = before.sum + received(light, before.light, before.receiver);
    return Gathered(before.light + 1u, sum, before.receiver);
}

fn received_of_all(receiver: Receiver) -> vec3<f32> {
    return gather_lights(Gathered(0u, vec3<f32>(0.0), receiver)).sum;
}
