//! A scene as the bytes of GPU buffers, one per name of scene data (`shaders/scene.wgsl`).

use std::collections::BTreeMap;

use bytemuck::{Pod, Zeroable, bytes_of, cast_slice};
use glam::{DAffine3, DMat3, DVec3, Vec3};
use tyndall_shaders::phase;
use tyndall_shaders::scene::{HeightFog, Phase};

use crate::adjacency::Adjacency;
use crate::cosine_lobes::CosineLobes;
use crate::frame::{Frame, FrameLight, View};
use crate::gltf::encoded_wrap;
use crate::layout;
use crate::model::{Instance, LightKind, Material, Medium};
use crate::occluders::{self, OCCLUDER_DATA};
use crate::scene::Scene;
use crate::shadows::{SHADOW_DATA, Shadows};

/// The names of scene data, in the order of [`Encoded::items`].
pub const SCENE_DATA: &[&str] = &[
    "camera",
    "medium",
    "phase",
    "phase_table",
    "height_fog",
    "ambient",
    "background",
    "lights",
    "vertices",
    "triangles",
    "objects",
    "materials",
    "textures",
    "texels",
    "cosine_lobes",
    SHADOW_DATA[0],
    SHADOW_DATA[1],
    SHADOW_DATA[2],
    SHADOW_DATA[3],
    OCCLUDER_DATA[0],
    OCCLUDER_DATA[1],
];

/// Whether a name is of scene data that take time to work out, and follow from others.
pub(crate) fn is_derived(name: &str) -> bool {
    SHADOW_DATA.contains(&name) || OCCLUDER_DATA.contains(&name)
}

const CAMERA: usize = 0;
const LIGHTS: usize = 7;
const VERTICES: usize = 8;
const TRIANGLES: usize = 9;
const SHADOWS: usize = 15;
const OCCLUDERS: usize = 19;

/// The bytes of each name of scene data.
#[derive(Clone, Debug, PartialEq)]
pub struct Encoded {
    /// One for each name of [`SCENE_DATA`], in that order.
    pub items: Vec<(&'static str, Vec<u8>)>,
    time: f64,
    aspect: f64,
    shadows: Option<Shadows>,
    /// Somebody reads them.
    occluders: bool,
}

impl Encoded {
    pub(crate) fn of(scene: &Scene, time: f64, aspect: f64, reads: &dyn Fn(&str) -> bool) -> Encoded {
        let frame = scene.at(time);
        let medium = scene.medium.as_ref().unwrap_or(&VACUUM);
        let lobes = CosineLobes::of(&scene.materials, &frame.lights);
        let bytes = [
            bytes_of(&camera(&frame.camera, aspect)).to_vec(),
            bytes_of(&layout::Medium::from(medium)).to_vec(),
            bytes_of(&layout::Phase::from(&medium.phase)).to_vec(),
            phase_table(&medium.phase),
            bytes_of(&height_fog(&scene.height_fog)).to_vec(),
            bytes_of(&layout::Ambient { radiance: floats(scene.ambient), pad: 0.0 }).to_vec(),
            bytes_of(&layout::Background { radiance: floats(scene.background), pad: 0.0 }).to_vec(),
            list(frame.lights.iter().map(|light| encoded_light(light, &lobes))),
            vertices(scene, &frame),
            triangles(scene, &frame),
            list(scene.instances.iter().map(object)),
            list(scene.materials.iter().map(|material| encoded_material(material, &lobes))),
            textures(scene),
            texels(scene),
            list(lobes.items.iter().copied()),
        ];
        let nothing = || list(std::iter::empty::<[u32; 16]>());
        let bytes = bytes.into_iter().chain(std::iter::repeat_with(nothing));
        let items = SCENE_DATA.iter().copied().zip(bytes).collect();
        let shadows = SHADOW_DATA.iter().any(|name| reads(name)).then(|| Shadows::new(scene));
        let occluders = OCCLUDER_DATA.iter().any(|name| reads(name));
        let mut encoded = Encoded { items, time, aspect, shadows, occluders };
        encoded.derive(scene, &frame);
        encoded
    }

    /// The bytes of a name; empty for an unknown one.
    pub fn bytes(&self, name: &str) -> &[u8] {
        self.items.iter().find(|item| item.0 == name).map_or(&[], |item| &item.1)
    }

    /// Brings the bytes to another time and aspect of the same scene and gives the names whose bytes may have changed.
    ///
    /// Only what moves is worked out again, in place: buffers keep their sizes, but for those of shadows.
    pub fn update(&mut self, scene: &Scene, time: f64, aspect: f64) -> Vec<&'static str> {
        let mut changed = if time == self.time { Vec::new() } else { scene.animated() };
        if aspect != self.aspect && !changed.contains(&"camera") {
            changed.insert(0, "camera");
        }
        changed.retain(|name| match is_derived(name) {
            true if OCCLUDER_DATA.contains(name) => self.occluders,
            true => self.shadows.is_some(),
            false => true,
        });
        (self.time, self.aspect) = (time, aspect);
        if changed.is_empty() {
            return changed;
        }
        let frame = scene.at(time);
        for name in &changed {
            match *name {
                "camera" => self.write(CAMERA, 0, bytes_of(&camera(&frame.camera, aspect))),
                "lights" => {
                    let lobes = CosineLobes::of(&scene.materials, &frame.lights);
                    let lights: Vec<layout::Light> =
                        frame.lights.iter().map(|light| encoded_light(light, &lobes)).collect();
                    self.write(LIGHTS, size_of::<layout::Header>(), cast_slice(&lights));
                }
                "vertices" => self.move_vertices(scene, &frame),
                "triangles" => self.turn_triangles(scene, &frame),
                // Last, as they follow from the others.
                _ => {}
            }
        }
        if changed.iter().any(|name| is_derived(name)) {
            self.derive(scene, &frame);
        }
        changed
    }

    /// Brings what follows from the vertices as they are encoded, and is read, to them.
    fn derive(&mut self, scene: &Scene, frame: &Frame) {
        if self.occluders {
            let bytes = occluders::encode(&scene.casters(frame));
            for (item, bytes) in self.items[OCCLUDERS..].iter_mut().zip(bytes) {
                item.1 = bytes;
            }
        }
        let Some(shadows) = &mut self.shadows else { return };
        let vertices = &self.items[VERTICES].1[size_of::<layout::Header>()..];
        let positions = vertices.chunks_exact(size_of::<layout::Vertex>()).map(|bytes| {
            let vertex: layout::Vertex = bytemuck::pod_read_unaligned(bytes);
            Vec3::from_array(vertex.position).as_dvec3()
        });
        let bytes = shadows.encode(positions, frame);
        for (item, bytes) in self.items[SHADOWS..].iter_mut().zip(bytes) {
            item.1 = bytes;
        }
    }

    fn write(&mut self, item: usize, offset: usize, bytes: &[u8]) {
        self.items[item].1[offset..offset + bytes.len()].copy_from_slice(bytes);
    }

    fn move_vertices(&mut self, scene: &Scene, frame: &Frame) {
        let mut offset = size_of::<layout::Header>();
        for (instance, transform) in scene.instances.iter().zip(&frame.transforms) {
            let size = instance.mesh.positions.len() * size_of::<layout::Vertex>();
            if scene.instance_moves(instance) {
                let bytes = &mut self.items[VERTICES].1[offset..offset + size];
                let slots = bytes.chunks_exact_mut(size_of::<layout::Vertex>());
                for (slot, vertex) in slots.zip(world_vertices(instance, transform)) {
                    slot.copy_from_slice(bytes_of(&vertex));
                }
            }
            offset += size;
        }
    }

    fn turn_triangles(&mut self, scene: &Scene, frame: &Frame) {
        let bytes = triangles(scene, frame);
        self.write(TRIANGLES, 0, &bytes);
    }
}

pub(crate) fn floats(v: DVec3) -> [f32; 3] {
    v.as_vec3().to_array()
}

fn camera(view: &View, aspect: f64) -> layout::Camera {
    let tangent = (view.vertical_fov / 2.0).tan();
    layout::Camera {
        position: floats(view.position),
        right: floats(view.right * tangent * aspect),
        up: floats(view.up * tangent),
        forward: floats(view.forward),
        ..Default::default()
    }
}

/// What there is where a scene has no medium: nothing.
const VACUUM: Medium = Medium { extinction: DVec3::ZERO, albedo: DVec3::ONE, phase: Phase::Isotropic };

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
    // a scale height that is next to nothing must not become infinite: 0 times that is no number
    let falloff = fog.falloff.min(1e30) as f32;
    layout::HeightFog { base_height: fog.base_height as f32, falloff, ..Default::default() }
}

fn encoded_light(light: &FrameLight, lobes: &CosineLobes) -> layout::Light {
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
        lobe: lobes.of_light(light),
        ..Default::default()
    }
}

/// cos(π/2) is 6e-17 in double precision; a half-space is meant.
pub(crate) fn cosine_of_cutoff(cutoff: f64) -> f32 {
    if cutoff == std::f64::consts::FRAC_PI_2 { 0.0 } else { cutoff.cos() as f32 }
}

fn object(instance: &Instance) -> layout::Object {
    let (material, casts_shadow) = (instance.material as u32, u32::from(instance.casts_shadow));
    layout::Object { material, casts_shadow, ..Default::default() }
}

fn encoded_material(material: &Material, lobes: &CosineLobes) -> layout::Material {
    layout::Material {
        diffuse: floats(material.diffuse),
        texture: material.texture.map_or(layout::NO_TEXTURE, |t| t as u32),
        specular: floats(material.specular),
        shininess: material.shininess as f32,
        lobe: lobes.of_material(material),
        ..Default::default()
    }
}

fn textures(scene: &Scene) -> Vec<u8> {
    let mut offset = 0;
    list(scene.textures.iter().map(|texture| {
        let wrap = encoded_wrap(texture.wrap);
        let encoded = layout::Texture { offset, width: texture.width, height: texture.height, wrap };
        offset += texture.texels.len() as u32;
        encoded
    }))
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

/// Header and elements; one zeroed element where there is none.
pub(crate) fn list<T: Pod>(elements: impl Iterator<Item = T>) -> Vec<u8> {
    let mut bytes = bytes_of(&layout::Header::zeroed()).to_vec();
    let mut count = 0u32;
    for element in elements {
        bytes.extend_from_slice(bytes_of(&element));
        count += 1;
    }
    if count == 0 {
        bytes.extend_from_slice(bytes_of(&T::zeroed()));
    }
    bytes[..4].copy_from_slice(&count.to_le_bytes());
    bytes
}

fn vertices(scene: &Scene, frame: &Frame) -> Vec<u8> {
    let instances = scene.instances.iter().zip(&frame.transforms);
    list(instances.flat_map(|(instance, transform)| world_vertices(instance, transform)))
}

/// Positions through the transform, normals through its cofactors: right for any affine map, also a flattening one.
fn world_vertices<'a>(instance: &'a Instance, transform: &DAffine3) -> impl Iterator<Item = layout::Vertex> + use<'a> {
    let transform = *transform;
    let matrix = transform.matrix3;
    let sign = if matrix.determinant() < 0.0 { -1.0 } else { 1.0 };
    let cofactors = DMat3::from_cols(
        matrix.y_axis.cross(matrix.z_axis),
        matrix.z_axis.cross(matrix.x_axis),
        matrix.x_axis.cross(matrix.y_axis),
    ) * sign;
    let mesh = &instance.mesh;
    mesh.positions.iter().zip(&mesh.normals).zip(&mesh.uvs).map(move |((position, normal), uv)| {
        let turned = (cofactors * normal.as_dvec3()).try_normalize();
        layout::Vertex {
            position: floats(transform.transform_point3(position.as_dvec3())),
            u: uv.x,
            normal: floats(turned.unwrap_or(normal.as_dvec3())),
            v: uv.y,
        }
    })
}

/// Corners of all triangles as indices into the encoded vertices, with the index of their instance; turned around where
/// a transform mirrors, so that they stay counter-clockwise from outside.
pub(crate) fn world_triangles(scene: &Scene, frame: &Frame) -> impl Iterator<Item = [u32; 4]> {
    let mut first = 0;
    let instances = scene.instances.iter().zip(&frame.transforms).enumerate();
    instances.flat_map(move |(index, (instance, transform))| {
        let start = first;
        first += instance.mesh.positions.len() as u32;
        let mirrored = transform.matrix3.determinant() < 0.0;
        instance.mesh.triangles.iter().map(move |&[a, b, c]| {
            let (b, c) = if mirrored { (c, b) } else { (b, c) };
            [start + a, start + b, start + c, index as u32]
        })
    })
}

fn triangles(scene: &Scene, frame: &Frame) -> Vec<u8> {
    list(world_triangles(scene, frame))
}

/// One adjacency per group of meshes that keep their places to one another, with indices into the encoded vertices and
/// triangles; in the order of the objects, and of an object first what its moving nodes do not carry.
pub(crate) fn adjacency(scene: &Scene) -> Vec<Adjacency> {
    let frame = scene.at(0.0);
    let mut triangles = world_triangles(scene, &frame).enumerate();
    let mut groups: BTreeMap<(usize, Option<usize>), Group> = BTreeMap::new();
    let mut first_vertex = 0;
    for (instance, transform) in scene.instances.iter().zip(&frame.transforms) {
        let node = scene.moving_node(instance);
        let group = groups.entry((instance.object, node)).or_default();
        let shift = group.positions.len() as u32;
        // What moves by itself is welded in its own space: at time 0 it may be scaled to nothing.
        match node {
            Some(_) => group.positions.extend(&instance.mesh.positions),
            None => group.positions.extend(world_vertices(instance, transform).map(|v| Vec3::from_array(v.position))),
        }
        group.vertices.extend(first_vertex..first_vertex + instance.mesh.positions.len() as u32);
        for (index, [a, b, c, _]) in triangles.by_ref().take(instance.mesh.triangles.len()) {
            group.triangles.push(index as u32);
            group.corners.push([a, b, c].map(|vertex| vertex - first_vertex + shift));
        }
        first_vertex += instance.mesh.positions.len() as u32;
    }
    groups.into_values().map(Group::adjacency).collect()
}

/// Meshes that keep their places to one another.
#[derive(Default)]
struct Group {
    positions: Vec<Vec3>,
    /// Of each position: its index among the encoded vertices.
    vertices: Vec<u32>,
    /// Into the positions.
    corners: Vec<[u32; 3]>,
    /// Of each of those: its index among the encoded triangles.
    triangles: Vec<u32>,
}

impl Group {
    fn adjacency(self) -> Adjacency {
        let mut adjacency = Adjacency::of(&self.positions, &self.corners);
        adjacency.rename(&self.vertices, &self.triangles);
        adjacency
    }
}
