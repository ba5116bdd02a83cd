// A froxel grid: the view cut into columns across the picture, and each column into slices along its rays.
//
//   b      border between slices: 0 the eye, n the far end; slice k lies between the borders k and k + 1
//   n      number of slices
//   d(b)   distance of a border along the ray, m: d(0) = 0, then d(b) = near (far/near)^((b - 1)/(n - 1))
//
// Distances are along the ray, as in all ports of this project, and not along the view's axis: so a pixel's depth needs
// no cosine. The ratio of two borders is the same everywhere, so a froxel's shape is the same near and far.
#import scene
#import ray

// What the passes of a grid agree on; its numbers of columns and slices are those of its texture.
struct Grid {
    near: f32,                  // d(1), m
    far: f32,                   // d(n), m
    pad0: f32,
    pad1: f32,
}

fn distance_of_border(grid: Grid, border: f32, slices: u32) -> f32 {
    let part = (border - 1.0) / f32(slices - 1u);
    return select(grid.near * pow(grid.far / grid.near, part), 0.0, border <= 0.0);
}

// The slice that holds a distance; the last one beyond the far end.
fn slice_of_distance(grid: Grid, way: f32, slices: u32) -> u32 {
    let part = log(max(way, grid.near) / grid.near) / log(grid.far / grid.near);
    let border = select(0.0, 1.0 + part * f32(slices - 1u), way > grid.near);
    return min(u32(border), slices - 1u);
}

// The ray through a point of the picture, 0 to 1 to the right and down.
fn ray_of_point(camera: Camera, at: vec2<f32>) -> Ray {
    let across = 2.0 * at - 1.0;
    return Ray(camera.position, normalize(camera.forward + across.x * camera.right - across.y * camera.up));
}
