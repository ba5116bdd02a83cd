// The view ray of a pixel.
//
//   origin      the eye, m, world
//   direction   unit vector, world

#import scene

struct Ray {
    origin: vec3<f32>,
    direction: vec3<f32>,
}

// The ray through the centre of a pixel; row 0 is the top.
fn ray_of_pixel(camera: Camera, pixel: vec2<u32>, size: vec2<u32>) -> Ray {
    let across = (2.0 * vec2<f32>(pixel) + 1.0) / vec2<f32>(size) - 1.0;
    return Ray(camera.position, normalize(camera.forward + across.x * camera.right - across.y * camera.up));
}
