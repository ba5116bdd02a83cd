// Which triangle each pixel's ray meets first, by rasterising them all.
//
// No near or far plane cuts what the camera sees: the depth buffer holds NEAREST / t (t the distance in multiples of the
// view ray), reversed, in 32-bit float, so its relative precision is the same at every distance. t comes from the ray
// and the triangle's plane and not from the rasteriser's interpolation, whose error over a large triangle would be
// relative to its nearest corner.
#import scene

var<uniform> camera: Camera;
var<storage, read> vertices: Vertices;
var<storage, read> triangles: Triangles;

// m; closer than this nothing is drawn.
const NEAREST = 1e-6;

struct Corner {
    @builtin(position) clip: vec4<f32>,
    @location(0) ray: vec3<f32>, // camera.forward + x * right + y * up, not normalised; linear on the screen
    @location(1) @interpolate(flat, either) triangle: u32,
}

fn from_camera(corner: u32) -> vec3<f32> {
    return vertices.items[corner].position - camera.position;
}

@vertex
fn project(@builtin(vertex_index) index: u32) -> Corner {
    let triangle = index / 3u;
    let p = from_camera(triangles.items[triangle][index % 3u]);
    let x = dot(p, camera.right) / dot(camera.right, camera.right);
    let y = dot(p, camera.up) / dot(camera.up, camera.up);
    let w = dot(p, camera.forward);
    return Corner(vec4(x, y, NEAREST, w), p, triangle);
}

struct Visible {
    @location(0) triangle: u32,
    @builtin(frag_depth) depth: f32,
}

@fragment
fn shade(corner: Corner) -> Visible {
    let indices = triangles.items[corner.triangle];
    let a = from_camera(indices.x);
    let normal = cross(from_camera(indices.y) - a, from_camera(indices.z) - a);
    // The interpolated position only gives the ray's direction; its plane gives the distance.
    let ray = corner.ray / dot(corner.ray, camera.forward);
    let t = dot(normal, a) / dot(normal, ray);
    // Seen edge on, the plane says nothing; the rasteriser's own depth will do.
    let depth = select(corner.clip.z, NEAREST / t, t >= NEAREST && t < 1e30);
    return Visible(corner.triangle + 1u, depth);
}
