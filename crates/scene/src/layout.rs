//! The structs of `shaders/scene.wgsl` as bytes; a test compares offsets and sizes with that file.

use bytemuck::{Pod, Zeroable};

/// `Camera`.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, Pod, Zeroable)]
pub struct Camera {
    /// m, world.
    pub position: [f32; 3],
    /// 0.
    pub padding: f32,
    /// Unit vector times the tangent of half the horizontal field of view.
    pub right: [f32; 3],
    /// 0.
    pub pad0: f32,
    /// Unit vector times the tangent of half the vertical field of view.
    pub up: [f32; 3],
    /// 0.
    pub pad1: f32,
    /// Unit vector.
    pub forward: [f32; 3],
    /// 0.
    pub pad2: f32,
}

/// `Medium`.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, Pod, Zeroable)]
pub struct Medium {
    /// σ_t, 1/m.
    pub extinction: [f32; 3],
    /// 0.
    pub pad0: f32,
    /// σ_s, 1/m.
    pub scattering: [f32; 3],
    /// 0.
    pub pad1: f32,
}

/// `Lobe`.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Pod, Zeroable)]
pub struct Lobe {
    /// Width.
    pub rho: f32,
    /// 1/sr.
    pub scale: f32,
    /// Whether the power is −2 and not −3/2.
    pub squared: u32,
    /// Factor of µ².
    pub mu_squared: f32,
}

/// `Phase`.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Pod, Zeroable)]
pub struct Phase {
    /// Means of P₀…P₃.
    pub legendre: [f32; 4],
    /// 1 or 2.
    pub lobe_count: u32,
    /// 0.
    pub pad0: u32,
    /// 0.
    pub pad1: u32,
    /// 0.
    pub pad2: u32,
    /// One or two, and one that is 0 everywhere.
    pub lobes: [Lobe; 2],
}

/// `HeightFog`.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, Pod, Zeroable)]
pub struct HeightFog {
    /// m.
    pub base_height: f32,
    /// 1/m.
    pub falloff: f32,
    /// 0.
    pub pad0: f32,
    /// 0.
    pub pad1: f32,
}

/// `Ambient`, padded to the 16 bytes that a uniform takes.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, Pod, Zeroable)]
pub struct Ambient {
    /// W/(sr·m²).
    pub radiance: [f32; 3],
    /// 0.
    pub pad: f32,
}

/// What stands before the items of `PhaseTable`.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, Pod, Zeroable)]
pub struct PhaseTable {
    /// Number of items.
    pub count: u32,
    /// Integral over the scattering angle, 1/sr.
    pub total: f32,
    /// 0.
    pub pad0: u32,
    /// 0.
    pub pad1: u32,
}

/// `Background`, padded to the 16 bytes that a uniform takes.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, Pod, Zeroable)]
pub struct Background {
    /// W/(sr·m²).
    pub radiance: [f32; 3],
    /// 0.
    pub pad: f32,
}

/// `Light`.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, Pod, Zeroable)]
pub struct Light {
    /// m.
    pub position: [f32; 3],
    /// 0 Point, 1 Spot, 2 Directional.
    pub kind: u32,
    /// W/sr or W/m².
    pub intensity: [f32; 3],
    /// m.
    pub radius: f32,
    /// Unit vector, the way the light travels.
    pub direction: [f32; 3],
    /// N.
    pub exponent: f32,
    /// Cosine of the half-angle.
    pub cos_cutoff: f32,
    /// Sine of the half-angle.
    pub sin_cutoff: f32,
    /// Of a spot, among the cosine lobes, from 1.
    pub lobe: u32,
    /// 0.
    pub pad0: u32,
}

/// What stands before the elements of every list.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, Pod, Zeroable)]
pub struct Header {
    /// Number of elements.
    pub count: u32,
    /// 0.
    pub pad0: u32,
    /// 0.
    pub pad1: u32,
    /// 0.
    pub pad2: u32,
}

/// `Vertex`.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Pod, Zeroable)]
pub struct Vertex {
    /// m, world.
    pub position: [f32; 3],
    /// Texture coordinate.
    pub u: f32,
    /// Unit vector, world.
    pub normal: [f32; 3],
    /// Texture coordinate.
    pub v: f32,
}

/// `Object`.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, Pod, Zeroable)]
pub struct Object {
    /// Index into the materials.
    pub material: u32,
    /// 0 or 1.
    pub casts_shadow: u32,
    /// 0.
    pub pad0: u32,
    /// 0.
    pub pad1: u32,
}

/// `Material`.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, Pod, Zeroable)]
pub struct Material {
    /// ρ.
    pub diffuse: [f32; 3],
    /// Index into the textures, or `NO_TEXTURE`.
    pub texture: u32,
    /// k_s.
    pub specular: [f32; 3],
    /// n.
    pub shininess: f32,
    /// Among the cosine lobes, from 1; 0 without a Phong lobe.
    pub lobe: u32,
    /// 0.
    pub pad0: u32,
    /// 0.
    pub pad1: u32,
    /// 0.
    pub pad2: u32,
}

/// `CosineLobe`.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Pod, Zeroable)]
pub struct CosineLobe {
    /// n.
    pub exponent: f32,
    /// Cosine of the half-angle.
    pub cos_cutoff: f32,
    /// Whether a spot's.
    pub is_spot: u32,
    /// 0.
    pub pad0: u32,
}

/// `NO_TEXTURE`.
pub const NO_TEXTURE: u32 = u32::MAX;

/// `Texture`.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, Pod, Zeroable)]
pub struct Texture {
    /// Of its first texel.
    pub offset: u32,
    /// Texels.
    pub width: u32,
    /// Texels.
    pub height: u32,
    /// Wrap of u in bits 0 and 1, of v in bits 2 and 3.
    pub wrap: u32,
}

/// `OccluderNode`.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Pod, Zeroable)]
pub struct OccluderNode {
    /// m, world.
    pub low: [f32; 3],
    /// The first triangle below it.
    pub first: u32,
    /// m, world.
    pub high: [f32; 3],
    /// Of a leaf its triangles, else 0.
    pub triangles: u32,
    /// The node that follows all below it.
    pub skip: u32,
    /// 0.
    pub pad0: u32,
    /// 0.
    pub pad1: u32,
    /// 0.
    pub pad2: u32,
}

/// `ShadowLight`.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Pod, Zeroable)]
pub struct ShadowLight {
    /// Unit vector, world.
    pub across: [f32; 3],
    /// 1/distance of the light from the eye, 1/m; of a directional light 0.
    pub nearness: f32,
    /// Unit vector, world.
    pub upward: [f32; 3],
    /// Triangles between the light and the eye, without those that touch it.
    pub depth_at_eye: i32,
    /// Unit vector, world, from the light to the eye.
    pub axis: [f32; 3],
    /// Among the shadow slices.
    pub first_bin: u32,
    /// Equal parts of the turn about the axis.
    pub bins: u32,
    /// 0.
    pub pad0: u32,
    /// 0.
    pub pad1: u32,
    /// 0.
    pub pad2: u32,
}

/// `ShadowCrossing`.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Pod, Zeroable)]
pub struct ShadowCrossing {
    /// n/r at most.
    pub nearest: f32,
    /// Among the shadow edges.
    pub edge: u32,
}

/// `ShadowEdge`.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Pod, Zeroable)]
pub struct ShadowEdge {
    /// m, in the frame of the light.
    pub a: [f32; 3],
    /// Triangles beyond it less those before it; of a triangle that touches the eye the other way round.
    pub step: i32,
    /// m, in the frame of the light.
    pub b: [f32; 3],
    /// Where the axis meets the plane of a triangle that touches the eye, m from the eye, below 0 before it; else 0.
    pub away: f32,
}
