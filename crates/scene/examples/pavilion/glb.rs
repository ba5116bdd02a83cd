//! As much of a glTF writer as the examples and the tests need.

use glam::{Quat, Vec2, Vec3};
use serde_json::{Map, Value, json};

/// Triangles with normals and, if any, texture coordinates.
#[derive(Clone, Debug, Default)]
pub struct Shape {
    pub positions: Vec<Vec3>,
    pub normals: Vec<Vec3>,
    pub uvs: Vec<Vec2>,
    pub indices: Vec<u32>,
}

/// Collects the elements of a file; each method gives the index of what it added.
#[derive(Default)]
pub struct Glb {
    bytes: Vec<u8>,
    lists: Map<String, Value>,
    lights: Vec<Value>,
}

impl Glb {
    /// Adds an element to a list of the file.
    pub fn add(&mut self, list: &str, element: Value) -> usize {
        let entry = self.lists.entry(list.to_owned()).or_insert_with(|| json!([]));
        let items = entry.as_array_mut().expect("every entry is a list");
        items.push(element);
        items.len() - 1
    }

    /// Adds bytes, aligned to four.
    pub fn view(&mut self, bytes: &[u8]) -> usize {
        let offset = self.bytes.len();
        self.bytes.extend_from_slice(bytes);
        self.bytes.resize(self.bytes.len().next_multiple_of(4), 0);
        self.add("bufferViews", json!({ "buffer": 0, "byteOffset": offset, "byteLength": bytes.len() }))
    }

    fn vectors(&mut self, kind: &str, values: &[&[f32]]) -> usize {
        let bytes: Vec<u8> = values.iter().flat_map(|v| v.iter().flat_map(|x| x.to_le_bytes())).collect();
        let view = self.view(&bytes);
        let bound = |pick: fn(f32, f32) -> f32| -> Vec<f32> {
            let width = values[0].len();
            (0..width).map(|i| values.iter().map(|v| v[i]).fold(values[0][i], pick)).collect()
        };
        let (min, max) = (bound(f32::min), bound(f32::max));
        let accessor = json!({ "bufferView": view, "componentType": 5126, "count": values.len(), "type": kind, "min": min, "max": max });
        self.add("accessors", accessor)
    }

    /// Vectors of three.
    pub fn triples(&mut self, values: &[Vec3]) -> usize {
        let values: Vec<&[f32]> = values.iter().map(|v| AsRef::<[f32; 3]>::as_ref(v).as_slice()).collect();
        self.vectors("VEC3", &values)
    }

    /// A mesh of one primitive per shape and material.
    pub fn mesh(&mut self, name: &str, parts: &[(&Shape, usize)]) -> usize {
        let mut primitives = Vec::new();
        for (shape, material) in parts {
            let positions = self.triples(&shape.positions);
            let normals = self.triples(&shape.normals);
            let mut attributes = json!({ "POSITION": positions, "NORMAL": normals });
            if !shape.uvs.is_empty() {
                let uvs: Vec<&[f32]> = shape.uvs.iter().map(|v| AsRef::<[f32; 2]>::as_ref(v).as_slice()).collect();
                attributes["TEXCOORD_0"] = json!(self.vectors("VEC2", &uvs));
            }
            let bytes: Vec<u8> = shape.indices.iter().flat_map(|&i| (i as u16).to_le_bytes()).collect();
            let view = self.view(&bytes);
            let count = shape.indices.len();
            let indices = self.add(
                "accessors",
                json!({ "bufferView": view, "componentType": 5123, "count": count, "type": "SCALAR" }),
            );
            primitives.push(json!({ "attributes": attributes, "indices": indices, "material": material }));
        }
        self.add("meshes", json!({ "name": name, "primitives": primitives }))
    }

    /// A material without metal; the texture multiplies the colour.
    pub fn material(&mut self, name: &str, color: [f32; 3], texture: Option<usize>) -> usize {
        let [r, g, b] = color;
        let mut pbr = json!({ "baseColorFactor": [r, g, b, 1.0], "metallicFactor": 0.0, "roughnessFactor": 1.0 });
        if let Some(texture) = texture {
            pbr["baseColorTexture"] = json!({ "index": texture });
        }
        self.add("materials", json!({ "name": name, "pbrMetallicRoughness": pbr }))
    }

    /// A texture that repeats, from an encoded picture.
    pub fn texture(&mut self, name: &str, png: &[u8]) -> usize {
        let view = self.view(png);
        let image = self.add("images", json!({ "name": name, "bufferView": view, "mimeType": "image/png" }));
        self.add("textures", json!({ "source": image }))
    }

    /// A node under the root, or, if given, with these children.
    pub fn node(&mut self, name: &str, place: Vec3, turn: Quat, what: &Value, children: &[usize]) -> usize {
        let mut node = json!({ "name": name, "translation": place.to_array(), "rotation": turn.to_array() });
        if let (Some(node), Some(what)) = (node.as_object_mut(), what.as_object()) {
            node.extend(what.iter().map(|(k, v)| (k.clone(), v.clone())));
            if !children.is_empty() {
                node.insert("children".to_owned(), json!(children));
            }
        }
        self.add("nodes", node)
    }

    /// A light, as what a node holds.
    pub fn light(&mut self, light: Value) -> Value {
        self.lights.push(light);
        json!({ "extensions": { "KHR_lights_punctual": { "light": self.lights.len() - 1 } } })
    }

    /// The file, its scene made of these nodes.
    pub fn finish(mut self, roots: &[usize]) -> Vec<u8> {
        let mut root = std::mem::take(&mut self.lists);
        root.insert("asset".to_owned(), json!({ "version": "2.0", "generator": "tyndall" }));
        root.insert("scene".to_owned(), json!(0));
        root.insert("scenes".to_owned(), json!([{ "nodes": roots }]));
        root.insert("buffers".to_owned(), json!([{ "byteLength": self.bytes.len() }]));
        if !self.lights.is_empty() {
            root.insert("extensionsUsed".to_owned(), json!(["KHR_lights_punctual"]));
            root.insert("extensions".to_owned(), json!({ "KHR_lights_punctual": { "lights": self.lights } }));
        }
        let mut json = Value::Object(root).to_string().into_bytes();
        json.resize(json.len().next_multiple_of(4), b' ');
        let length = 12 + 8 + json.len() + 8 + self.bytes.len();
        let mut file = b"glTF".to_vec();
        let word = |file: &mut Vec<u8>, number: usize| file.extend_from_slice(&(number as u32).to_le_bytes());
        word(&mut file, 2);
        word(&mut file, length);
        word(&mut file, json.len());
        file.extend_from_slice(b"JSON");
        file.extend_from_slice(&json);
        word(&mut file, self.bytes.len());
        file.extend_from_slice(b"BIN\0");
        file.extend_from_slice(&self.bytes);
        file
    }
}
