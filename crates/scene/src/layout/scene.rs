//! The structs of `shaders/scene.wgsl`; a test compares names, types and offsets with that file.

use crate::wgsl_struct;

wgsl_struct! {
    /// `Camera`.
    pub struct Camera {
        /// m, world.
        pub position: [f32; 3],
        /// m; closer than this nothing is drawn.
        pub nearest: f32,
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
}

wgsl_struct! {
    /// `Medium`.
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
}

wgsl_struct! {
    /// `Lobe`.
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
}

wgsl_struct! {
    /// `Phase`.
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
}

wgsl_struct! {
    /// `HeightFog`.
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
}

wgsl_struct! {
    /// `Ambient`, padded to the 16 bytes that a uniform takes.
    pub struct Ambient {
        /// W/(sr·m²).
        pub radiance: [f32; 3],
        /// 0.
        pub pad: f32,
    }
}

wgsl_struct! {
    /// What stands before the items of `PhaseTable`.
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
}

wgsl_struct! {
    /// `Background`, padded to the 16 bytes that a uniform takes.
    pub struct Background {
        /// W/(sr·m²).
        pub radiance: [f32; 3],
        /// 0.
        pub pad: f32,
    }
}

wgsl_struct! {
    /// `Light`.
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
        /// 0.
        pub pad0: u32,
        /// 0.
        pub pad1: u32,
    }
}

wgsl_struct! {
    /// What stands before the elements of every list.
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
}

wgsl_struct! {
    /// `Vertex`.
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
}

wgsl_struct! {
    /// `Object`.
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
}

wgsl_struct! {
    /// `Material`.
    pub struct Material {
        /// ρ.
        pub diffuse: [f32; 3],
        /// Index into the textures, or `NO_TEXTURE`.
        pub texture: u32,
        /// k_s.
        pub specular: [f32; 3],
        /// n.
        pub shininess: f32,
        /// Of its shininess among those of the scene, growing, from 1; 0 without a Phong lobe.
        pub shininess_rank: u32,
        /// 0 to 1.
        pub metallic: f32,
        /// k_s of F₀ = 1; 0 of a material that is not metallic-roughness.
        pub peak: f32,
        /// k_s with which the lobe alone reflects everything.
        pub most: f32,
    }
}

/// `NO_TEXTURE`.
pub const NO_TEXTURE: u32 = u32::MAX;

wgsl_struct! {
    /// `Texture`.
    pub struct Texture {
        /// Of its first texel.
        pub offset: u32,
        /// Texels.
        pub width: u32,
        /// Texels.
        pub height: u32,
        /// Wrap of u in bits 0 and 1, of v in bits 2 and 3; bit 4: the nearest texel.
        pub sampling: u32,
    }
}
