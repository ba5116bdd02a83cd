//! What glTF files say and what becomes of it, on files made here.

use std::path::Path;
use std::sync::Arc;

use base64::Engine;
use glam::{DVec3, Vec3};
use serde_json::{Value, json};
use tyndall_document::{Diagnostics, Source, render_text};
use tyndall_scene::model::{LightKind, Wrap};
use tyndall_scene::{Overrides, Scene};

/// A file with buffer views and accessors added one by one.
struct File {
    json: Value,
    bytes: Vec<u8>,
}

impl File {
    fn new(json: Value) -> File {
        let mut file = File { json, bytes: Vec::new() };
        file.json["asset"] = json!({ "version": "2.0" });
        for list in ["bufferViews", "accessors"] {
            file.json[list] = json!([]);
        }
        file
    }

    fn view(&mut self, bytes: &[u8]) -> usize {
        let view = json!({ "buffer": 0, "byteOffset": self.bytes.len(), "byteLength": bytes.len() });
        self.bytes.extend_from_slice(bytes);
        self.push("bufferViews", view)
    }

    fn push(&mut self, list: &str, element: Value) -> usize {
        let list = self.json[list].as_array_mut().expect("a list");
        list.push(element);
        list.len() - 1
    }

    fn floats(&mut self, kind: &str, values: &[f32]) -> usize {
        let width = match kind {
            "SCALAR" => 1,
            "VEC2" => 2,
            "VEC3" => 3,
            _ => 4,
        };
        let bytes: Vec<u8> = values.iter().flat_map(|v| v.to_le_bytes()).collect();
        let view = self.view(&bytes);
        let accessor =
            json!({ "bufferView": view, "componentType": 5126, "type": kind, "count": values.len() / width });
        self.push("accessors", accessor)
    }

    fn indices(&mut self, values: &[u8]) -> usize {
        let view = self.view(values);
        let accessor = json!({ "bufferView": view, "componentType": 5121, "type": "SCALAR", "count": values.len() });
        self.push("accessors", accessor)
    }

    fn text(mut self) -> String {
        let data = base64::engine::general_purpose::STANDARD.encode(&self.bytes);
        let uri = format!("data:application/octet-stream;base64,{data}");
        self.json["buffers"] = json!([{ "uri": uri, "byteLength": self.bytes.len() }]);
        self.json.to_string()
    }
}

const CAMERA: &str = "camera: (position: (0, 0, 9), look_at: (0, 0, 0)),";

fn load_with(text: &str, fields: &str, object: &str) -> Result<(Scene, Diagnostics), Diagnostics> {
    let folder = tempfile::tempdir().expect("a folder");
    std::fs::write(folder.path().join("model.gltf"), text).expect("a file");
    let scene = format!("({fields} objects: [(mesh: File(\"model.gltf\"), {object})])");
    Scene::from_source(&Source::new("test.scene.ron", scene), folder.path(), &Overrides::new(), &Arc::default())
}

fn load(file: File) -> Scene {
    load_with(&file.text(), CAMERA, "").unwrap_or_else(|e| panic!("{}", render_text(&e, false))).0
}

/// Five points of a zigzag: the corners of a strip of three triangles.
const ZIGZAG: [f32; 15] = [0., 0., 0., 0., 1., 0., 1., 0., 0., 1., 1., 0., 2., 0., 0.];

fn faces(scene: &Scene) -> Vec<f32> {
    let mesh = &scene.instances[0].mesh;
    let corner = |i: u32| mesh.positions[i as usize];
    mesh.triangles.iter().map(|&[a, b, c]| (corner(b) - corner(a)).cross(corner(c) - corner(a)).z).collect()
}

#[test]
fn strips_and_fans_keep_their_winding() {
    let primitive = |mode: u32, indices: Option<&[u8]>| {
        let mut file = File::new(json!({ "nodes": [{ "mesh": 0 }] }));
        let position = file.floats("VEC3", &ZIGZAG);
        let mut primitive = json!({ "attributes": { "POSITION": position }, "mode": mode });
        if let Some(indices) = indices {
            primitive["indices"] = json!(file.indices(indices));
        }
        file.json["meshes"] = json!([{ "primitives": [primitive] }]);
        faces(&load(file))
    };
    assert_eq!(primitive(5, None), [-1.0, -1.0, -1.0]);
    // Repeated indices join two strips; the triangles between have no area and go.
    assert_eq!(primitive(5, Some(&[0, 2, 1, 1, 1, 2, 4, 3])).len(), 3);
    assert_eq!(primitive(6, Some(&[0, 2, 3, 1])), [1.0, 1.0]);
    assert_eq!(primitive(4, Some(&[0, 2, 1])), [1.0]);
}

#[test]
fn nodes_place_and_mirror() {
    let mut file = File::new(json!({ "nodes": [
        { "children": [1], "translation": [10, 0, 0], "scale": [-1, 1, 1] },
        { "mesh": 0, "matrix": [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 5, 0, 1] },
    ] }));
    let position = file.floats("VEC3", &ZIGZAG);
    let indices = file.indices(&[0, 2, 1]);
    file.json["meshes"] = json!([{ "primitives": [{ "attributes": { "POSITION": position }, "indices": indices }] }]);
    let (scene, _) = load_with(&file.text(), CAMERA, "scale: 2, translation: (0, 0, 1)").expect("it is sound");
    let bounds = scene.bounds(0.0).expect("a triangle");
    assert_eq!((bounds.min, bounds.max), (DVec3::new(18.0, 10.0, 1.0), DVec3::new(20.0, 12.0, 1.0)));
    // Mirrored in x: the triangle still faces +z, and so does its normal.
    let encoded = scene.encode(0.0, 1.0);
    let triangle: [u32; 4] = bytemuck::pod_read_unaligned(&encoded.bytes("triangles")[16..32]);
    let vertex = |i: u32| -> tyndall_scene::layout::Vertex {
        let at = 16 + 32 * i as usize;
        bytemuck::pod_read_unaligned(&encoded.bytes("vertices")[at..at + 32])
    };
    let [a, b, c] = [0, 1, 2].map(|i| Vec3::from_array(vertex(triangle[i]).position));
    assert!((b - a).cross(c - a).z > 0.0);
    assert_eq!(vertex(0).normal, [0.0, 0.0, 1.0]);
}

#[test]
fn animations_play() {
    let mut file = File::new(json!({ "nodes": [{ "mesh": 0, "children": [1] }, { "camera": 0 }] }));
    let position = file.floats("VEC3", &ZIGZAG[..9]);
    let times = file.floats("SCALAR", &[0.0, 1.0]);
    let half = std::f32::consts::FRAC_1_SQRT_2;
    let turns = file.floats("VEC4", &[0., 0., 0., 1., 0., half, 0., half]);
    let ways = file.floats("VEC3", &[0., 0., 0., 0., 0., 4.]);
    file.json["meshes"] = json!([{ "primitives": [{ "attributes": { "POSITION": position } }] }]);
    file.json["cameras"] = json!([{ "type": "perspective", "perspective": { "yfov": 1.0, "znear": 0.1 } }]);
    file.json["animations"] = json!([{
        "channels": [
            { "sampler": 0, "target": { "node": 0, "path": "rotation" } },
            { "sampler": 1, "target": { "node": 0, "path": "translation" } },
        ],
        "samplers": [{ "input": times, "output": turns }, { "input": times, "output": ways, "interpolation": "STEP" }],
    }]);
    let (scene, _) = load_with(&file.text(), "", "").expect("it is sound");
    assert_eq!(scene.animated()[..2], ["camera", "vertices"]);
    let close = |a: DVec3, b: DVec3| assert!((a - b).length() < 1e-6, "{a} {b}");
    close(scene.at(0.0).camera.forward, DVec3::NEG_Z);
    close(scene.at(0.5).camera.forward, DVec3::new(-1.0, 0.0, -1.0).normalize());
    close(scene.at(0.5).camera.position, DVec3::ZERO);
    close(scene.at(3.0).camera.position, DVec3::new(0.0, 0.0, 4.0));
    close(scene.at(3.0).camera.forward, DVec3::NEG_X);
    assert!((scene.at(0.0).camera.vertical_fov - 1.0).abs() < 1e-6);
    let mut encoded = scene.encode(0.0, 1.0);
    encoded.update(&scene, 2.0, 1.0);
    assert_eq!(encoded.items, scene.encode(2.0, 1.0).items);
}

#[test]
fn lights_count_only_where_the_scene_gives_none() {
    let mut file = File::new(json!({ "nodes": [
        { "extensions": { "KHR_lights_punctual": { "light": 0 } }, "translation": [1, 2, 3] },
        { "extensions": { "KHR_lights_punctual": { "light": 1 } }, "rotation": [-1, 0, 0, 1] },
        { "extensions": { "KHR_lights_punctual": { "light": 2 } } },
    ] }));
    file.json["extensions"] = json!({ "KHR_lights_punctual": { "lights": [
        { "type": "point", "intensity": 20, "color": [1, 0.5, 0.25], "range": 3 },
        { "type": "spot", "intensity": 2, "spot": { "innerConeAngle": 0.1, "outerConeAngle": 0.5 } },
        { "type": "directional", "intensity": 3 },
    ] } });
    let text = file.text();
    let (scene, _) = load_with(&text, CAMERA, "").expect("it is sound");
    let lights = scene.at(0.0).lights;
    assert_eq!((lights[0].position, lights[0].intensity), (DVec3::new(1.0, 2.0, 3.0), DVec3::new(20.0, 10.0, 5.0)));
    assert_eq!(lights[1].kind, LightKind::Spot { exponent: 0.0, cutoff: 0.5 });
    assert!((lights[1].direction - DVec3::NEG_Y).length() < 1e-6);
    assert_eq!((lights[2].direction, lights[2].kind), (DVec3::NEG_Z, LightKind::Directional));
    let (none, _) = load_with(&text, &format!("{CAMERA} lights: [],"), "").expect("it is sound");
    assert!(none.lights.is_empty());
}

fn png(side: u32) -> String {
    let picture = image::RgbaImage::from_fn(side, side, |x, y| image::Rgba([x as u8 * 10, y as u8 * 10, 7, 255]));
    let mut bytes = std::io::Cursor::new(Vec::new());
    picture.write_to(&mut bytes, image::ImageFormat::Png).expect("a picture");
    let data = base64::engine::general_purpose::STANDARD.encode(bytes.into_inner());
    format!("data:image/png;base64,{data}")
}

#[test]
fn textures_materials_and_their_transforms() {
    let mut file = File::new(json!({ "nodes": [{ "mesh": 0 }] }));
    let position = file.floats("VEC3", &ZIGZAG[..9]);
    let normal = file.floats("VEC3", &[0., 0., 2., 0., 0., 0., 0., 0., 1.]);
    let uv = file.floats("VEC2", &[0., 0., 0., 1., 1., 0.]);
    let attributes = json!({ "POSITION": position, "NORMAL": normal, "TEXCOORD_1": uv });
    file.json["meshes"] = json!([{ "primitives": [{ "attributes": attributes, "material": 0 }] }]);
    file.json["images"] = json!([{ "uri": png(4) }]);
    file.json["samplers"] = json!([{ "wrapS": 33071, "wrapT": 33648 }]);
    file.json["textures"] = json!([{ "source": 0, "sampler": 0 }]);
    let transform = json!({ "KHR_texture_transform": { "offset": [0.5, 0], "scale": [2, 3], "texCoord": 1 } });
    file.json["materials"] = json!([{ "pbrMetallicRoughness": {
        "baseColorFactor": [0.5, 1, 1, 1], "metallicFactor": 0.25, "baseColorTexture": { "index": 0, "extensions": transform },
    } }]);
    let text = file.text();
    let (scene, _) = load_with(&text, CAMERA, "").expect("it is sound");
    let material = &scene.materials[scene.instances[0].material];
    assert_eq!(material.diffuse, DVec3::new(0.5, 1.0, 1.0));
    assert_eq!(material.metallic_roughness.map(|metal| metal.metallic), Some(0.25));
    let texture = &scene.textures[material.texture.expect("a texture")];
    assert_eq!((texture.width, texture.height, texture.wrap), (4, 4, [Wrap::Clamp, Wrap::Mirror]));
    assert_eq!(texture.texels[1].to_le_bytes(), [10, 0, 7, 255]);
    let mesh = &scene.instances[0].mesh;
    assert_eq!(mesh.uvs.iter().map(|uv| uv.to_array()).collect::<Vec<_>>(), [[0.5, 0.0], [0.5, 3.0], [2.5, 0.0]]);
    // Unit length; the one without length is that of its triangle.
    assert_eq!(mesh.normals, [Vec3::Z, Vec3::NEG_Z, Vec3::Z]);
    let encoded = scene.encode(0.0, 1.0);
    let wrap = u32::from_le_bytes(encoded.bytes("textures")[28..32].try_into().expect("four bytes"));
    assert_eq!(wrap, 1 | 2 << 2);
    // An object's own material replaces that of the file, texture included.
    let (own, _) = load_with(&text, CAMERA, "material: (diffuse: (1, 0, 0))").expect("it is sound");
    assert_eq!((own.materials.len(), own.materials[0].texture), (1, None));
}

/// Metallic and roughness are factors times the blue and green of a texture. One that is the same everywhere is a factor;
/// of a roughness that is not the mean counts.
#[test]
fn metallic_and_roughness_come_from_factors_and_a_texture() {
    let material = |factors: Value, texels: [[u8; 4]; 2]| {
        let mut file = File::new(json!({ "nodes": [{ "mesh": 0 }] }));
        let position = file.floats("VEC3", &ZIGZAG[..9]);
        let uv = file.floats("VEC2", &[0.; 6]);
        let attributes = json!({ "POSITION": position, "TEXCOORD_0": uv });
        file.json["meshes"] = json!([{ "primitives": [{ "attributes": attributes, "material": 0 }] }]);
        let mut picture = image::RgbaImage::new(2, 1);
        picture.pixels_mut().zip(texels).for_each(|(pixel, texel)| *pixel = image::Rgba(texel));
        let mut bytes = std::io::Cursor::new(Vec::new());
        picture.write_to(&mut bytes, image::ImageFormat::Png).expect("a picture");
        let view = file.view(&bytes.into_inner());
        file.json["images"] = json!([{ "bufferView": view, "mimeType": "image/png" }]);
        file.json["textures"] = json!([{ "source": 0 }]);
        file.json["materials"] = json!([{ "pbrMetallicRoughness": factors }]);
        file.json["materials"][0]["pbrMetallicRoughness"]["metallicRoughnessTexture"] = json!({ "index": 0 });
        let (scene, warnings) = load_with(&file.text(), CAMERA, "").expect("it is sound");
        let material = scene.materials[scene.instances[0].material].clone();
        let texels = material.texture.map(|index| scene.textures[index].texels.clone());
        (material.metallic_roughness.expect("of glTF"), texels, render_text(&warnings, false))
    };
    let (same, texels, messages) = material(json!({ "metallicFactor": 0.5 }), [[9, 51, 102, 9]; 2]);
    assert_eq!((same.metallic, texels, messages.as_str()), (0.5 * 0.4, None, ""));
    // α is 0.2².
    assert!((same.lobe.shininess - 312.0).abs() < 1e-9 && (same.lobe.peak - 49.7359).abs() < 1e-4, "{same:?}");
    let (varied, texels, messages) = material(json!({ "roughnessFactor": 0.5 }), [[9, 0, 255, 9], [9, 255, 0, 9]]);
    let texels: Vec<_> = texels.expect("a texture").into_iter().map(u32::to_le_bytes).collect();
    assert_eq!((varied.metallic, texels), (1.0, vec![[255; 4], [255, 255, 255, 0]]));
    assert!((varied.lobe.shininess - 127.5).abs() < 1e-9, "α is 0.25²: {varied:?}");
    assert!(messages.contains("material 0: roughness from texel to texel (its mean is used)"), "{messages}");
    // A mirror is a very sharp lobe.
    let (mirror, ..) = material(json!({ "roughnessFactor": 0 }), [[9, 0, 0, 9]; 2]);
    assert_eq!((mirror.metallic, mirror.lobe.shininess), (0.0, tyndall_scene::microfacets::SHARPEST));
}

#[test]
fn quantised_and_sparse_accessors() {
    let mut file = File::new(json!({ "nodes": [{ "mesh": 0 }], "extensionsRequired": ["KHR_mesh_quantization"] }));
    // Signed bytes with a stride of four.
    let view = file.view(&[0, 0, 0, 9, 127, 0, 0, 9, 0, 129, 0, 9]);
    file.json["bufferViews"][view]["byteStride"] = json!(4);
    let [indices, values] = [file.view(&[2]), file.view(&[0, 127, 0])];
    let sparse = json!({ "count": 1, "indices": { "bufferView": indices, "componentType": 5121 }, "values": { "bufferView": values } });
    let accessor = json!({ "bufferView": view, "componentType": 5120, "normalized": true, "type": "VEC3", "count": 3, "sparse": sparse });
    let position = file.push("accessors", accessor);
    file.json["meshes"] = json!([{ "primitives": [{ "attributes": { "POSITION": position } }] }]);
    assert_eq!(load(file).instances[0].mesh.positions, [Vec3::ZERO, Vec3::X, Vec3::Y]);
}

#[test]
fn files_beside_are_read_and_links_out_are_not() {
    let folder = tempfile::tempdir().expect("a folder");
    let outside = tempfile::tempdir().expect("a folder");
    let mut file = File::new(json!({ "nodes": [{ "mesh": 0 }] }));
    let position = file.floats("VEC3", &ZIGZAG[..9]);
    file.json["meshes"] = json!([{ "primitives": [{ "attributes": { "POSITION": position } }] }]);
    file.json["buffers"] = json!([{ "uri": "with%20space.bin", "byteLength": file.bytes.len() }]);
    std::fs::write(folder.path().join("model.gltf"), file.json.to_string()).expect("a file");
    let source = Source::new("s.scene.ron", format!("({CAMERA} objects: [(mesh: File(\"model.gltf\"))])"));
    let load = || Scene::from_source(&source, folder.path(), &Overrides::new(), &Arc::default());
    std::fs::write(outside.path().join("b.bin"), &file.bytes).expect("a file");
    #[cfg(unix)]
    {
        let link = folder.path().join("with space.bin");
        std::os::unix::fs::symlink(outside.path().join("b.bin"), &link).expect("a link");
        let codes: Vec<_> = load().expect_err("it leads out").iter().map(|d| d.code.0).collect();
        assert_eq!(codes, ["gltf-outside-folder"]);
        std::fs::remove_file(link).expect("the link");
    }
    std::fs::write(folder.path().join("with space.bin"), &file.bytes).expect("a file");
    let (scene, _) = load().expect("it is sound");
    assert_eq!(scene.files(), [folder.path().join("model.gltf"), folder.path().join("with space.bin")]);
    assert!(load_with("", CAMERA, "").is_err(), "an empty file");
    assert!(Scene::load(Path::new("no/such.scene.ron"), &Overrides::new(), &Arc::default()).is_err());
}

/// Each place of an instanced mesh is node · translation · rotation · scale, and the node itself draws nothing.
#[test]
fn meshes_are_drawn_at_every_place() {
    let file = |change: &dyn Fn(&mut Value)| {
        let mut file =
            File::new(json!({ "nodes": [{ "mesh": 0, "translation": [0, 0, 5], "children": [1] }, { "mesh": 0 }] }));
        let position = file.floats("VEC3", &[1., 0., 0., 0., 1., 0., 0., 0., 0.]);
        file.json["meshes"] = json!([{ "primitives": [{ "attributes": { "POSITION": position } }] }]);
        let translation = file.floats("VEC3", &[10., 0., 0., 20., 0., 0.]);
        let half = std::f32::consts::FRAC_1_SQRT_2;
        let rotation = file.floats("VEC4", &[0., 0., 0., 1., 0., 0., half, half]);
        let scale = file.floats("VEC3", &[1., 1., 1., 3., -2., 1.]);
        let attributes = json!({ "TRANSLATION": translation, "ROTATION": rotation, "SCALE": scale });
        file.json["nodes"][0]["extensions"] = json!({ "EXT_mesh_gpu_instancing": { "attributes": attributes } });
        file.json["extensionsRequired"] = json!(["EXT_mesh_gpu_instancing"]);
        file.json["extensionsUsed"] = json!(["EXT_mesh_gpu_instancing"]);
        change(&mut file.json["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"]);
        load_with(&file.text(), CAMERA, "")
    };
    let (scene, warnings) = file(&|_| ()).unwrap_or_else(|errors| panic!("{}", render_text(&errors, false)));
    assert!(warnings.is_empty());
    let frame = scene.at(0.0);
    let places: Vec<[DVec3; 2]> =
        frame.transforms.iter().map(|at| [DVec3::X, DVec3::Y].map(|corner| at.transform_point3(corner))).collect();
    let expected = [
        [DVec3::new(11.0, 0.0, 5.0), DVec3::new(10.0, 1.0, 5.0)],
        // Scaled by 3 and -2, a quarter turn about z.
        [DVec3::new(20.0, 3.0, 5.0), DVec3::new(22.0, 0.0, 5.0)],
        // The child, which is not instanced.
        [DVec3::new(1.0, 0.0, 5.0), DVec3::new(0.0, 1.0, 5.0)],
    ];
    assert_eq!(places.len(), 3);
    assert!(
        places.iter().flatten().zip(expected.iter().flatten()).all(|(a, b)| (*a - *b).length() < 1e-6),
        "{places:?}"
    );
    // One mesh, drawn three times.
    assert!(scene.instances.iter().all(|instance| Arc::ptr_eq(&instance.mesh, &scene.instances[0].mesh)));
    let messages =
        |change: &dyn Fn(&mut Value)| file(change).map_or_else(|errors| render_text(&errors, false), |_| String::new());
    for (value, message) in [
        (json!(99), "node 0, EXT_mesh_gpu_instancing: accessor 99 does not exist"),
        (json!("x"), "TRANSLATION is \"x\", and not the index of an accessor"),
        (json!(0), "2 elements beside 3"),
    ] {
        let text = messages(&|attributes| attributes["TRANSLATION"] = value.clone());
        assert!(text.contains(message), "{text}");
    }
}

/// Of a float there may be any value; a surface reflects what it gets and no more.
#[test]
fn colours_beyond_what_is_reflected_are_told() {
    let messages = |colors: &[f32]| {
        let mut file = File::new(json!({ "nodes": [{ "mesh": 0 }] }));
        let position = file.floats("VEC3", &ZIGZAG[..9]);
        let color = file.floats("VEC3", colors);
        file.json["meshes"] = json!([{ "primitives": [{ "attributes": { "POSITION": position, "COLOR_0": color } }] }]);
        let (scene, warnings) = load_with(&file.text(), CAMERA, "").expect("it is sound");
        assert!(scene.instances[0].mesh.colors.iter().all(|color| color.max_element() <= 1.0));
        render_text(&warnings, false)
    };
    assert_eq!(messages(&[1.0001, 0., 0., 0., 1., 0., 0., 0., 1.]), "");
    let text = messages(&[1.5, 0., 0., 0., 1., 0., 0., 0., 1.]);
    assert!(text.contains("not read: primitive 0 of mesh 0: vertex colours outside 0..1 (clamped)"), "{text}");
}

#[test]
fn materials_are_replaced_by_name() {
    let mut file = File::new(json!({ "nodes": [{ "mesh": 0 }] }));
    let position = file.floats("VEC3", &ZIGZAG[..9]);
    let color = file.floats("VEC3", &[0.5; 9]);
    let primitive =
        |material: u32| json!({ "attributes": { "POSITION": position, "COLOR_0": color }, "material": material });
    file.json["meshes"] = json!([{ "primitives": [primitive(0), primitive(1), primitive(2)] }]);
    file.json["materials"] = json!([{ "name": "Paint" }, { "name": "Rust" }, { "name": "Paint" }]);
    let text = file.text();
    let load = |object: &str| load_with(&text, CAMERA, object);
    let (scene, _) = load("materials: { \"Paint\": (diffuse: (1, 0, 0), shininess: 7) }").expect("it is sound");
    let drawn: Vec<_> = scene.instances.iter().map(|i| (&scene.materials[i.material], i.has_colors)).collect();
    for at in [0, 2] {
        assert_eq!((drawn[at].0.diffuse, drawn[at].0.shininess, drawn[at].1), (DVec3::X, 7.0, false));
    }
    assert!(drawn[1].0.metallic_roughness.is_some() && drawn[1].1);
    let messages = |object: &str| load(object).map_or_else(|errors| render_text(&errors, false), |_| String::new());
    for (object, message) in [
        ("materials: { \"Pain\": () }", "did you mean `Paint`?"),
        ("materials: { \"Paint\": () }, material: ()", "`material` replaces every material already"),
        ("materials: { \"Paint\": (difuse: (1, 1, 1)) }", "diffuse"),
        ("materials: [()]", "a map"),
    ] {
        assert!(messages(object).contains(message), "{object}: {}", messages(object));
    }
}
