//! What a decoded scene consists of. Lengths are metres, angles radians, colours linear RGB.

use std::sync::Arc;

use glam::{DAffine3, DQuat, DVec3, Vec3};

use crate::animate::Animated;
use crate::field::Fields;
use crate::mesh::Mesh;
use crate::microfacets::Lobe;
use crate::primitives::Primitive;

pub use tyndall_shaders::scene::Medium;

/// Where a light or the camera stands and looks.
#[derive(Clone, Debug, PartialEq)]
pub enum Placement {
    /// In world space, as the scene file says.
    World {
        /// Metres.
        position: Animated,
        /// Never of length 0; not normalised.
        direction: Animated,
    },
    /// At the origin of a glTF node, looking along its −z.
    Node {
        /// Index into the scene's objects.
        object: usize,
        /// Index into the object's nodes.
        node: usize,
    },
}

/// What kind of light it is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum LightKind {
    /// The same intensity to all sides.
    Point,
    /// I·cosᴺθ inside a cone, 0 outside.
    Spot {
        /// N.
        exponent: f64,
        /// Half-angle of the cone, radians, 0..π/2.
        cutoff: f64,
    },
    /// The same irradiance everywhere, unattenuated.
    Directional,
}

/// A light.
#[derive(Clone, Debug, PartialEq)]
pub struct Light {
    /// Kind and what only that kind has.
    pub kind: LightKind,
    /// W/sr; of a directional light its irradiance, W/m².
    pub intensity: Animated,
    /// Metres; floors the distance of the light from a ray.
    pub radius: f64,
    /// Where it stands and the way its light travels.
    pub placement: Placement,
    /// Those that plugins bring.
    pub fields: Fields,
}

/// Where the picture is taken from.
#[derive(Clone, Debug, PartialEq)]
pub enum Camera {
    /// As the scene file says.
    LookAt {
        /// Metres.
        position: Animated,
        /// Metres; never equal to `position`.
        look_at: Animated,
        /// Never parallel to the view; not normalised.
        up: DVec3,
        /// Whole angle, radians, between 0 and π.
        vertical_fov: f64,
    },
    /// The camera of a glTF file.
    Node {
        /// Index into the scene's objects.
        object: usize,
        /// Index into the object's nodes.
        node: usize,
        /// Whole angle, radians, between 0 and π.
        vertical_fov: f64,
    },
}

/// How a surface reflects.
#[derive(Clone, Debug, PartialEq)]
pub struct Material {
    /// Lambert reflectance ρ; the BRDF is ρ/π. Multiplied with the texture where there is one. Of a metallic-roughness
    /// material its base colour.
    pub diffuse: DVec3,
    /// k_s of the Phong lobe.
    pub specular: DVec3,
    /// n of the Phong lobe.
    pub shininess: f64,
    /// Index into the textures.
    pub texture: Option<usize>,
    /// Of glTF: what ρ, k_s and n are made from; then `specular` is 0 and `shininess` that of the lobe.
    pub metallic_roughness: Option<MetallicRoughness>,
    /// Those that plugins bring.
    pub fields: Fields,
}

/// What makes a base colour b a Lambert reflectance and a Phong lobe: see [`crate::microfacets`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MetallicRoughness {
    /// 0 to 1. Multiplied with the alpha of the texture where there is one.
    pub metallic: f64,
    /// That of the roughness.
    pub lobe: Lobe,
}

impl Default for Material {
    fn default() -> Self {
        let (diffuse, specular) = (DVec3::splat(0.8), DVec3::ZERO);
        let (texture, metallic_roughness) = (None, None);
        Material { diffuse, specular, shininess: 1.0, texture, metallic_roughness, fields: Fields::default() }
    }
}

impl Material {
    /// Whether it has a Phong lobe.
    pub fn is_shiny(&self) -> bool {
        self.specular.max_element() > 0.0 || self.metallic_roughness.is_some()
    }

    /// The number of its shininess among these, from 1; 0 without a Phong lobe.
    pub(crate) fn shininess_rank(&self, shininesses: &[f32]) -> u32 {
        let rank = shininesses.iter().position(|value| *value == self.shininess as f32);
        rank.filter(|_| self.is_shiny()).map_or(0, |index| index as u32 + 1)
    }
}

/// What a texture coordinate outside 0..1 reads; the values are those of `WRAP_…` in `scene.wgsl`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Default)]
pub enum Wrap {
    /// The picture again.
    #[default]
    Repeat = 0,
    /// The picture's edge.
    Clamp = 1,
    /// The picture mirrored.
    Mirror = 2,
}

/// What a texture reads between the centres of texels.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Default)]
pub enum Filter {
    /// A mean of the four nearest texels.
    #[default]
    Linear,
    /// The nearest texel.
    Nearest,
}

/// A picture on a surface.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Texture {
    /// Texels in a row.
    pub width: u32,
    /// Rows.
    pub height: u32,
    /// Along u and v.
    pub wrap: [Wrap; 2],
    /// Between texels.
    pub filter: Filter,
    /// Row by row from the top, RGBA with R in the lowest 8 bits: a colour, sRGB, and a metallic factor, linear.
    pub texels: Vec<u32>,
}

/// An object of the scene file: where it stands and what it consists of.
#[derive(Clone, Debug)]
pub struct Object {
    /// Metres.
    pub translation: Animated,
    /// About the origin, before the translation.
    pub rotation: DQuat,
    /// Along each axis, before the rotation; none is 0, and one below 0 mirrors.
    pub scale: DVec3,
    /// The nodes of a glTF file, parents before children; empty for a primitive.
    pub(crate) nodes: Arc<Vec<Node>>,
    /// Those that plugins bring.
    pub fields: Fields,
}

impl Object {
    /// world ← object.
    pub fn world_from_object(&self, time: f64) -> DAffine3 {
        DAffine3::from_scale_rotation_translation(self.scale, self.rotation, self.translation.at(time))
    }
}

/// A node of a glTF file.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Node {
    /// Index of an earlier node.
    pub parent: Option<usize>,
    /// parent ← node.
    pub transform: NodeTransform,
    /// Whether this node or one above it moves.
    pub moves: bool,
    /// Whether a scale factor may become negative at some time here or above, which turns triangles inside out.
    pub may_flip: bool,
}

/// The transform of a glTF node.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum NodeTransform {
    Fixed(DAffine3),
    Moving(Box<crate::gltf::Motion>),
}

/// A mesh where it stands in the scene, with one material.
#[derive(Clone, Debug)]
pub struct Instance {
    /// Index of the object of the scene file that it belongs to.
    pub object: usize,
    /// Node of the object's glTF file.
    pub(crate) node: Option<usize>,
    /// Its triangles.
    pub mesh: Arc<Mesh>,
    /// What the triangles stand for, where the scene file names a primitive.
    pub primitive: Option<Primitive>,
    /// Index into the scene's materials.
    pub material: usize,
    /// The colours of its mesh count; a material of the scene file replaces them as well.
    pub has_colors: bool,
    /// Whether it is to cast a shadow.
    pub casts_shadow: bool,
}

impl Instance {
    /// What multiplies its diffuse reflectance at a vertex of its mesh.
    pub(crate) fn color(&self, vertex: usize) -> Vec3 {
        self.mesh.colors.get(vertex).copied().filter(|_| self.has_colors).unwrap_or(Vec3::ONE)
    }
}
