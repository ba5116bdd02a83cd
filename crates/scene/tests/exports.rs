//! glTF files as exporters write them: what may be left out, what is left out of the picture, and how that is messages.

use std::sync::Arc;

use serde_json::{Value, json};
use tyndall_document::{Diagnostics, Source, render_text};
use tyndall_scene::{Overrides, Scene};

/// A triangle in the plane z = 0 with the positions (-1 -1 0), (1 -1 0), (0 1 0).
fn triangle() -> Value {
    json!({
        "asset": { "version": "2.0" },
        "buffers": [{ "byteLength": 36, "uri": "data:;base64,AACAvwAAgL8AAAAAAACAPwAAgL8AAAAAAAAAAAAAgD8AAAAA" }],
        "bufferViews": [{ "buffer": 0, "byteLength": 36 }],
        "accessors": [{ "bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3" }],
        "meshes": [{ "primitives": [{ "attributes": { "POSITION": 0 } }] }],
        "nodes": [{ "mesh": 0 }],
        "scenes": [{ "nodes": [0] }],
        "scene": 0,
    })
}

fn load_bytes(bytes: &[u8], name: &str) -> Result<(Scene, Diagnostics), Diagnostics> {
    let folder = tempfile::tempdir().expect("a folder");
    std::fs::write(folder.path().join(name), bytes).expect("a file");
    let scene = format!("(camera: (position: (0, 0, 9), look_at: (0, 0, 0)), objects: [(mesh: File(\"{name}\"))])");
    Scene::from_source(&Source::new("test.scene.ron", scene), folder.path(), &Overrides::new(), &Arc::default())
}

/// The scene, and the text of each warning.
fn load(json: &Value) -> (Scene, Vec<String>) {
    let loaded = load_bytes(json.to_string().as_bytes(), "model.gltf");
    let (scene, warnings) = loaded.unwrap_or_else(|mistakes| panic!("{}", render_text(&mistakes, false)));
    (scene, warnings.iter().map(|warning| format!("{}: {}", warning.code, warning.message)).collect())
}

fn refused(json: &Value) -> String {
    match load_bytes(json.to_string().as_bytes(), "model.gltf") {
        Ok(_) => panic!("it is accepted: {json}"),
        Err(mistakes) => render_text(&mistakes, false),
    }
}

fn triangles(scene: &Scene) -> usize {
    scene.instances.iter().map(|instance| instance.mesh.triangles.len()).sum()
}

/// A picture of one texel.
fn pixel() -> String {
    let mut bytes = std::io::Cursor::new(Vec::new());
    image::RgbaImage::new(1, 1).write_to(&mut bytes, image::ImageFormat::Png).expect("a picture");
    let hex: String = bytes.into_inner().iter().map(|byte| format!("%{byte:02x}")).collect();
    format!("data:image/png,{hex}")
}

#[test]
fn a_scene_may_be_empty() {
    let mut file = triangle();
    file["scenes"] = json!([{ "nodes": [0] }, { "name": "Scene.001" }]);
    let (scene, warnings) = load(&file);
    assert_eq!((triangles(&scene), warnings.len()), (1, 0));
    file["scene"] = json!(1);
    assert_eq!(triangles(&load(&file).0), 0);
    // Without one that is drawn by default, the first is.
    file["scenes"] = json!([{}]);
    file.as_object_mut().expect("an object").remove("scene");
    assert_eq!(triangles(&load(&file).0), 0);
}

#[test]
fn a_channel_without_a_target_is_ignored() {
    let mut file = triangle();
    let target = |target: Value| json!([{ "samplers": [{ "input": 2, "output": 1 }], "channels": [{ "sampler": 0, "target": target }] }]);
    for (channel, what) in [
        (json!({ "path": "scale" }), "no target node"),
        (
            json!({ "path": "pointer", "extensions": { "KHR_animation_pointer": { "pointer": "/nodes/0/scale" } } }),
            "no target node",
        ),
        (json!({ "node": 0, "path": "pointer" }), "a path other than translation, rotation and scale"),
        (json!({ "node": 0, "path": "weights" }), "weights of morph targets"),
    ] {
        file["animations"] = target(channel.clone());
        let (scene, warnings) = load(&file);
        assert_eq!(triangles(&scene), 1);
        assert!(scene.animated().is_empty(), "{channel}");
        assert_eq!(warnings, [format!("gltf-ignored: not read: channel 0 of animation 0: {what}")]);
    }
    // A channel that drives a node is read as before.
    file["animations"] = target(json!({ "node": 0, "path": "scale" }));
    assert!(refused(&file).contains("accessor 2 does not exist"));
}

#[test]
fn an_accessor_without_bytes_is_zero() {
    let mut file = triangle();
    file["accessors"] = json!([file["accessors"][0], { "componentType": 5126, "count": 3, "type": "VEC3" }]);
    file["meshes"][0]["primitives"][0]["attributes"]["NORMAL"] = json!(1);
    let (scene, warnings) = load(&file);
    // A normal of no length is that of the triangle.
    assert!(scene.instances[0].mesh.normals.iter().all(|normal| normal.to_array() == [0.0, 0.0, 1.0]));
    assert!(warnings.is_empty());
    // Texture coordinates, and what an animation gives.
    file["accessors"] = json!([
        file["accessors"][0],
        { "componentType": 5126, "count": 3, "type": "VEC2" },
        { "componentType": 5126, "count": 1, "type": "SCALAR" },
        { "componentType": 5126, "count": 1, "type": "VEC3" },
    ]);
    file["meshes"][0]["primitives"][0] = json!({ "attributes": { "POSITION": 0, "TEXCOORD_0": 1 }, "material": 0 });
    file["materials"] = json!([{ "pbrMetallicRoughness": { "baseColorTexture": { "index": 0 } } }]);
    file["textures"] = json!([{ "source": 0 }]);
    file["images"] = json!([{ "uri": pixel() }]);
    file["nodes"][0]["translation"] = json!([5, 5, 5]);
    file["animations"] = json!([{ "samplers": [{ "input": 2, "output": 3 }],
        "channels": [{ "sampler": 0, "target": { "node": 0, "path": "translation" } }] }]);
    let (scene, _) = load(&file);
    assert!(scene.instances[0].mesh.uvs.iter().all(|uv| uv.to_array() == [0.0, 0.0]));
    assert_eq!(scene.bounds(0.0).expect("a triangle").max.to_array(), [1.0, 1.0, 0.0]);
    // A count is bounded all the same.
    file["accessors"][1]["count"] = json!(1 << 21);
    file["accessors"][0] = file["accessors"][1].clone();
    file["accessors"][0]["type"] = json!("VEC3");
    assert!(refused(&file).contains("elements without a bufferView"));
}

/// Their accessors have no bytes either, and these are not zero.
#[test]
fn compressed_vertices_are_refused() {
    let mut file = triangle();
    file["accessors"][0].as_object_mut().expect("an object").remove("bufferView");
    let extensions = json!({ "KHR_draco_mesh_compression": { "bufferView": 0, "attributes": { "POSITION": 0 } } });
    file["meshes"][0]["primitives"][0]["extensions"] = extensions;
    file["extensionsUsed"] = json!(["KHR_draco_mesh_compression"]);
    let text = refused(&file);
    assert!(text.contains("mesh 0, primitive 0") && text.contains("KHR_draco_mesh_compression"), "{text}");
    // With the vertices beside it, the extension can be left out.
    file["accessors"][0]["bufferView"] = json!(0);
    let (scene, warnings) = load(&file);
    assert_eq!(triangles(&scene), 1);
    assert_eq!(warnings, ["gltf-ignored: not read: extensions: KHR_draco_mesh_compression"]);
}

#[test]
fn a_texture_without_a_picture_names_the_extension_that_may_have_one() {
    let mut file = triangle();
    file["materials"] = json!([{ "pbrMetallicRoughness": { "baseColorTexture": { "index": 0 } } }]);
    file["meshes"][0]["primitives"][0]["material"] = json!(0);
    for (texture, expected) in [
        (
            json!({ "extensions": { "KHR_texture_basisu": { "source": 0 } } }),
            "texture 0: has no source (KHR_texture_basisu is not read)",
        ),
        (
            json!({ "name": "roof", "extensions": { "EXT_texture_webp": {}, "MSFT_texture_dds": {} } }),
            "texture 0 \"roof\": has no source (EXT_texture_webp and MSFT_texture_dds are not read)",
        ),
        (json!({}), "texture 0: has no source"),
        (json!({ "source": 4_294_967_295_u32 }), "texture 0: image 4294967295 does not exist"),
        (json!({ "source": 1 }), "texture 0: image 1 does not exist"),
    ] {
        file["textures"] = json!([texture]);
        let text = refused(&file);
        assert!(text.contains(&format!("material 0, baseColorTexture, {expected}\n")), "{expected}: {text}");
    }
    // Nobody uses it.
    file["meshes"][0]["primitives"][0].as_object_mut().expect("an object").remove("material");
    assert_eq!(triangles(&load(&file).0), 1);
}

#[test]
fn byte_order_marks_and_padding_are_passed_over() {
    let json = triangle().to_string();
    let marked = [b"\xef\xbb\xbf".as_slice(), json.as_bytes()].concat();
    assert!(load_bytes(&marked, "model.gltf").is_ok());
    let utf_16: Vec<u8> = format!("\u{feff}{json}").encode_utf16().flat_map(u16::to_le_bytes).collect();
    let text =
        load_bytes(&utf_16, "model.gltf").map_or_else(|mistakes| render_text(&mistakes, false), |_| String::new());
    assert!(text.contains("the file is UTF-16; glTF is UTF-8"), "{text}");
    let glb = |chunk: &[u8]| {
        let length = |bytes: usize| (bytes as u32).to_le_bytes();
        [b"glTF\x02\0\0\0".as_slice(), &length(20 + chunk.len()), &length(chunk.len()), b"JSON", chunk].concat()
    };
    for padding in ["", " ", "   ", "\0", "\0\0\0"] {
        for mark in ["", "\u{feff}"] {
            let chunk = format!("{mark}{json}{padding}");
            assert!(load_bytes(&glb(chunk.as_bytes()), "model.glb").is_ok(), "{mark:?} {padding:?}");
        }
    }
}

/// One line for a file, however many elements have something that is not read.
#[test]
fn what_is_not_read_is_told_once() {
    let mut file = triangle();
    let matte = json!({ "metallicFactor": 0 });
    let material = json!({ "pbrMetallicRoughness": matte, "emissiveFactor": [0, 0, 1], "alphaMode": "MASK" });
    file["materials"] = json!([
        { "name": "lamp", "pbrMetallicRoughness": matte, "emissiveFactor": [1, 1, 1] }, material, material, material,
        { "pbrMetallicRoughness": matte, "emissiveFactor": [0, 0, 0] }, { "emissiveFactor": [1, 1, 1] },
    ]);
    let primitive =
        |material: u32, mode: u32| json!({ "attributes": { "POSITION": 0 }, "material": material, "mode": mode });
    let triangles = (0..5).map(|material| primitive(material, 4));
    file["meshes"][0]["primitives"] = triangles.chain([primitive(0, 0), primitive(0, 1)]).collect();
    file["nodes"][0]["skin"] = json!(0);
    file["skins"] = json!([{ "joints": [0] }]);
    file["extensionsUsed"] =
        json!(["KHR_materials_unlit", "KHR_materials_variants", "KHR_texture_transform", "KHR_materials_unlit"]);
    assert_eq!(
        load(&file).1,
        [
            "gltf-ignored: not read: 4 materials (0 \"lamp\", 1, 2, …): emission; 3 materials (1, 2, 3): alpha (drawn opaque); \
             node 0: skin; extensions: KHR_materials_unlit, KHR_materials_variants",
            "gltf-mode: not drawn: 2 primitives (5 of mesh 0, 6 of mesh 0): points or lines",
        ]
    );
}
