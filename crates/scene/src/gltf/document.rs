//! The JSON of a glTF file, and what the file requires of its reader.
//!
//! `gltf-json` asks for fields that glTF 2.0 lets a file leave out. They are put in before it reads the file, and what
//! was put in is known.

use std::collections::{BTreeMap, BTreeSet};

use gltf::json::{
    Accessor, Animation, Buffer, Camera, Image, Material, Mesh, Node, Root, Scene, Skin, Texture, buffer, texture,
};
use serde_json::{Error, Map, Value, from_value, json};

use super::fault::{Checked, Fault, element};
use crate::codes::{GLTF_EXTENSION, GLTF_SYNTAX, GLTF_VERSION};

/// The extensions that are read.
const SUPPORTED: &[&str] =
    &["KHR_lights_punctual", "KHR_texture_transform", "KHR_mesh_quantization", "EXT_mesh_gpu_instancing"];

/// The JSON of a file.
pub(crate) struct Document {
    pub root: Root,
    pub left_out: LeftOut,
}

/// What a file leaves out and [`Root`] has all the same, and what it has and [`Root`] does not.
#[derive(Debug, Default)]
pub(crate) struct LeftOut {
    /// Animation and channel, of channels without a target node.
    pub targets: BTreeSet<(usize, usize)>,
    /// By texture without a source: the extensions that may give it one.
    pub sources: BTreeMap<usize, Vec<String>>,
    /// Mesh and primitive, of primitives whose vertices an extension compresses: accessors of theirs may have no bytes.
    pub vertices: BTreeSet<(usize, usize)>,
    /// By node, the attributes of EXT_mesh_gpu_instancing.
    pub instancing: BTreeMap<usize, Value>,
}

impl Document {
    /// Reads the JSON and checks version and required extensions.
    pub fn read(json: &[u8]) -> Checked<Document> {
        let syntax = |what: String| Fault::new(GLTF_SYNTAX, what);
        // RFC 8259, 8.1: a reader may ignore it.
        let json = json.strip_prefix(b"\xef\xbb\xbf").unwrap_or(json);
        if json.is_empty() {
            return Err(syntax("the file is empty".to_owned()));
        }
        if json.starts_with(b"\xff\xfe") || json.starts_with(b"\xfe\xff") {
            return Err(syntax("the file is UTF-16; glTF is UTF-8".to_owned()));
        }
        let unreadable = |error: Error| syntax(format!("not readable as glTF: {error}"));
        let mut value: Value = serde_json::from_slice(json).map_err(unreadable)?;
        let left_out = complete(&mut value);
        let root: Root = from_value(value).map_err(|error| unreadable_element(json).unwrap_or(unreadable(error)))?;
        let needed = root.asset.min_version.as_deref().unwrap_or(&root.asset.version);
        if needed != "2.0" {
            return Err(Fault::new(GLTF_VERSION, format!("asset: version {needed:?}; only \"2.0\" is read")));
        }
        match root.extensions_required.iter().find(|name| !SUPPORTED.contains(&name.as_str())) {
            Some(name) => Err(Fault::new(GLTF_EXTENSION, format!("extensionsRequired: {name:?} is not supported"))),
            None => Ok(Document { root, left_out }),
        }
    }

    /// The extensions that the file uses and that are not read, each once.
    pub fn unread_extensions(&self) -> BTreeSet<String> {
        let used = self.root.extensions_used.iter();
        used.filter(|name| !SUPPORTED.contains(&name.as_str())).cloned().collect()
    }
}

/// Puts in what a file may leave out and `gltf-json` asks for.
fn complete(json: &mut Value) -> LeftOut {
    let mut left_out = LeftOut::default();
    for (_, scene) in objects(json, "scenes") {
        scene.entry("nodes").or_insert_with(|| json!([]));
    }
    for (animation, object) in objects(json, "animations") {
        let channels = object.get_mut("channels").and_then(Value::as_array_mut).into_iter().flatten();
        for (channel, object) in channels.enumerate() {
            let Some(target) = object.get_mut("target").and_then(Value::as_object_mut) else { continue };
            if !target.contains_key("node") {
                target.insert("node".to_owned(), json!(0));
                left_out.targets.insert((animation, channel));
            }
        }
    }
    for (index, texture) in objects(json, "textures") {
        if !texture.contains_key("source") {
            texture.insert("source".to_owned(), json!(0));
            let extensions = texture.get("extensions").and_then(Value::as_object);
            left_out.sources.insert(index, extensions.into_iter().flat_map(Map::keys).cloned().collect());
        }
    }
    for (node, object) in objects(json, "nodes") {
        let extension = object.get("extensions").and_then(|extensions| extensions.get("EXT_mesh_gpu_instancing"));
        let attributes = extension.map(|extension| extension.get("attributes").cloned().unwrap_or_default());
        left_out.instancing.extend(attributes.map(|attributes| (node, attributes)));
    }
    for (mesh, object) in objects(json, "meshes") {
        for (primitive, object) in object.get("primitives").and_then(Value::as_array).into_iter().flatten().enumerate()
        {
            if object.pointer("/extensions/KHR_draco_mesh_compression").is_some() {
                left_out.vertices.insert((mesh, primitive));
            }
        }
    }
    left_out
}

/// The objects of a list of the file, each with its index.
fn objects<'a>(json: &'a mut Value, list: &str) -> impl Iterator<Item = (usize, &'a mut Map<String, Value>)> {
    let items = json.get_mut(list).and_then(Value::as_array_mut).into_iter().flatten();
    items.enumerate().filter_map(|(index, item)| Some((index, item.as_object_mut()?)))
}

/// Reads an element alone, to see what is wrong with it.
type Trial = fn(Value) -> Option<Error>;

/// The lists of a file, each with what its elements are called.
const LISTS: [(&str, &str, Trial); 13] = [
    ("accessors", "accessor", |value| from_value::<Accessor>(value).err()),
    ("animations", "animation", |value| from_value::<Animation>(value).err()),
    ("buffers", "buffer", |value| from_value::<Buffer>(value).err()),
    ("bufferViews", "bufferView", |value| from_value::<buffer::View>(value).err()),
    ("cameras", "camera", |value| from_value::<Camera>(value).err()),
    ("images", "image", |value| from_value::<Image>(value).err()),
    ("materials", "material", |value| from_value::<Material>(value).err()),
    ("meshes", "mesh", |value| from_value::<Mesh>(value).err()),
    ("nodes", "node", |value| from_value::<Node>(value).err()),
    ("samplers", "sampler", |value| from_value::<texture::Sampler>(value).err()),
    ("scenes", "scene", |value| from_value::<Scene>(value).err()),
    ("skins", "skin", |value| from_value::<Skin>(value).err()),
    ("textures", "texture", |value| from_value::<Texture>(value).err()),
];

/// The first element of a file that cannot be read: the file as a whole is read without places.
fn unreadable_element(json: &[u8]) -> Option<Fault> {
    let mut value: Value = serde_json::from_slice(json).ok()?;
    complete(&mut value);
    LISTS.iter().find_map(|(list, kind, trial)| {
        let items = value.get(list)?.as_array()?;
        items.iter().enumerate().find_map(|(index, item)| {
            let error = trial(item.clone())?;
            let name = item.get("name").and_then(Value::as_str);
            let message = format!("not readable as glTF: {error}");
            Some(Fault { element: element(kind, index, name), ..Fault::new(GLTF_SYNTAX, message) })
        })
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn fault(json: &str) -> String {
        match Document::read(json.as_bytes()) {
            Ok(_) => String::new(),
            Err(Fault { element, message, .. }) => format!("{element}: {message}"),
        }
    }

    #[test]
    fn what_may_be_left_out_is_put_in() {
        let text = r#"{"asset":{"version":"2.0"},"scenes":[{"name":"empty"},{"nodes":[0]}],"nodes":[{}],
            "textures":[{"source":0},{"extensions":{"KHR_texture_basisu":{"source":1}}},{}],
            "animations":[{"samplers":[],"channels":[{"sampler":0,"target":{"path":"scale"}},{"sampler":0,"target":{"node":0,"path":"scale"}}]}]}"#;
        for mark in ["", "\u{feff}"] {
            let Ok(Document { root, left_out }) = Document::read(format!("{mark}{text}").as_bytes()) else {
                panic!("{}", fault(text));
            };
            assert_eq!((root.scenes[0].nodes.len(), root.scenes[1].nodes.len()), (0, 1));
            assert_eq!(left_out.targets, BTreeSet::from([(0, 0)]));
            let sources = [(1, vec!["KHR_texture_basisu".to_owned()]), (2, vec![])];
            assert_eq!(left_out.sources, BTreeMap::from(sources));
        }
    }

    #[test]
    fn a_mistake_is_told_of_its_element_and_not_of_one_that_is_right() {
        let with = |lists: &str| fault(&format!(r#"{{"asset":{{"version":"2.0"}},"scenes":[{{}}],{lists}}}"#));
        assert!(with(r#""nodes":[]"#).is_empty());
        let text = with(r#""accessors":[{"componentType":5126,"count":1,"type":"VEC3"},{"name":"b","count":3}]"#);
        assert!(text.starts_with("accessor 1 \"b\": not readable as glTF: missing field"), "{text}");
        let text = with(r#""animations":[{"samplers":[],"channels":[{"sampler":0,"target":{}}]}]"#);
        assert!(text.starts_with("animation 0: ") && text.contains("missing field `path`"), "{text}");
        let text = with(r#""nodes":3"#);
        assert!(text.contains("not readable as glTF: invalid type"), "{text}");
        assert!(fault("{\"asset\":").contains("line 1 column"));
        assert!(fault("\u{feff}").contains("empty"));
    }
}
