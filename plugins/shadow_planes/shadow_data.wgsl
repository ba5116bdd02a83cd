// Where the casters' silhouettes hide a light from view rays: scene data that src/shadows makes and shadows.wgsl walks.

var<storage, read> shadow_lights: ShadowLights;
var<storage, read> shadow_slices: ShadowSlices;
var<storage, read> shadow_crossings: ShadowCrossings;
var<storage, read> shadow_edges: ShadowEdges;

// A light and its frame.
//
// The frame of a light has the eye at its origin, z along the axis from the light to the eye, x and y across it. Its
// nearness kappa is 1/distance of the light from the eye, and 0 of a Directional. At a distance r from the axis a point
// is in the direction n/r as the light sees it, n = 1 + kappa z: that falls along every view ray.
struct ShadowLight {
    across: vec3<f32>,          // unit vector, world: x
    nearness: f32,              // kappa, 1/m
    upward: vec3<f32>,          // unit vector, world: y
    depth_at_eye: i32,          // triangles between the light and the eye, without those that touch it
    axis: vec3<f32>,            // unit vector, world: z
    first_bin: u32,             // among the slices
    bins: u32,                  // equal parts of the turn about the axis; 0 where there is no light
    pad0: u32,
    pad1: u32,
    pad2: u32,
}

// One for each light of the scene.
struct ShadowLights {
    count: u32,
    pad0: u32,
    pad1: u32,
    pad2: u32,
    items: array<ShadowLight>,
}

// For each light: for each of its bins the number of its first slice, times 2^16, and how many slices it has, which are
// equal parts of it; then for each slice where its crossings begin, and one more for the end of the last.
struct ShadowSlices {
    count: u32,
    pad0: u32,
    pad1: u32,
    pad2: u32,
    items: array<u32>,
}

// An edge in a slice, in the order of `nearest`, from the axis outward.
struct ShadowCrossing {
    nearest: f32,               // n/r of its points in the slice at most, 1/m
    edge: u32,                  // among the edges
}

struct ShadowCrossings {
    count: u32,
    pad0: u32,
    pad1: u32,
    pad2: u32,
    items: array<ShadowCrossing>,
}

// Of a silhouette, or of a triangle that touches the eye; it runs counter-clockwise about the axis.
struct ShadowEdge {
    a: vec3<f32>,               // m, frame of the light
    step: i32,                  // triangles beyond it less those before it, as the light sees it; at the eye the other way round
    b: vec3<f32>,
    away: f32,                  // of a triangle that touches the eye: z where the axis meets its plane, m, below 0 if the eye is behind; else 0
}

struct ShadowEdges {
    count: u32,
    pad0: u32,
    pad1: u32,
    pad2: u32,
    items: array<ShadowEdge>,
}
