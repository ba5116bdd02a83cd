// The lobes of the scene's surfaces and spots: scene data that src/cosine_lobes.rs makes.

var<storage, read> cosine_lobes: CosineLobes;
var<storage, read> shininess_layers: LobeLayers;
var<storage, read> spot_layers: LobeLayers;

// cos^n within a cutoff: what a Phong surface reflects and what a spot sends.
struct CosineLobe {
    exponent: f32,              // n
    cos_cutoff: f32,            // 0 or less where n = 0 only
    is_spot: u32,               // 0 or 1
    pad0: u32,
}

// The lobes of the materials and spots of the scene, each once: tables of scattered light are made of this alone, not of
// where the lights are or what colour anything has. At most COSINE_LOBES_MAX of them, which says what is done
// with more.
struct CosineLobes {
    count: u32,
    pad0: u32,
    pad1: u32,
    pad2: u32,
    items: array<CosineLobe>,
}

// Layers of a table that has Lambert's lobe first and then the cosine lobes.
//
// shininess_layers: by the rank of a shininess among those of the scene, from 1; the first is of what has no Phong lobe, and 0.
// spot_layers: one for each light of the scene, of the spot or of the most alike; 0 of other lights.
struct LobeLayers {
    count: u32,
    pad0: u32,
    pad1: u32,
    pad2: u32,
    items: array<u32>,
}
