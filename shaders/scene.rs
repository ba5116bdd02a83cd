//! The part of a scene that light scattering needs, in double precision: twin of `scene.wgsl`.

#[doc(inline)]
pub use crate::phase_functions::Phase;
use glam::{DVec2, DVec3};

/// A triangle that casts a shadow, world, m.
pub type Caster = [DVec3; 3];

/// What passes see of a scene at one time, all surfaces apart but for the shadows that they cast.
#[derive(Debug, Clone, PartialEq)]
pub struct Scene {
    /// Where the picture is taken from.
    pub camera: Camera,
    /// What fills space; none if extinction is 0.
    pub medium: Medium,
    /// How its density falls with the height.
    pub height_fog: HeightFog,
    /// What the medium sends toward the eye that comes from no light of the scene, where it is endless, W/(sr m²).
    pub ambient: DVec3,
    /// What a ray that meets nothing sees behind the medium, W/(sr m²).
    pub background: DVec3,
    /// In the order of the scene.
    pub lights: Vec<Light>,
    /// Every triangle that casts a shadow.
    pub casters: Vec<Caster>,
    /// Shininess of each material that has a Phong lobe, in the order of the scene.
    pub shininesses: Vec<f64>,
}

/// A pinhole camera: twin of `Camera`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Camera {
    /// The eye, m.
    pub position: DVec3,
    /// m along the view axis; closer than this nothing is drawn.
    pub nearest: f64,
    /// To the right, scaled by the tangent of half the horizontal field of view.
    pub right: DVec3,
    /// Up, scaled by the tangent of half the vertical field of view.
    pub up: DVec3,
    /// Unit vector.
    pub forward: DVec3,
}

/// A medium that fills space: homogeneous, unless a [`HeightFog`] goes with it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Medium {
    /// Extinction coefficient σ_t of each channel, 1/m.
    pub extinction: DVec3,
    /// Single-scattering albedo σ_s/σ_t of each channel.
    pub albedo: DVec3,
    /// Phase function.
    pub phase: Phase,
}

impl Medium {
    /// Scattering coefficient σ_s = albedo·σ_t of each channel, 1/m.
    pub fn scattering(&self) -> DVec3 {
        self.albedo * self.extinction
    }

    /// σ_t of the channel in which light goes farthest of those that have any, 1/m; infinite where none has.
    pub fn least_extinction(&self) -> f64 {
        self.extinction.to_array().into_iter().filter(|extinction| *extinction > 0.0).fold(f64::INFINITY, f64::min)
    }
}

/// How the density of a medium falls with the height y: `e^(−(y − base_height)·falloff)`. Twin of `HeightFog`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct HeightFog {
    /// m, where the medium has its own extinction.
    pub base_height: f64,
    /// 1/scale height, 1/m; 0: homogeneous.
    pub falloff: f64,
}

impl HeightFog {
    /// The same density everywhere.
    pub const NONE: HeightFog = HeightFog { base_height: 0.0, falloff: 0.0 };
}

/// A light.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Light {
    /// Shines alike in all directions.
    Point {
        /// m.
        position: DVec3,
        /// W/sr.
        intensity: DVec3,
        /// Floors the distance between light and ray, m.
        radius: f64,
    },
    /// Shines in a cone.
    Spot {
        /// m.
        position: DVec3,
        /// W/sr, on the axis.
        intensity: DVec3,
        /// Floors the distance between light and ray, m.
        radius: f64,
        /// Unit vector, the way the light travels.
        direction: DVec3,
        /// N of cosᴺ.
        exponent: f64,
        /// Half-angle of the cone, degrees, below 180.
        cutoff: f64,
    },
    /// Comes from one direction, everywhere.
    Directional {
        /// Unit vector, the way the light travels.
        direction: DVec3,
        /// W/m².
        irradiance: DVec3,
    },
}

/// What rays can meet, in world space: twin of `Vertices`, `VertexColors`, `Triangles`, `Objects`, `Materials`, `Textures` and `Texels`.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Surfaces {
    /// In the order in which passes number them.
    pub triangles: Vec<Triangle>,
    /// To which the triangles refer.
    pub materials: Vec<Material>,
    /// To which the materials refer.
    pub textures: Vec<Texture>,
}

/// A triangle, counter-clockwise seen from outside.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Triangle {
    /// Its three corners.
    pub corners: [Vertex; 3],
    /// Index into the materials.
    pub material: usize,
}

/// A corner of a triangle.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Vertex {
    /// m.
    pub position: DVec3,
    /// Unit vector.
    pub normal: DVec3,
    /// Texture coordinates; (0, 0) is the corner of the first texel of the top row.
    pub uv: DVec2,
    /// Multiplies the diffuse reflectance.
    pub color: DVec3,
}

/// How a surface reflects.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Material {
    /// Lambert reflectance ρ; the BRDF is ρ/π.
    pub diffuse: DVec3,
    /// k_s of the Phong lobe.
    pub specular: DVec3,
    /// n of the Phong lobe.
    pub shininess: f64,
    /// Of n among the shininesses of the scene, growing, from 1; 0 where k_s is 0.
    pub shininess_rank: u32,
    /// Index into the textures; its colour multiplies `diffuse`.
    pub texture: Option<usize>,
    /// Of a metallic-roughness material, whose base colour is `diffuse`: metallic, k_s of F₀ = 1, and k_s with which the
    /// lobe alone reflects everything.
    pub metallic_roughness: Option<[f64; 3]>,
}

/// What a texture coordinate outside 0..1 reads.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Wrap {
    /// The picture again.
    Repeat,
    /// The picture's edge.
    Clamp,
    /// The picture mirrored.
    Mirror,
}

/// What is read between the centres of texels.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Filter {
    /// A mean of the four nearest texels.
    Linear,
    /// The nearest texel.
    Nearest,
}

/// A picture on a surface.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Texture {
    /// Texels in a row.
    pub width: u32,
    /// Rows.
    pub height: u32,
    /// Along u and v.
    pub wrap: [Wrap; 2],
    /// Between texels.
    pub filter: Filter,
    /// Red, green and blue, sRGB, and a metallic factor, linear, row by row from the top.
    pub texels: Vec<[u8; 4]>,
}
