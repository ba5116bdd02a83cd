//! glTF 2.0 files (`.glb`, `.gltf`): meshes, node transforms and their animation, base colour, punctual lights, cameras.
//!
//! The JSON is read with `gltf-json`; everything that an index, offset or count refers to is checked here, so that a
//! broken or hostile file ends in a diagnostic that names the element. What a file has that is not read ([`Unread`]) is told
//! in one warning.

mod accessors;
mod container;
mod document;
mod fault;
mod files;
mod images;
mod instancing;
mod lights;
mod materials;
mod meshes;
mod motion;
mod nodes;

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};
use std::sync::Arc;

use gltf::json::{Mesh as JsonMesh, Root};
use tyndall_document::Diagnostics;

use self::accessors::{Data, absent};
use self::document::Document;
use self::fault::{At, Checked, Fault, Report, Unread, element, numbered};
use self::files::Folder;
use self::instancing::MOST_PLACES;
use self::materials::Materials;
use self::meshes::Budget;
use crate::codes::{GLTF_BUFFER_RANGE, GLTF_EXTENSION, GLTF_REFERENCE, GLTF_TOO_LARGE};
use crate::mesh::Mesh;
use crate::model::{Material, Node, Texture};

pub(crate) use self::lights::ModelLight;
pub(crate) use self::materials::encoded_sampling;
pub(crate) use self::meshes::MOST_ELEMENTS;
pub(crate) use self::motion::Motion;

/// What was read of a file.
#[derive(Debug, Default)]
pub(crate) struct Model {
    pub nodes: Arc<Vec<Node>>,
    pub parts: Vec<Part>,
    pub materials: Vec<Material>,
    /// By material; empty where the file gives none.
    pub material_names: Vec<String>,
    pub textures: Vec<Texture>,
    pub lights: Vec<ModelLight>,
    /// Node and whole vertical angle (radians) of the first perspective camera.
    pub camera: Option<(usize, f64)>,
}

/// A mesh primitive at a node.
#[derive(Debug)]
pub(crate) struct Part {
    pub node: usize,
    pub mesh: Arc<Mesh>,
    /// Index into the model's materials.
    pub material: Option<usize>,
}

/// The result of reading a file: nothing where there were errors.
pub(crate) struct Loaded {
    pub model: Option<Model>,
    pub diagnostics: Diagnostics,
    /// Every file that was read besides the glTF file itself.
    pub files: Vec<PathBuf>,
}

/// Reads a file; `name` is what messages call it.
pub(crate) fn load(file: &Path, name: &str) -> Loaded {
    let mut report = Report::new(name);
    let mut folder = Folder::of(file);
    let bytes = files::read(file);
    let model = match bytes.and_then(|bytes| model(&bytes, &mut folder, &mut report)) {
        Ok(model) => Some(model).filter(|_| !report.failed()),
        Err(fault) => {
            report.fault(fault);
            None
        }
    };
    Loaded { model, diagnostics: report.finish(), files: folder.read }
}

fn model(bytes: &[u8], folder: &mut Folder, report: &mut Report) -> Checked<Model> {
    let (json, binary) = container::split(bytes)?;
    let document = Document::read(json)?;
    report.unread_extensions(document.unread_extensions());
    let Document { root, left_out } = document;
    let buffers = buffers(&root, binary, folder)?;
    let data = Data { root: &root, left_out: &left_out, buffers: &buffers };
    let tracks = motion::tracks(data, report);
    let hierarchy = nodes::hierarchy(&root, tracks)?;
    let mut places = instancing::places(data)?;
    let mut nodes: Vec<Node> = hierarchy.iter().map(|(_, node)| node.clone()).collect();
    let drawn: BTreeSet<usize> =
        hierarchy.iter().filter_map(|(index, _)| root.nodes[*index].mesh.map(|m| m.value())).collect();
    let primitives = drawn.iter().filter_map(|&m| root.meshes.get(m)).flat_map(|m| &m.primitives);
    let used = primitives.filter_map(|p| p.material.map(|m| m.value())).collect();
    let materials = materials::read(data, folder, &used, report);
    let meshes = meshes_of(data, &drawn, &materials, report);
    let mut parts = Vec::new();
    for (node, (index, _)) in hierarchy.iter().enumerate() {
        let json = &root.nodes[*index];
        let Some(mesh) = json.mesh.map(|m| m.value()) else { continue };
        let label = || element("node", *index, json.name.as_deref());
        if mesh >= root.meshes.len() {
            report.fault(Fault::new(GLTF_REFERENCE, format!("{}: mesh {mesh} does not exist", label())));
        }
        if json.skin.is_some() {
            report.unread(Unread::SKIN, numbered(*index, json.name.as_deref()));
        }
        let drawn = meshes.get(&mesh).map(Vec::as_slice).unwrap_or_default();
        if parts.len() + drawn.len() * places.get(index).map_or(1, Vec::len) > MOST_PLACES {
            let message = format!("more than {MOST_PLACES} primitives are drawn");
            return Err(Fault::new(GLTF_TOO_LARGE, message)).at(label);
        }
        for at in nodes::instanced(&mut nodes, node, places.remove(index)) {
            let part = |(mesh, material): &Drawn| Part { node: at, mesh: Arc::clone(mesh), material: *material };
            parts.extend(drawn.iter().map(part));
        }
    }
    let lights = lights::lights(&root, &hierarchy, report);
    let camera = lights::camera(&root, &hierarchy, report);
    let nodes = Arc::new(nodes);
    let Materials { materials, textures, .. } = materials;
    let material_names = root.materials.iter().map(|material| material.name.clone().unwrap_or_default()).collect();
    Ok(Model { nodes, parts, materials, material_names, textures, lights, camera })
}

/// Mesh and material of each primitive of each drawn mesh.
type Meshes = BTreeMap<usize, Vec<Drawn>>;

fn meshes_of(data: Data, drawn: &BTreeSet<usize>, materials: &Materials, report: &mut Report) -> Meshes {
    let mut budget = Budget { left: MOST_ELEMENTS };
    let mut meshes = Meshes::new();
    for &index in drawn {
        let Some(json) = data.root.meshes.get(index) else { continue };
        let primitives = meshes.entry(index).or_default();
        for number in 0..json.primitives.len() {
            let mesh = element("mesh", index, json.name.as_deref());
            let unread = |report: &mut Report, what| report.unread(what, format!("{number} of {mesh}"));
            match primitive(data, (index, json), number, materials, &mut budget)
                .at(|| format!("{mesh}, primitive {number}"))
            {
                Ok(Some((part, clamped))) => {
                    primitives.push(part);
                    if clamped {
                        unread(report, Unread::BRIGHT_COLORS);
                    }
                }
                Ok(None) => unread(report, Unread::POINTS_AND_LINES),
                Err(fault) => report.fault(fault),
            }
            if json.primitives[number].targets.is_some() {
                unread(report, Unread::MORPH_TARGETS);
            }
        }
    }
    meshes
}

type Drawn = (Arc<Mesh>, Option<usize>);

fn primitive(
    data: Data,
    (index, mesh): (usize, &JsonMesh),
    number: usize,
    materials: &Materials,
    budget: &mut Budget,
) -> Checked<Option<(Drawn, bool)>> {
    let json = &mesh.primitives[number];
    if data.left_out.vertices.contains(&(index, number)) && !meshes::has_bytes(data, json) {
        let message = "its vertices are compressed by KHR_draco_mesh_compression, which is not read";
        return Err(Fault::new(GLTF_EXTENSION, message));
    }
    let material = json.material.map(|m| m.value());
    if let Some(index) = material.filter(|&index| index >= data.root.materials.len()) {
        return Err(absent("material", index));
    }
    let uv = material.and_then(|index| materials.uvs[index]);
    let mesh = meshes::mesh(data, json, uv, budget)?;
    Ok(mesh.map(|(mesh, clamped)| ((Arc::new(mesh), material), clamped)))
}

/// The bytes of every buffer, each at least as long as announced.
fn buffers(root: &Root, binary: Option<&[u8]>, folder: &mut Folder) -> Checked<Vec<Vec<u8>>> {
    let mut bytes_of = |index: usize, buffer: &gltf::json::Buffer| {
        let bytes = match (&buffer.uri, binary) {
            (Some(uri), _) => folder.fetch(uri)?,
            (None, Some(binary)) if index == 0 => binary.to_vec(),
            (None, _) => return Err(Fault::new(GLTF_REFERENCE, "has no uri, and the file has no binary chunk for it")),
        };
        match usize::try_from(buffer.byte_length.0) {
            Ok(length) if length <= bytes.len() => Ok(bytes),
            _ => {
                let message = format!("announces {} bytes, there are {}", buffer.byte_length.0, bytes.len());
                Err(Fault::new(GLTF_BUFFER_RANGE, message))
            }
        }
    };
    let buffers = root.buffers.iter().enumerate();
    buffers.map(|(i, b)| bytes_of(i, b).at(|| element("buffer", i, b.name.as_deref()))).collect()
}
