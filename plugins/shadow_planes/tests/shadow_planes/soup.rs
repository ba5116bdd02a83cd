//! Scenes of triangles without order, as glTF files.

use std::path::Path;
use std::sync::{Arc, OnceLock};

use glam::DVec3;
use tyndall_document::{Source, render_text};
use tyndall_plugin::Registry;
use tyndall_scene::{Extensions, Overrides, Scene};
use tyndall_shader::Library;
use tyndall_shaders::scene::Caster;

/// Numbers that look random, the same in every run.
pub struct Random(pub u64);

impl Random {
    /// 0..1; Marsaglia 2003, xorshift64.
    pub fn unit(&mut self) -> f64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        (self.0 >> 11) as f64 / (1_u64 << 53) as f64
    }

    /// In the cube from -1 to 1.
    pub fn cube(&mut self) -> DVec3 {
        2.0 * DVec3::new(self.unit(), self.unit(), self.unit()) - 1.0
    }
}

/// A scene with a mesh, seen from `eye`, lit by a lamp, a spot and a sun.
pub struct Setting {
    pub positions: Vec<DVec3>,
    pub triangles: Vec<[u32; 3]>,
    pub eye: DVec3,
    pub lamp: DVec3,
    pub sun: DVec3,
}

impl Setting {
    pub fn corners(&self) -> Vec<Caster> {
        self.triangles.iter().map(|triangle| triangle.map(|index| self.positions[index as usize])).collect()
    }

    /// Through files, as the program reads it.
    pub fn scene(&self) -> Scene {
        let folder = tempfile::tempdir().unwrap();
        std::fs::write(folder.path().join("mesh.bin"), self.bytes()).unwrap();
        std::fs::write(folder.path().join("mesh.gltf"), self.gltf()).unwrap();
        let [eye, lamp, sun] = [self.eye, self.lamp, self.sun].map(|v| format!("({:?}, {:?}, {:?})", v.x, v.y, v.z));
        let text = format!(
            "(
                camera: (position: {eye}, look_at: (0.1, 0.2, 50.3)),
                medium: (extinction: (0.1, 0.1, 0.1)),
                lights: [
                    Point(position: {lamp}, intensity: (1.0, 1.0, 1.0)),
                    Directional(direction: {sun}, irradiance: (1.0, 1.0, 1.0)),
                ],
                objects: [(mesh: File(\"mesh.gltf\"))],
            )"
        );
        scene_of(&text, folder.path())
    }

    fn bytes(&self) -> Vec<u8> {
        let positions = self.positions.iter().flat_map(|p| p.as_vec3().to_array()).flat_map(f32::to_le_bytes);
        positions.chain(self.triangles.iter().flatten().flat_map(|index| index.to_le_bytes())).collect()
    }

    fn gltf(&self) -> String {
        let (vertices, indices) = (self.positions.len(), 3 * self.triangles.len());
        let (low, high) = self
            .positions
            .iter()
            .fold((DVec3::INFINITY, DVec3::NEG_INFINITY), |(low, high), p| (low.min(*p), high.max(*p)));
        let [low, high] = [low, high].map(|v| v.as_vec3().to_array().map(|x| x.to_string()).join(", "));
        format!(
            r#"{{
                "asset": {{ "version": "2.0" }},
                "scene": 0, "scenes": [{{ "nodes": [0] }}], "nodes": [{{ "mesh": 0 }}],
                "meshes": [{{ "primitives": [{{ "attributes": {{ "POSITION": 0 }}, "indices": 1 }}] }}],
                "accessors": [
                    {{ "bufferView": 0, "componentType": 5126, "count": {vertices}, "type": "VEC3", "min": [{low}], "max": [{high}] }},
                    {{ "bufferView": 1, "componentType": 5125, "count": {indices}, "type": "SCALAR" }}
                ],
                "bufferViews": [
                    {{ "buffer": 0, "byteOffset": 0, "byteLength": {} }},
                    {{ "buffer": 0, "byteOffset": {}, "byteLength": {} }}
                ],
                "buffers": [{{ "uri": "mesh.bin", "byteLength": {} }}]
            }}"#,
            12 * vertices,
            12 * vertices,
            4 * indices,
            12 * vertices + 4 * indices,
        )
    }
}

/// What the plugin adds to scenes.
fn extensions() -> &'static Arc<Extensions> {
    static EXTENSIONS: OnceLock<Arc<Extensions>> = OnceLock::new();
    EXTENSIONS.get_or_init(|| {
        let registry = Registry::new(vec![tyndall_shadow_planes::plugin()], Vec::new(), &Library::default());
        registry.extensions().clone()
    })
}

pub fn scene_of(text: &str, folder: &Path) -> Scene {
    match Scene::from_source(&Source::new("test.scene.ron", text), folder, &Overrides::new(), extensions()) {
        Ok((scene, _)) => scene,
        Err(mistakes) => panic!("{}", render_text(&mistakes, false)),
    }
}
