//! A scene, read and checked.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use glam::DVec3;
use tyndall_document::{Decoder, Diagnostics, Source, parse};

use crate::adjacency::Adjacency;
use crate::cosine_lobes;
use crate::decode;
use crate::encode::{Encoded, SCENE_DATA, is_derived};
use crate::frame::{Bounds, Frame};
use crate::model::{Camera, Instance, Light, LightKind, Material, Medium, Object, Placement, Texture};
use crate::overrides::{Merged, Overrides};
use crate::resolve;
use tyndall_shaders::scene::HeightFog;

/// Everything that a scene file and the files named in it say, checked and ready to be encoded for any time.
#[derive(Clone, Debug)]
pub struct Scene {
    /// Where the picture is taken from.
    pub camera: Camera,
    /// What fills space, if anything.
    pub medium: Option<Medium>,
    /// How the medium's density falls with the height.
    pub height_fog: HeightFog,
    /// What the medium sends toward the eye that comes from no light, where it is thick, W/(sr·m²).
    pub ambient: DVec3,
    /// What a ray that meets nothing sees, W/(sr·m²).
    pub background: DVec3,
    /// Those of the scene file or, where it leaves `lights` out, of its glTF files.
    pub lights: Vec<Light>,
    /// In the order of the scene file.
    pub objects: Vec<Object>,
    /// Meshes where they stand; those of an object follow one another, in the order of the objects.
    pub instances: Vec<Instance>,
    /// To which the instances refer.
    pub materials: Vec<Material>,
    /// To which the materials refer.
    pub textures: Vec<Texture>,
    files: Vec<PathBuf>,
}

impl Scene {
    /// Reads a scene file and the files that it names.
    ///
    /// Gives the scene and warnings, in the order of the file.
    ///
    /// # Errors
    /// Every mistake of the file, of the overrides, and of the glTF files, in the order of the file.
    pub fn load(path: &Path, overrides: &Overrides) -> Result<(Scene, Diagnostics), Diagnostics> {
        let source = Source::read(path)?;
        let folder = path.parent().unwrap_or(Path::new(""));
        let (mut scene, warnings) = Scene::from_source(&source, folder, overrides)?;
        scene.files.insert(0, path.to_owned());
        Ok((scene, warnings))
    }

    /// Reads a scene from its text; paths in it start at `folder`, those in overrides at the working directory.
    ///
    /// # Errors
    /// As [`Scene::load`].
    pub fn from_source(
        source: &Arc<Source>,
        folder: &Path,
        overrides: &Overrides,
    ) -> Result<(Scene, Diagnostics), Diagnostics> {
        let mut out = Diagnostics::default();
        let root = parse(source, &mut out).filter(|_| !out.has_errors());
        let Some(mut root) = root else { return Err(out) };
        let merged = Merged::new(source, &mut root, overrides, &mut out);
        let draft = decode::scene(&mut Decoder { source: &merged.source, out: &mut out }, &root);
        // Files are read even after other mistakes, so that theirs are told as well.
        let scene = draft.and_then(|draft| resolve::scene(draft, &merged, root.span, folder, &mut out));
        let mut out = merged.restore(out);
        out.sort();
        out.dedup();
        match scene {
            Some(scene) if !out.has_errors() => Ok((scene, out)),
            _ => Err(out),
        }
    }

    pub(crate) fn new(camera: Camera, files: Vec<PathBuf>) -> Scene {
        Scene {
            camera,
            medium: None,
            height_fog: HeightFog::NONE,
            ambient: DVec3::ZERO,
            background: DVec3::ZERO,
            lights: Vec::new(),
            objects: Vec::new(),
            instances: Vec::new(),
            materials: Vec::new(),
            textures: Vec::new(),
            files,
        }
    }

    /// Every file that was read: the scene file, glTF files, their buffers and pictures, a phase
    /// function. What a watcher watches.
    pub fn files(&self) -> &[PathBuf] {
        &self.files
    }

    /// Whether the density of the medium falls with the height.
    pub fn has_height_fog(&self) -> bool {
        self.height_fog.falloff > 0.0
    }

    /// How many shininesses its Phong lobes have.
    pub fn shininess_count(&self) -> usize {
        cosine_lobes::shininesses(&self.materials).len()
    }

    /// How many of its spots differ in exponent or cutoff.
    pub fn spot_shape_count(&self) -> usize {
        cosine_lobes::spots(self.lights.iter().map(|light| &light.kind)).len()
    }

    /// Everything that depends on the time, in world space.
    pub fn at(&self, time: f64) -> Frame {
        Frame::of(self, time)
    }

    /// The names of scene data that differ between some two times. All others are the same in every frame.
    pub fn animated(&self) -> Vec<&'static str> {
        let geometry = self.instances.iter().any(|i| self.instance_moves(i));
        let flips = self.instances.iter().any(|i| self.instance_flips(i));
        let lights = self.lights.iter().any(|l| self.light_varies(l));
        let names = [("camera", self.camera_moves()), ("lights", lights), ("vertices", geometry), ("triangles", flips)];
        let moving: Vec<&str> = names.into_iter().filter(|n| n.1).map(|n| n.0).collect();
        let follow = SCENE_DATA.iter().copied().filter(|name| !moving.is_empty() && is_derived(name));
        moving.iter().copied().chain(follow).collect()
    }

    /// The scene data of a time for an image of this width/height.
    pub fn encode(&self, time: f64, aspect: f64) -> Encoded {
        self.encode_for(time, aspect, &|_| true)
    }

    /// The same for those who read it: `reads` says of each name whether anybody does. What takes time,
    /// shadows and occluders, is left empty where nobody reads it.
    pub fn encode_for(&self, time: f64, aspect: f64, reads: &dyn Fn(&str) -> bool) -> Encoded {
        Encoded::of(self, time, aspect, reads)
    }

    /// World-space box of all vertices at a time; `None` where there are none.
    pub fn bounds(&self, time: f64) -> Option<Bounds> {
        let frame = self.at(time);
        let corners = self.instances.iter().zip(&frame.transforms);
        let points = corners.flat_map(|(i, t)| i.mesh.positions.iter().map(|p| t.transform_point3(p.as_dvec3())));
        points.fold(None, |bounds: Option<Bounds>, p| Some(bounds.map_or(Bounds::point(p), |b| b.with(p))))
    }

    /// The adjacency of the triangles of each object, and of each of its nodes that moves by itself.
    ///
    /// Vertex and triangle indices are those of the encoded lists, windings those at time 0. Meshes that keep their places
    /// to one another are welded to each other.
    pub fn adjacency(&self) -> Vec<Adjacency> {
        crate::encode::adjacency(self)
    }

    fn camera_moves(&self) -> bool {
        match &self.camera {
            Camera::LookAt { position, look_at, .. } => position.varies() || look_at.varies(),
            Camera::Node { object, node, .. } => self.node_moves(*object, Some(*node)),
        }
    }

    fn light_varies(&self, light: &Light) -> bool {
        let moves = match (&light.placement, light.kind) {
            (Placement::World { position, .. }, LightKind::Point) => position.varies(),
            (Placement::World { direction, .. }, LightKind::Directional) => direction.varies(),
            (Placement::World { position, direction }, LightKind::Spot { .. }) => {
                position.varies() || direction.varies()
            }
            (Placement::Node { object, node }, _) => self.node_moves(*object, Some(*node)),
        };
        moves || light.intensity.varies()
    }

    /// The node that carries an instance, where it moves within its object.
    pub(crate) fn moving_node(&self, instance: &Instance) -> Option<usize> {
        instance.node.filter(|node| self.objects[instance.object].nodes[*node].moves)
    }

    /// Whether an instance's transform differs between some two times.
    pub fn instance_moves(&self, instance: &Instance) -> bool {
        self.node_moves(instance.object, instance.node)
    }

    /// Whether an instance may turn inside out over time.
    pub(crate) fn instance_flips(&self, instance: &Instance) -> bool {
        let nodes = &self.objects[instance.object].nodes;
        instance.node.is_some_and(|n| nodes[n].may_flip)
    }

    fn node_moves(&self, object: usize, node: Option<usize>) -> bool {
        let object = &self.objects[object];
        object.translation.varies() || node.is_some_and(|n| object.nodes[n].moves)
    }
}
