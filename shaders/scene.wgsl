// Scene data as passes see it: one buffer each, encoded on the CPU by the scene crate, against whose structs every shader
// that reads it is held.
//
// World space is right-handed with +y up, in metres; colours are linear RGB. A pass declares what it reads by name:
//
//     var<uniform> camera: Camera;            var<storage, read> vertices: Vertices;
//     var<uniform> medium: Medium;            var<storage, read> triangles: Triangles;
//     var<uniform> phase: Phase;              var<storage, read> objects: Objects;
//     var<uniform> background: Background;    var<storage, read> materials: Materials;
//     var<storage, read> lights: Lights;      var<storage, read> textures: Textures;
//     var<storage, read> texels: Texels;      var<uniform> ambient: Ambient;
//     var<storage, read> vertex_colors: VertexColors;
//     var<uniform> height_fog: HeightFog;     var<storage, read> phase_table: PhaseTable; (declared in phase.wgsl)
//
// Plugins bring others, and declare their structs in their own files.
//
// A list is a count, padding to 16 bytes, and at least one element, zeroed where the list is empty. The count of a list is
// also known to the pipeline where a shader declares `override NAME_count: u32;`.

// The ray of a point of the image: normalize(forward + x * right + y * up), x and y from -1 to 1, x to the right, y up.
struct Camera {
    position: vec3<f32>,        // m
    nearest: f32,               // m; closer than this nothing is drawn
    right: vec3<f32>,           // unit vector times the tangent of half the horizontal field of view
    pad0: f32,
    up: vec3<f32>,              // unit vector times the tangent of half the vertical field of view
    pad1: f32,
    forward: vec3<f32>,         // unit vector
    pad2: f32,
}

// A medium that fills space; none if extinction is 0. It is homogeneous unless HeightFog says otherwise: a pass that reads the
// medium and not that is refused a scene with height fog. How it scatters is Phase, scene data of its own: a table over
// directions and optical depths reads that alone, and is kept while the density changes.
struct Medium {
    extinction: vec3<f32>,      // sigma_t, 1/m
    pad0: f32,
    scattering: vec3<f32>,      // sigma_s = albedo * sigma_t, 1/m
    pad1: f32,
}

// How the density of the medium falls with the height y: times e^(-(y - base_height) * falloff).
struct HeightFog {
    base_height: f32,           // m, where the medium has its own extinction
    falloff: f32,               // 1/m, 1/scale height; 0: homogeneous
    pad0: f32,
    pad1: f32,
}

// What the medium sends toward the eye that comes from no light of the scene, as thick as it can be: of a way with the
// transmittance T the eye sees radiance * (1 - T).
struct Ambient {
    radiance: vec3<f32>,        // W/(sr m^2): ambient + (1 - albedo) * emission
}

// One lobe of a phase function, see phase.wgsl:  scale * q^(-3/2 or -2) * (1 + mu_squared * mu^2).
struct Lobe {
    rho: f32,                   // width
    scale: f32,                 // 1/sr
    squared: u32,               // 1: q^(-2), Schlick; 0: q^(-3/2)
    mu_squared: f32,
}

// The phase function of the medium. It is worked out in double precision, as 1 - g is lost in f32.
struct Phase {
    legendre: vec4<f32>,        // mean of the Legendre polynomials P_0..P_3 of mu; of Henyey and Greenstein's 1, g, g^2, g^3
    lobe_count: u32,            // 1 or 2; a lobe beyond it is 0 everywhere
    pad0: u32,
    pad1: u32,
    pad2: u32,
    lobes: array<Lobe, 2>,
}

// A measured phase function: see phase.wgsl, and PhaseTable of phase.rs, which makes it. No elements: there is none.
struct PhaseTable {
    count: u32,
    total: f32,                 // integral of the function over the scattering angle in a plane, 0..pi, 1/sr
    pad0: u32,
    pad1: u32,
    // each at a share s = index/(count - 1), 0..1:
    //   x   the function where xi = s, 1/sr
    //   y   its integral over scattering angles from there to pi, 1/sr
    //   z   xi where that integral is total * s^3
    //   w   0
    items: array<vec4<f32>>,
}

// What a ray that meets nothing sees behind the medium.
struct Background {
    radiance: vec3<f32>,        // W/(sr m^2)
}

// Values of Light.kind.
const POINT: u32 = 0u;
const SPOT: u32 = 1u;
const DIRECTIONAL: u32 = 2u;

struct Light {
    position: vec3<f32>,        // m; Directional: unused
    kind: u32,
    intensity: vec3<f32>,       // W/sr, of a spot on its axis; Directional: irradiance, W/m^2
    radius: f32,                // m; floors h, the distance of the light from a ray
    direction: vec3<f32>,       // unit vector, the way the light travels; Point: unused
    exponent: f32,              // N of a spot's cos^N
    cos_cutoff: f32,            // cosine of a spot's half-angle
    sin_cutoff: f32,            // and its sine, which the cosine of a narrow cone does not hold in f32
    pad0: u32,
    pad1: u32,
}

struct Lights {
    count: u32,
    pad0: u32,
    pad1: u32,
    pad2: u32,
    items: array<Light>,
}

struct Vertex {
    position: vec3<f32>,        // m
    u: f32,
    normal: vec3<f32>,          // unit vector
    v: f32,
}

struct Vertices {
    count: u32,
    pad0: u32,
    pad1: u32,
    pad2: u32,
    items: array<Vertex>,
}

// Each element: what multiplies the diffuse reflectance at a vertex, linear RGB, and 0. One for each vertex, or none where no
// mesh of the scene has colours.
struct VertexColors {
    count: u32,
    pad0: u32,
    pad1: u32,
    pad2: u32,
    items: array<vec4<f32>>,
}

// Each element: three indices into the vertices, then the index of the object.
struct Triangles {
    count: u32,
    pad0: u32,
    pad1: u32,
    pad2: u32,
    items: array<vec4<u32>>,
}

struct Object {
    material: u32,              // index into the materials
    casts_shadow: u32,          // 0 or 1
    pad0: u32,
    pad1: u32,
}

struct Objects {
    count: u32,
    pad0: u32,
    pad1: u32,
    pad2: u32,
    items: array<Object>,
}

const NO_TEXTURE: u32 = 0xffffffffu;

// Of a metallic-roughness material (peak above 0) diffuse is the base colour, and rho, k_s follow from it: see the scene
// crate's `microfacets`.
struct Material {
    diffuse: vec3<f32>,         // Lambert reflectance rho; the BRDF is rho/pi
    texture: u32,               // index into the textures, its colour multiplies diffuse; NO_TEXTURE for none
    specular: vec3<f32>,        // k_s of the Phong lobe
    shininess: f32,             // n of the Phong lobe
    shininess_rank: u32,        // of n among the shininesses of the scene, growing, from 1; 0 where k_s is 0
    metallic: f32,              // times the texture's alpha
    peak: f32,                  // k_s of F_0 = 1
    most: f32,                  // k_s with which the lobe alone reflects everything
}

struct Materials {
    count: u32,
    pad0: u32,
    pad1: u32,
    pad2: u32,
    items: array<Material>,
}

// Values of two bits of Texture.sampling: what a coordinate outside 0..1 reads.
const WRAP_REPEAT: u32 = 0u;
const WRAP_CLAMP: u32 = 1u;
const WRAP_MIRROR: u32 = 2u;

// A bit of Texture.sampling: the nearest texel, and not a mean of four.
const SAMPLE_NEAREST: u32 = 16u;

struct Texture {
    offset: u32,                // of its first texel in the texels
    width: u32,
    height: u32,
    sampling: u32,              // a WRAP value for u in bits 0 and 1, for v in bits 2 and 3; SAMPLE_NEAREST
}

struct Textures {
    count: u32,
    pad0: u32,
    pad1: u32,
    pad2: u32,
    items: array<Texture>,
}

// RGBA, 8 bits each, the first in the lowest bits: a colour, sRGB, and a metallic factor, linear.
struct Texels {
    items: array<u32>,
}
