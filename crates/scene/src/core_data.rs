//! The scene data that every scene has: camera, medium, lights, meshes and materials, as `shaders/scene.wgsl` lays them out.

use bytemuck::{bytes_of, cast_slice};
use glam::DVec3;
use tyndall_shaders::phase;
use tyndall_shaders::scene::{HeightFog, Phase};

use crate::frame::{FrameLight, View};
use crate::geometry::Vertices;
use crate::gltf::encoded_sampling;
use crate::layout::{self, Shape, floats};
use crate::model::{Instance, LightKind, Material, Medium};
use crate::moment::Moment;
use crate::part::Part;
use crate::scene::Scene;
use crate::scene_data::{SceneData, list};

/// All of them.
pub(crate) fn core_data() -> Vec<SceneData> {
    vec![
        SceneData::record("camera", &[Part::Camera, Part::Aspect], |at| camera(&at.frame.camera, at.aspect)),
        SceneData::record("medium", &[Part::Medium], |at| layout::Medium::from(medium(at.scene))),
        SceneData::record("phase", &[Part::Medium], |at| layout::Phase::from(&medium(at.scene).phase)),
        SceneData::bytes(("phase_table", Shape::Bytes), &[Part::Medium], |at| phase_table(&medium(at.scene).phase)),
        SceneData::record("height_fog", &[Part::Medium], |at| height_fog(&at.scene.height_fog_from_origin())),
        SceneData::record("ambient", &[Part::Medium], |at| layout::Ambient {
            radiance: floats(at.scene.ambient),
            ..Default::default()
        }),
        SceneData::record("background", &[Part::Background], |at| layout::Background {
            radiance: floats(at.scene.background),
            ..Default::default()
        }),
        SceneData::list("lights", &[Part::Lights], |at| at.frame.lights.iter().map(encoded_light).collect()),
        SceneData::kept(vec![("vertices", Shape::list::<layout::Vertex>())], &[Part::Geometry], |_| Box::new(Vertices)),
        SceneData::list("vertex_colors", &[Part::Materials], |at| vertex_colors(at.scene)),
        SceneData::list("triangles", &[Part::Winding], |at| at.triangles().collect()),
        SceneData::list("objects", &[Part::Materials], |at| at.scene.instances.iter().map(object).collect()),
        SceneData::list("materials", &[Part::Materials], materials),
        SceneData::list("textures", &[Part::Materials], |at| textures(at.scene)),
        SceneData::bytes(("texels", Shape::Bytes), &[Part::Materials], |at| texels(at.scene)),
    ]
}

/// What there is where a scene has no medium: nothing.
static VACUUM: Medium = Medium { extinction: DVec3::ZERO, albedo: DVec3::ONE, phase: Phase::Isotropic };

fn medium(scene: &Scene) -> &Medium {
    scene.medium.as_ref().unwrap_or(&VACUUM)
}

fn camera(view: &View, aspect: f64) -> layout::Camera {
    let tangent = (view.vertical_fov / 2.0).tan();
    layout::Camera {
        position: floats(view.position),
        nearest: view.nearest as f32,
        right: floats(view.right * tangent * aspect),
        up: floats(view.up * tangent),
        forward: floats(view.forward),
        ..Default::default()
    }
}

impl From<&Medium> for layout::Medium {
    fn from(medium: &Medium) -> Self {
        let (extinction, scattering) = (floats(medium.extinction), floats(medium.scattering()));
        layout::Medium { extinction, scattering, ..Default::default() }
    }
}

impl From<&Phase> for layout::Phase {
    fn from(kind: &Phase) -> Self {
        let lobes = phase::lobes(kind);
        let mut encoded = layout::Phase {
            legendre: phase::legendre(kind).map(|mean| mean as f32),
            lobe_count: lobes.len() as u32,
            // a width of 1 and a scale of 0: nothing, everywhere
            lobes: [layout::Lobe { rho: 1.0, ..Default::default() }; 2],
            ..Default::default()
        };
        for (slot, lobe) in encoded.lobes.iter_mut().zip(&lobes) {
            let squared = u32::from(lobe.squared);
            let (rho, scale, mu_squared) = (lobe.rho as f32, lobe.scale as f32, lobe.mu_squared as f32);
            *slot = layout::Lobe { rho, scale, squared, mu_squared };
        }
        encoded
    }
}

/// A measured phase function as a list; an empty one where it is made of lobes.
pub fn phase_table(phase: &Phase) -> Vec<u8> {
    let Phase::Measured(table) = phase else { return list(std::iter::empty::<[f32; 4]>()) };
    let items = table.items();
    let header = layout::PhaseTable { count: items.len() as u32, total: table.total() as f32, ..Default::default() };
    [bytes_of(&header), cast_slice(&items)].concat()
}

fn height_fog(fog: &HeightFog) -> layout::HeightFog {
    // A tiny scale height must not become infinite: 0 times that would be NaN.
    let falloff = fog.falloff.min(1e30) as f32;
    layout::HeightFog { base_height: fog.base_height as f32, falloff, ..Default::default() }
}

fn encoded_light(light: &FrameLight) -> layout::Light {
    let (kind, exponent, cutoff) = match light.kind {
        LightKind::Point => (0, 0.0, std::f64::consts::PI),
        LightKind::Spot { exponent, cutoff } => (1, exponent, cutoff),
        LightKind::Directional => (2, 0.0, std::f64::consts::PI),
    };
    layout::Light {
        position: floats(light.position),
        kind,
        intensity: floats(light.intensity),
        radius: light.radius as f32,
        direction: floats(light.direction),
        exponent: exponent as f32,
        cos_cutoff: cosine_of_cutoff(cutoff),
        sin_cutoff: cutoff.sin() as f32,
        ..Default::default()
    }
}

/// Cosine of a spot's half-angle as passes read it. cos(π/2) is 6e-17 in double precision; a half-space is meant.
pub fn cosine_of_cutoff(cutoff: f64) -> f32 {
    if cutoff == std::f64::consts::FRAC_PI_2 { 0.0 } else { cutoff.cos() as f32 }
}

fn object(instance: &Instance) -> layout::Object {
    let (material, casts_shadow) = (instance.material as u32, u32::from(instance.casts_shadow));
    layout::Object { material, casts_shadow, ..Default::default() }
}

/// One for each vertex, or none where no mesh of the scene has any.
fn vertex_colors(scene: &Scene) -> Vec<[f32; 4]> {
    let is_colored = scene.instances.iter().any(|instance| instance.has_colors);
    let instances = scene.instances.iter().filter(|_| is_colored);
    let colors = |instance: &Instance| {
        let of_vertex = |vertex: usize| instance.color(vertex).extend(0.0).to_array();
        (0..instance.mesh.positions.len()).map(of_vertex).collect::<Vec<_>>()
    };
    instances.flat_map(colors).collect()
}

fn materials(at: &Moment<'_>) -> Vec<layout::Material> {
    let shininesses = at.scene.shininesses();
    let encoded = |material: &Material| {
        let metal = material.metallic_roughness;
        layout::Material {
            diffuse: floats(material.diffuse),
            texture: material.texture.map_or(layout::NO_TEXTURE, |t| t as u32),
            specular: floats(material.specular),
            shininess: material.shininess as f32,
            shininess_rank: material.shininess_rank(&shininesses),
            metallic: metal.map_or(0.0, |metal| metal.metallic as f32),
            peak: metal.map_or(0.0, |metal| metal.lobe.peak as f32),
            most: metal.map_or(0.0, |metal| metal.lobe.most as f32),
        }
    };
    at.scene.materials.iter().map(encoded).collect()
}

fn textures(scene: &Scene) -> Vec<layout::Texture> {
    let mut offset = 0;
    let encoded = |texture: &crate::model::Texture| {
        let sampling = encoded_sampling(texture);
        let encoded = layout::Texture { offset, width: texture.width, height: texture.height, sampling };
        offset += texture.texels.len() as u32;
        encoded
    };
    scene.textures.iter().map(encoded).collect()
}

/// Not a list: an array without a header, of at least one element.
fn texels(scene: &Scene) -> Vec<u8> {
    if scene.textures.is_empty() {
        return vec![0; 4];
    }
    let mut bytes = Vec::with_capacity(scene.textures.iter().map(|t| 4 * t.texels.len()).sum());
    scene.textures.iter().for_each(|t| bytes.extend_from_slice(cast_slice(&t.texels)));
    bytes
}
