// The triangles that cast shadows, in a hierarchy of boxes: scene data that src/occluders.rs makes.

var<storage, read> occluder_nodes: OccluderNodes;
var<storage, read> occluder_corners: OccluderCorners;

// A box of triangles that cast shadows, in a hierarchy; see occluders.wgsl.
struct OccluderNode {
    low: vec3<f32>,             // m, world
    first: u32,                 // triangle below it: its corners are 3 first and the two after it
    high: vec3<f32>,
    triangles: u32,             // of a leaf their number, 4 at most; else 0, and the next node is the first below it
    skip: u32,                  // the node that follows all below it
    pad0: u32,
    pad1: u32,
    pad2: u32,
}

struct OccluderNodes {
    count: u32,
    pad0: u32,
    pad1: u32,
    pad2: u32,
    items: array<OccluderNode>,
}

// Three for each triangle, world, m; w is 0.
struct OccluderCorners {
    count: u32,
    pad0: u32,
    pad1: u32,
    pad2: u32,
    items: array<vec4<f32>>,
}
