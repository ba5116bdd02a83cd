//! A scene, read and checked.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use glam::DVec3;
use tyndall_document::{Diagnostics, Source, parse};

use crate::adjacency::Adjacency;
use crate::decode;
use crate::encoded::Encoded;
use crate::extensions::Extensions;
use crate::field::{Fields, MediumFields};
use crate::frame::{Bounds, Frame};
use crate::model::{Camera, Instance, Light, Material, Medium, Object, Texture};
use crate::overrides::{Merged, Overrides};
use crate::read::SceneReader;
use crate::resolve;
use crate::scene_data::SceneData;
use tyndall_shaders::scene::HeightFog;

/// A camera no farther from the world's origin than this, m, sees pictures that single precision errs in by less than 1e-4,
/// unless what it sees is small.
const NEAR_ORIGIN: f64 = 2048.0;

/// The same in multiples of the distance to what it sees.
const NEAR_ORIGIN_FOR_SIZE: f64 = 256.0;

/// Metres; closer than this nothing is drawn, unless what is seen is smaller than a hundredth of a metre.
const NEAREST: f64 = 1e-6;

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
    /// Where everything that a shader sees begins, world, m: see [`Scene::at`].
    pub(crate) origin: DVec3,
    /// Metres along the view axis; closer than this nothing is drawn.
    pub(crate) nearest: f64,
    /// Sections that plugins bring.
    pub fields: Fields,
    /// Fields of the medium that plugins bring.
    pub medium_fields: MediumFields,
    files: Vec<PathBuf>,
    extensions: Arc<Extensions>,
}

impl Scene {
    /// Reads a scene file and the files that it names. `extensions` are what the plugins of a run add to scenes.
    ///
    /// Gives the scene and warnings, in the order of the file.
    ///
    /// # Errors
    /// Every mistake of the file, of the overrides, and of the glTF files, in the order of the file.
    pub fn load(
        path: &Path,
        overrides: &Overrides,
        extensions: &Arc<Extensions>,
    ) -> Result<(Scene, Diagnostics), Diagnostics> {
        let source = Source::read(path)?;
        let folder = path.parent().unwrap_or(Path::new(""));
        let (mut scene, warnings) = Scene::from_source(&source, folder, overrides, extensions)?;
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
        extensions: &Arc<Extensions>,
    ) -> Result<(Scene, Diagnostics), Diagnostics> {
        let mut out = Diagnostics::default();
        let root = parse(source, &mut out).filter(|_| !out.has_errors());
        let Some(mut root) = root else { return Err(out) };
        let merged = Merged::new(source, &mut root, overrides, &mut out);
        let draft = decode::scene(SceneReader::new(&merged, folder, extensions, &mut out), &root);
        // Files are read even after other mistakes, so that theirs are told as well.
        let scene = draft.and_then(|draft| resolve::scene(draft, &merged, root.span, (folder, extensions), &mut out));
        let mut out = merged.restore(out);
        out.sort();
        out.dedup();
        match scene {
            Some(scene) if !out.has_errors() => Ok((scene, out)),
            _ => Err(out),
        }
    }

    pub(crate) fn new(camera: Camera, files: Vec<PathBuf>, extensions: &Arc<Extensions>) -> Scene {
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
            origin: DVec3::ZERO,
            nearest: NEAREST,
            fields: Fields::default(),
            medium_fields: MediumFields::default(),
            files,
            extensions: Arc::clone(extensions),
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

    /// The shininesses of its Phong lobes in single precision, each once, growing.
    pub fn shininesses(&self) -> Vec<f32> {
        let shiny = self.materials.iter().filter(|material| material.is_shiny());
        let mut values: Vec<f32> = shiny.map(|material| material.shininess as f32).collect();
        values.sort_by(f32::total_cmp);
        values.dedup();
        values
    }

    /// What scenes consist of beyond what this crate knows: what it was loaded with.
    pub fn extensions(&self) -> &Extensions {
        &self.extensions
    }

    /// Everything that depends on the time, from the scene's origin.
    ///
    /// Shaders have single precision, which at 1,000 km from the world's origin tells places 6 cm apart. So where the camera
    /// stands far out at time 0, everything is told from there: it is subtracted here in double precision, before
    /// anything is rounded. A camera that travels loses 6e-8 of its way from there.
    pub fn at(&self, time: f64) -> Frame {
        Frame::of(self, time).seen_from(self.origin)
    }

    /// The height of the world's origin is not that of the scene's.
    pub(crate) fn height_fog_from_origin(&self) -> HeightFog {
        HeightFog { base_height: self.height_fog.base_height - self.origin.y, ..self.height_fog }
    }

    /// Chooses the origin by where the camera stands at time 0: near the world's origin that one; and how close to the eye
    /// something can be seen.
    pub(crate) fn choose_origin(&mut self) {
        let frame = Frame::of(self, 0.0);
        let (eye, way) = (frame.camera.position, frame.camera.position.length());
        let far = way > NEAR_ORIGIN.min(NEAR_ORIGIN_FOR_SIZE * frame.nearest_distance());
        self.origin = if far { eye } else { DVec3::ZERO };
        self.nearest = NEAREST * (100.0 * frame.nearest_distance()).min(1.0);
    }

    /// The names of scene data that differ between some two times. All others are the same in every frame.
    pub fn animated(&self) -> Vec<&'static str> {
        self.extensions.data().filter(|data| data.varies(self)).flat_map(SceneData::names).collect()
    }

    /// The scene data of a time for an image of this width/height.
    pub fn encode(&self, time: f64, aspect: f64) -> Encoded {
        self.encode_for(time, aspect, &|_| true)
    }

    /// The same for those who read it: `reads` says of each name whether anybody does. What nobody reads is not made.
    pub fn encode_for(&self, time: f64, aspect: f64, reads: &dyn Fn(&str) -> bool) -> Encoded {
        Encoded::of(self, time, aspect, reads)
    }

    /// World-space box of all vertices at a time; `None` where there are none.
    pub fn bounds(&self, time: f64) -> Option<Bounds> {
        let frame = Frame::of(self, time);
        let corners = self.instances.iter().zip(&frame.transforms);
        let points = corners.flat_map(|(i, t)| i.mesh.positions.iter().map(|p| t.transform_point3(p.as_dvec3())));
        points.fold(None, |bounds: Option<Bounds>, p| Some(bounds.map_or(Bounds::point(p), |b| b.with(p))))
    }

    /// The adjacency of the triangles of each object, and of each of its nodes that moves by itself.
    ///
    /// Vertex and triangle indices are those of the encoded lists, windings those at time 0. Meshes that keep their places
    /// to one another are welded to each other.
    pub fn adjacency(&self) -> Vec<Adjacency> {
        crate::geometry::adjacency(self)
    }
}
