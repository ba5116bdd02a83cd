//! WGSL that plugins share, as text, and beside each file its twin in double precision: the Rust module of the same
//! stem computes the same thing by the plainest way that reaches at least nine digits, for tests to compare with.
//!
//! Conventions are those of every scene: metres, right-handed, phase functions that integrate to 1 over the sphere,
//! `g > 0` forward, extinction and scattering in 1/m, radiance in W/(sr m²).

pub mod airlight;
pub mod airlight_table;
pub mod colour;
pub mod cone;
pub mod height_fog;
pub mod lights;
pub mod medium;
pub mod phase;
pub mod phase_functions;
pub mod phase_table;
pub mod quadrature;
pub mod ray;
pub mod reflection;
pub mod scene;
pub mod shadow_map;
pub mod shadows;
pub mod surface_table;

/// Every shared module: its name, as in `#import name`, and its text.
pub const MODULES: &[(&str, &str)] = &[
    ("airlight", include_str!("airlight.wgsl")),
    ("airlight_pieces", include_str!("airlight_pieces.wgsl")),
    ("airlight_table", include_str!("airlight_table.wgsl")),
    ("colour", include_str!("colour.wgsl")),
    ("cone", include_str!("cone.wgsl")),
    ("every_light", include_str!("every_light.wgsl")),
    ("height_fog", include_str!("height_fog.wgsl")),
    ("light_sum", include_str!("light_sum.wgsl")),
    ("lights", include_str!("lights.wgsl")),
    ("medium", include_str!("medium.wgsl")),
    ("node_sum", include_str!("node_sum.wgsl")),
    ("phase", include_str!("phase.wgsl")),
    ("quadrature", include_str!("quadrature.wgsl")),
    ("ray", include_str!("ray.wgsl")),
    ("reflection", include_str!("reflection.wgsl")),
    ("scene", include_str!("scene.wgsl")),
    ("shadow_map", include_str!("shadow_map.wgsl")),
    ("surface_table", include_str!("surface_table.wgsl")),
    ("unfinished", include_str!("unfinished.wgsl")),
];
