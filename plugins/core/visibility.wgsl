// Which triangle each pixel's ray meets first, by rasterising them all.
//
// No near or far plane cuts what the camera sees: the depth buffer holds nearest / t (t the distance in multiples of the
// view ray), reversed, in 32-bit float, so its relative precision is the same at every distance. t comes from the ray
// and the triangle's plane and not from the rasteriser's interpolation, whose error over a large triangle would be
// relative to its nearest corner.
#import scene

var<uniform> camera: Camera;
var<storage, read> vertices: Vertices;
var<storage, read> triangles: Triangles;

// Relative; a few steps of the 32-bit depth buffer.
const BACK_FACE_BIAS = 1e-6;

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
    return Corner(vec4(x, y, camera.nearest, w), p, triangle);
}

struct Visible {
    @location(0) triangle: u32,
    @builtin(frag_depth) depth: f32,
}

@fragment
fn shade(corner: Corner) -> Visible {
    let indices = triangles.items[corner.triangle];
    let a = from_camera(indices.x);
    let b = from_camera(indices.y);
    let c = from_camera(indices.z);
    let normal = cross(b - a, c - a);
    // The interpolated position only gives the ray's direction; the triangle's plane gives the distance.
    let ray = corner.ray / dot(corner.ray, camera.forward);
    let plane = dot(normal, a) / dot(normal, ray);
    // A rasteriser may count a pixel whose centre lies just outside, and seen at a grazing angle the plane is far off
    // there; but no point of the triangle is nearer than its nearest corner, or farther than its farthest.
    let nearest = min(min(dot(a, camera.forward), dot(b, camera.forward)), dot(c, camera.forward));
    let farthest = max(max(dot(a, camera.forward), dot(b, camera.forward)), dot(c, camera.forward));
    let t = clamp(plane, max(nearest, camera.nearest), farthest);
    // Where two faces meet in an outline, the one that faces the eye wins.
    let behind = select(1.0, 1.0 + BACK_FACE_BIAS, dot(normal, ray) > 0.0);
    // Seen edge on, the plane says nothing; the rasteriser's own depth will do.
    let depth = select(corner.clip.z, camera.nearest / (t * behind), t >= camera.nearest && t < 1e27);
    return Visible(corner.triangle + 1u, depth);
}
