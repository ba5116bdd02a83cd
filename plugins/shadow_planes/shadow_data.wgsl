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

// Edges in a slice, from the axis outward as the light sees them: in the upper 22 bits of x those of n/r of an edge's points in
// the slice at most, 1/m; in the lower 10 of the cosine of their angle with the axis, as the eye sees them, at least; in y the
// edge's number. A vector, as all that a walk reads: software Vulkan reads each member of a struct by itself.
struct ShadowCrossings {
    count: u32,
    pad0: u32,
    pad1: u32,
    pad2: u32,
    items: array<vec2<u32>>,
}

// Of a silhouette, or of a triangle that touches the eye; it runs counter-clockwise about the axis.
struct ShadowEdge {
    a: vec4<f32>,               // m, frame of the light; w: triangles beyond it less those before it, as the light sees it; at the eye the other way round
    b: vec4<f32>,               // m; w: `away`, of a triangle that touches the eye: z where the axis meets its plane, m, below 0 if the eye is behind; else 0
}

struct ShadowEdges {
    count: u32,
    pad0: u32,
    pad1: u32,
    pad2: u32,
    items: array<ShadowEdge>,
}
