//! From the spanned tree of a scene file to checked values; every mistake is reported, none stops the others.

mod camera;
mod lights;
mod medium;
mod objects;

use std::path::PathBuf;

use glam::DVec3;
use tyndall_document::{Decoder, Node, Span, Value};

pub(crate) use self::camera::CameraDraft;
pub(crate) use self::medium::MediumDraft;
pub(crate) use self::objects::{MeshDraft, NamedMaterial, ObjectDraft};
use crate::field::{Fields, Holder};
use crate::model::Light;
use crate::read::{POWER, SceneReader, vector};

/// What a scene file says, before the files that it names are read.
#[derive(Debug)]
pub(crate) struct Draft {
    pub camera: CameraDraft,
    pub medium: Option<MediumDraft>,
    pub background: DVec3,
    /// `None` where the field is left out: then the lights of glTF files count.
    pub lights: Option<Vec<Light>>,
    pub objects: Vec<ObjectDraft>,
    /// Sections that plugins bring.
    pub fields: Fields,
    /// Files that fields of plugins named.
    pub files: Vec<PathBuf>,
}

const SCENE_FIELDS: &[&str] = &["camera", "medium", "background", "lights", "objects"];

/// The fields of this crate in a scene file's parts, which no plugin can bring.
pub(crate) fn core_fields(holder: Holder) -> impl Iterator<Item = &'static str> {
    let lists: &[&[&str]] = match holder {
        Holder::Scene => &[SCENE_FIELDS],
        Holder::Medium => &[medium::FIELDS],
        Holder::Light => &[lights::POINT_FIELDS, lights::SPOT_FIELDS, lights::DIRECTIONAL_FIELDS],
        Holder::Object => &[objects::OBJECT_FIELDS],
        Holder::Material => &[objects::MATERIAL_FIELDS],
    };
    lists.iter().flat_map(|list| list.iter().copied())
}

/// Decodes a scene file's tree. The result is usable only where nothing was reported as an error.
pub(crate) fn scene(mut reader: SceneReader<'_>, root: &Node) -> Option<Draft> {
    let decoder = &mut reader;
    let (fields, own) = decoder.fields_of(Holder::Scene, root, "a scene", SCENE_FIELDS)?;
    let none = CameraDraft::Model { vertical_fov: None };
    let camera = or_default(fields.get("camera"), none, |n| camera::camera(decoder, n));
    let medium = or_default(fields.get("medium"), None, |n| medium::medium(decoder, n).map(Some));
    let background = or_default(fields.get("background"), DVec3::ZERO, |n| vector(decoder, n, "background", POWER));
    let lights = or_default(fields.get("lights"), None, |n| lights::lights(decoder, n).map(Some));
    let objects = or_default(fields.get("objects"), Vec::new(), |n| objects::objects(decoder, n));
    let (camera, medium, background) = (camera?, medium?, background?);
    let (lights, objects, fields) = (lights?, objects?, own?);
    Some(Draft { camera, medium, background, lights, objects, fields, files: reader.into_files() })
}

/// The default where a field is left out, else what is read of it.
fn or_default<T>(node: Option<&Node>, default: T, read: impl FnOnce(&Node) -> Option<T>) -> Option<T> {
    match node {
        Some(node) => read(node),
        None => Some(default),
    }
}

/// Reads the content of a variant.
type Reader<T> = fn(&mut SceneReader<'_>, &Node) -> Option<T>;

/// Reads a variant by the reader that stands beside its name; one without content has `()` read.
fn variant<T>(decoder: &mut SceneReader<'_>, node: &Node, what: &str, readers: &[(&str, Reader<T>)]) -> Option<T> {
    let names: Vec<&str> = readers.iter().map(|(name, _)| *name).collect();
    let (name, content) = decoder.variant(node, what, &names)?;
    let (_, read) = readers.iter().find(|(known, _)| *known == name)?;
    let empty = Node { span: node.span, value: Value::Unit };
    read(decoder, content.unwrap_or(&empty))
}

/// The one path that a variant holds, as written, and where; `example` shows what it looks like.
fn path(decoder: &mut Decoder, node: &Node, example: &str) -> Option<(String, Span)> {
    match &node.value {
        Value::Tuple(items) if items.len() == 1 => decoder.text(&items[0]).map(|text| (text.to_owned(), items[0].span)),
        _ => {
            decoder.wrong_type(node, &format!("a path: `{example}`"));
            None
        }
    }
}

/// The values of fields that must all be there, in that order.
fn parts_of<'n>(decoder: &mut Decoder, node: &'n Node, what: &str, names: &[&str]) -> Option<Vec<&'n Node>> {
    let fields = decoder.fields(node, what, names)?;
    let parts: Vec<Option<&Node>> = names.iter().map(|name| fields.required(decoder, name)).collect();
    parts.into_iter().collect()
}
