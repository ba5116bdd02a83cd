// First pass: the light that each froxel scatters toward the eye, per metre.
//
//   S    sigma_s * sum over the lights of p(w) E e^(-sigma_t r), W/(sr m^3)
//   E    irradiance at the point, I/r^2 of point and spot lights, W/m^2
//   r    way of the light through the medium, m; 0 of a directional light
//   w    sin^2 of half the scattering angle
//   V    volume of a froxel, or of its part that a point stands for, m^3
//   a    radius of a ball of that volume, m
//
// The light-side extinction is exact, which engines leave out. A point cannot stand for a froxel that a lamp is in: over a
// ball of radius a about the lamp the mean of 1/r^2 is 3/a^2, so r is floored at a/sqrt(3), and what the froxel scatters
// in all is right. Where shadows are asked for, a shadow map says of each point whether the light reaches it. What remains is
// the method's own: one value for all of a froxel, and values mixed between froxels.
#import scene
#import medium
#import phase
#import lights
#import every_light
#import shadow_map
#import "grid.wgsl"

override points: u32 = 1;
override shadows: bool = false;

struct Params {
    width: u32,
    height: u32,
    slices: u32,
    near: f32,
    far: f32,
}

var<uniform> params: Params;
var<uniform> camera: Camera;
var<uniform> medium: Medium;
var<uniform> phase: Phase;
var shadow_map: texture_2d_array<f32>;
var scattered: texture_storage_3d<rgba32float, write>;
var<storage, read_write> grid: Grid;

struct Gathered {
    light: u32,
    sum: vec3<f32>,             // of S without sigma_s, over points and lights
    position: vec3<f32>,        // m
    direction: vec3<f32>,       // of the ray through it
    least: f32,                 // of r^2, m^2
    tiles: Tiles,
}

fn gather(before: Gathered, light: Light) -> Gathered {
    let hidden = shadows && is_hidden_in_map(shadow_map, before.tiles, light, before.light, before.position);
    var after = before;
    after.light += 1u;
    after.sum += select(scattered_by(light, before), vec3<f32>(0.0), hidden);
    return after;
}

// S of one light without sigma_s, at a point.
fn scattered_by(light: Light, at: Gathered) -> vec3<f32> {
    let incident = incident_light(light, at.position);
    let w = w_toward_eye(at.direction - incident.to_light);
    let r2 = incident.way * incident.way;
    let floored = select(r2 / max(r2, at.least), 1.0, light.kind == DIRECTIONAL);
    return phase_at(phase, w) * floored * incident.irradiance * transmittance(medium, incident.way);
}

@compute @workgroup_size(8, 8)
fn main(@builtin(global_invocation_id) id: vec3<u32>) {
    let size = vec3<u32>(params.width, params.height, params.slices);
    // a far end that is none would leave nothing to divide by
    let shared_grid = Grid(params.near, max(params.far, 1.001 * params.near), 0.0, 0.0);
    let start = distance_of_border(shared_grid, f32(id.z), size.z);
    let end = distance_of_border(shared_grid, f32(id.z + 1u), size.z);
    let column = vec2<f32>(size.xy);
    let count = points * points * points;
    // of the rectangle that the view cuts out at distance 1, for one column: the columns at its corners are thinner
    let solid_angle = 4.0 * length(camera.right) * length(camera.up) / (column.x * column.y);
    let volume = solid_angle * (end * end * end - start * start * start) / (3.0 * f32(count));
    // 3/(4 pi)
    let a = pow(volume * 0.238732415, 1.0 / 3.0);
    let tiles = tiles_of(lights.count, textureDimensions(shadow_map).x);
    var sum = vec3<f32>(0.0);
    // the middles of points^3 equal parts
    var i = 0u;
    loop {
        let part = vec3<u32>(i, i / points, i / (points * points)) % points;
        let offset = (vec3<f32>(part) + 0.5) / f32(points);
        let ray = ray_of_point(camera, (vec2<f32>(id.xy) + offset.xy) / column);
        let position = ray.origin + mix(start, end, offset.z) * ray.direction;
        sum = gather_lights(Gathered(0u, sum, position, ray.direction, a * a / 3.0, tiles)).sum;
        i++;
        if i >= count { break; }
    }
    if all(id < size) {
        textureStore(scattered, id, vec4<f32>(medium.scattering * sum / f32(count), 1.0));
    }
    if all(id == vec3<u32>(0u)) {
        grid = shared_grid;
    }
}
