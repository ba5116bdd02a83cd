//! From what a scene file says to a scene: reads the glTF files and decides camera, lights and materials.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use glam::DVec3;
use tyndall_document::{Diagnostic, Diagnostics, MISSING_FILE, Span};

use crate::animate::Animated;
use crate::codes::{MISSING_CAMERA, NAMED_MATERIALS, SCENE_TOO_LARGE, UNKNOWN_SUFFIX};
use crate::decode::{CameraDraft, Draft, MediumDraft, MeshDraft, NamedMaterial, ObjectDraft};
use crate::extensions::Extensions;
use crate::field::{Fields, MediumFields};
use crate::frame::Frame;
use crate::gltf::{self, MOST_ELEMENTS, Model};
use crate::mesh::Mesh;
use crate::model::{Camera, Instance, Light, Material, Medium, Object, Placement};
use crate::overrides::Merged;
use crate::phase_file;
use crate::primitives::Primitive;
use crate::read::FARTHEST;
use crate::scene::Scene;
use tyndall_shaders::scene::Phase;

/// Reads each file once, however many objects name it.
struct Files<'a> {
    merged: &'a Merged,
    folder: &'a Path,
    out: &'a mut Diagnostics,
    known: BTreeMap<PathBuf, Option<Arc<Model>>>,
    read: Vec<PathBuf>,
}

/// The scene; `None` where a mistake leaves nothing to make of it. Every mistake is in `out`.
pub(crate) fn scene(
    draft: Draft,
    merged: &Merged,
    whole: Span,
    (folder, extensions): (&Path, &Arc<Extensions>),
    out: &mut Diagnostics,
) -> Option<Scene> {
    let mut files = Files { merged, folder, out, known: BTreeMap::new(), read: draft.files };
    let models: Vec<Option<Arc<Model>>> = draft.objects.iter().map(|object| files.model(object)).collect();
    let phase = files.phase(draft.medium.as_ref());
    let complete = draft.objects.iter().zip(&models).all(|(o, m)| m.is_some() == matches!(o.mesh, MeshDraft::File(..)));
    let read = files.read;
    let camera = camera(draft.camera, &models).or_else(|| {
        // Where a file could not be read nobody knows whether it has a camera.
        if complete {
            let message = "there is no camera: the scene file gives none, and no glTF file that it names has one";
            let place = merged.source.place(Span::new(whole.start, whole.start + 1));
            let hint = "add `camera: (position: (…), look_at: (…))`";
            out.push(Diagnostic::error(MISSING_CAMERA, place, message).suggest(hint));
        }
        None
    });
    if !complete {
        return None;
    }
    let mut scene = Scene::new(camera?, read, extensions);
    scene.fields = draft.fields;
    if let Some(MediumDraft { medium, height_fog, ambient, emission, fields, .. }) = draft.medium {
        scene.medium_fields = MediumFields(fields);
        scene.height_fog = height_fog;
        scene.ambient = ambient + (DVec3::ONE - medium.albedo) * emission;
        scene.medium = Some(Medium { phase: phase?, ..medium });
    }
    scene.background = draft.background;
    scene.lights = draft.lights.unwrap_or_else(|| lights(&models));
    let spans: Vec<Span> = draft.objects.iter().map(|object| object.span).collect();
    let mut shared = Shared::default();
    for (object, model) in draft.objects.into_iter().zip(&models) {
        unknown_names(&object.materials, model.as_deref(), merged, out);
        add(&mut scene, object, model.as_deref(), &mut shared);
    }
    scene.choose_origin();
    let fits = within_limits(&scene, merged, whole, out) && within_reach(&scene, merged, &spans, out);
    fits.then_some(scene)
}

impl Files<'_> {
    /// The phase function of the medium; `None` where its file holds none.
    fn phase(&mut self, medium: Option<&MediumDraft>) -> Option<Phase> {
        let Some(MediumDraft { phase_file: Some((text, span)), .. }) = medium else {
            return Some(medium.map_or(Phase::Isotropic, |draft| draft.medium.phase));
        };
        let path = self.merged.path(self.folder, text, *span);
        let table = phase_file::read(&path, &self.merged.source.place(*span), self.out);
        self.read.push(path);
        table.map(Phase::Measured)
    }

    fn model(&mut self, object: &ObjectDraft) -> Option<Arc<Model>> {
        let MeshDraft::File(text, span) = &object.mesh else { return None };
        let path = self.merged.path(self.folder, text, *span);
        if let Some(known) = self.known.get(&path) {
            return known.clone();
        }
        let loaded = self.load(&path, *span);
        self.known.insert(path, loaded.clone());
        loaded
    }

    fn load(&mut self, path: &Path, span: Span) -> Option<Arc<Model>> {
        let name = path.display().to_string();
        let place = self.merged.source.place(span);
        let suffix = path.extension().map(|s| s.to_string_lossy().to_ascii_lowercase());
        if !matches!(suffix.as_deref(), Some("glb" | "gltf")) {
            let message = format!("`{name}` is neither a .glb nor a .gltf file");
            self.out.push(Diagnostic::error(UNKNOWN_SUFFIX, place, message));
            return None;
        }
        if !path.exists() {
            self.out.push(Diagnostic::error(MISSING_FILE, place, format!("there is no file `{name}`")));
            return None;
        }
        let loaded = gltf::load(path, &name);
        self.out.extend(loaded.diagnostics.into_iter().map(|d| d.relate(place.clone(), "named here")));
        self.read.push(path.to_owned());
        self.read.extend(loaded.files);
        loaded.model.map(Arc::new)
    }
}

/// Reports names that no material of the file has.
fn unknown_names(named: &[NamedMaterial], model: Option<&Model>, merged: &Merged, out: &mut Diagnostics) {
    let names = || model.into_iter().flat_map(|model| &model.material_names).map(String::as_str);
    for NamedMaterial { name, span, .. } in named.iter().filter(|named| !names().any(|name| name == named.name)) {
        let message = format!("no material of the file is called `{name}`");
        let mistake = Diagnostic::error(NAMED_MATERIALS, merged.source.place(*span), message);
        let known: Vec<&str> = names().filter(|name| !name.is_empty()).collect();
        out.push(mistake.suggest_near(name, known));
    }
}

fn camera(draft: CameraDraft, models: &[Option<Arc<Model>>]) -> Option<Camera> {
    let given = match draft {
        CameraDraft::Given(camera) => return Some(camera),
        CameraDraft::Model { vertical_fov } => vertical_fov,
    };
    models.iter().enumerate().find_map(|(object, loaded)| {
        let (node, angle) = loaded.as_ref()?.camera?;
        Some(Camera::Node { object, node, vertical_fov: given.unwrap_or(angle) })
    })
}

fn lights(models: &[Option<Arc<Model>>]) -> Vec<Light> {
    let mut lights = Vec::new();
    for (object, loaded) in models.iter().enumerate() {
        for light in loaded.iter().flat_map(|l| &l.lights) {
            lights.push(Light {
                kind: light.kind,
                intensity: Animated::Constant(light.intensity),
                radius: 0.0,
                placement: Placement::Node { object, node: light.node },
                fields: Fields::default(),
            });
        }
    }
    lights
}

/// What objects have in common.
#[derive(Default)]
struct Shared {
    /// Where the materials of a model start in the scene's list.
    models: BTreeMap<*const Model, usize>,
    /// Where the default material stands.
    material: Option<usize>,
    /// Meshes of primitives: equal ones are made once.
    meshes: Vec<(Primitive, Arc<Mesh>)>,
}

impl Shared {
    fn mesh(&mut self, primitive: Primitive) -> Arc<Mesh> {
        if let Some((_, mesh)) = self.meshes.iter().find(|known| known.0 == primitive) {
            return Arc::clone(mesh);
        }
        let mesh = Arc::new(primitive.mesh());
        self.meshes.push((primitive, Arc::clone(&mesh)));
        mesh
    }

    fn default_material(&mut self, list: &mut Vec<Material>) -> usize {
        *self.material.get_or_insert_with(|| push(list, Material::default()))
    }
}

fn add(scene: &mut Scene, draft: ObjectDraft, model: Option<&Model>, shared: &mut Shared) {
    let object = scene.objects.len();
    let ObjectDraft { mesh, translation, rotation, scale, material, materials, casts_shadow, fields, .. } = draft;
    let nodes = model.map(|m| Arc::clone(&m.nodes)).unwrap_or_default();
    scene.objects.push(Object { translation, rotation, scale, nodes, fields });
    let own = material.map(|material| push(&mut scene.materials, material));
    match (mesh, model) {
        (MeshDraft::Primitive(primitive), _) => {
            let material = own.unwrap_or_else(|| shared.default_material(&mut scene.materials));
            let mesh = shared.mesh(primitive);
            let primitive = Some(primitive);
            let has_colors = false;
            scene.instances.push(Instance { object, node: None, mesh, primitive, material, has_colors, casts_shadow });
        }
        (MeshDraft::File(..), Some(model)) => {
            let first = match own {
                Some(_) => 0,
                None => *shared.models.entry(std::ptr::from_ref(model)).or_insert_with(|| adopt(scene, model)),
            };
            let replaced = replaced(&mut scene.materials, materials, model);
            for part in &model.parts {
                let own = own.or_else(|| part.material.and_then(|index| replaced.get(&index).copied()));
                let material = own.or(part.material.map(|m| first + m));
                let material = material.unwrap_or_else(|| shared.default_material(&mut scene.materials));
                let (node, mesh) = (Some(part.node), Arc::clone(&part.mesh));
                let has_colors = own.is_none() && !mesh.colors.is_empty();
                let primitive = None;
                scene.instances.push(Instance { object, node, mesh, primitive, material, has_colors, casts_shadow });
            }
        }
        (MeshDraft::File(..), None) => {}
    }
}

/// What stands for materials of a model, by their index there. All of one name are replaced.
fn replaced(list: &mut Vec<Material>, named: Vec<NamedMaterial>, model: &Model) -> BTreeMap<usize, usize> {
    let mut replaced = BTreeMap::new();
    for NamedMaterial { name, material, .. } in named {
        let index = push(list, material);
        let of_name = model.material_names.iter().enumerate().filter(|(_, known)| **known == name);
        replaced.extend(of_name.map(|(of_model, _)| (of_model, index)));
    }
    replaced
}

fn push(list: &mut Vec<Material>, material: Material) -> usize {
    list.push(material);
    list.len() - 1
}

/// Takes a model's materials and textures over; gives the index of its first material.
fn adopt(scene: &mut Scene, model: &Model) -> usize {
    let first = scene.materials.len();
    let textures = scene.textures.len();
    scene.textures.extend(model.textures.iter().cloned());
    let moved = |m: &Material| Material { texture: m.texture.map(|t| t + textures), ..m.clone() };
    scene.materials.extend(model.materials.iter().map(moved));
    first
}

fn within_limits(scene: &Scene, merged: &Merged, whole: Span, out: &mut Diagnostics) -> bool {
    let sum = |of: fn(&Instance) -> usize| scene.instances.iter().map(of).sum::<usize>();
    let texels: usize = scene.textures.iter().map(|t| t.texels.len()).sum();
    let counts = [
        ("vertices", sum(|i| i.mesh.positions.len()), MOST_ELEMENTS),
        ("triangles", sum(|i| i.mesh.triangles.len()), MOST_ELEMENTS),
        ("texels", texels, 4 * MOST_ELEMENTS),
    ];
    let mut fits = true;
    for (name, count, most) in counts {
        if count > most {
            let place = merged.source.place(Span::new(whole.start, whole.start + 1));
            let message = format!("the scene has {count} {name}; at most {most} are possible");
            out.push(Diagnostic::error(SCENE_TOO_LARGE, place, message));
            fits = false;
        }
    }
    fits
}

/// A transform takes no object out of the range that numbers of a scene file have.
fn within_reach(scene: &Scene, merged: &Merged, spans: &[Span], out: &mut Diagnostics) -> bool {
    let mut reaches = vec![0.0_f64; spans.len()];
    for (instance, transform) in scene.instances.iter().zip(Frame::of(scene, 0.0).transforms) {
        let places = instance.mesh.positions.iter().map(|p| transform.transform_point3(p.as_dvec3()));
        let reach = places.map(|place| place.abs().max_element()).fold(0.0, f64::max);
        reaches[instance.object] = reaches[instance.object].max(reach);
    }
    let beyond: Vec<_> = reaches.iter().zip(spans).filter(|(reach, _)| **reach > FARTHEST).collect();
    for (reach, span) in &beyond {
        let message = format!("the object reaches {reach:e} m from the origin; it must be at most {FARTHEST:e}");
        out.push(Diagnostic::error(SCENE_TOO_LARGE, merged.source.place(**span), message));
    }
    beyond.is_empty()
}
