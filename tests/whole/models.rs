//! What is seen of glTF models: colours of vertices, textures without a filter, metal.

use tyndall_image::Image;
use tyndall_tests::{Desk, shipped};

/// A square of 2 m in the plane z = 0, its upper corners last; `attributes` and `more` as in a glTF file. The buffer holds
/// positions, texture coordinates, red as four floats, bytes and shorts for each vertex, and a picture of a red and a
/// green texel.
fn square(attributes: &str, more: &str) -> String {
    let corners = [[-1.0f32, -1.0], [1.0, -1.0], [-1.0, 1.0], [1.0, 1.0]];
    let mut bytes: Vec<u8> = corners.iter().flat_map(|[x, y]| [*x, *y, 0.0]).flat_map(f32::to_le_bytes).collect();
    bytes.extend(corners.iter().flat_map(|[x, y]| [(x + 1.0) / 2.0, (1.0 - y) / 2.0]).flat_map(f32::to_le_bytes));
    bytes.extend([1.0f32, 0.0, 0.0, 0.5].repeat(4).into_iter().flat_map(f32::to_le_bytes));
    bytes.extend([255u8, 0, 0, 128].repeat(4));
    bytes.extend([65_535u16, 0, 0, 32_768].repeat(4).into_iter().flat_map(u16::to_le_bytes));
    let picture = bytes.len();
    let texels = Image::new(2, 1, 3, vec![1.0, 0.0, 0.0, 0.0, 1.0, 0.0]);
    let png = tyndall_image::encode_png("a.png".as_ref(), &texels, tyndall_image::Meaning::Color).unwrap();
    bytes.extend(&png);
    let hex: String = bytes.iter().map(|byte| format!("%{byte:02x}")).collect();
    format!(
        r#"{{"asset": {{"version": "2.0"}}, "scene": 0, "scenes": [{{"nodes": [0]}}], "nodes": [{{"mesh": 0}}],
        "buffers": [{{"byteLength": {length}, "uri": "data:application/octet-stream,{hex}"}}],
        "bufferViews": [
            {{"buffer": 0, "byteLength": 48}}, {{"buffer": 0, "byteOffset": 48, "byteLength": 32}},
            {{"buffer": 0, "byteOffset": 80, "byteLength": 64}}, {{"buffer": 0, "byteOffset": 144, "byteLength": 16}},
            {{"buffer": 0, "byteOffset": 160, "byteLength": 32}},
            {{"buffer": 0, "byteOffset": {picture}, "byteLength": {size}}}],
        "accessors": [
            {{"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3"}},
            {{"bufferView": 1, "componentType": 5126, "count": 4, "type": "VEC2"}},
            {{"bufferView": 2, "componentType": 5126, "count": 4, "type": "VEC4"}},
            {{"bufferView": 3, "componentType": 5121, "normalized": true, "count": 4, "type": "VEC4"}},
            {{"bufferView": 4, "componentType": 5123, "normalized": true, "count": 4, "type": "VEC4"}}],
        "images": [{{"bufferView": 5, "mimeType": "image/png"}}],
        "meshes": [{{"primitives": [{{"mode": 5, "attributes": {{"POSITION": 0, {attributes}}}, "material": 0}}]}}], {more}}}"#,
        length = bytes.len(),
        size = png.len(),
    )
}

/// What the camera sees of a model that it is filled by, in a sun of π W/m² from behind it: the reflectance.
fn seen(model: &str, object: &str) -> Image {
    let desk = Desk::new();
    desk.put("model.gltf", model);
    desk.put(
        "model.scene.ron",
        &format!(
            "(camera: (position: (0, 0, 1), look_at: (0, 0, 0), vertical_fov: 90.0),
             lights: [Directional(direction: (0, 0, -1), irradiance: (3.14159265, 3.14159265, 3.14159265))],
             objects: [(mesh: File(\"model.gltf\"){object})])"
        ),
    );
    desk.picture(&shipped("fog"), "model.scene.ron", (64, 64), "surface", &["scattered=false"])
}

#[track_caller]
fn is(image: &Image, [x, y]: [u32; 2], expected: [f32; 3]) {
    let pixel = &image.pixel(x, y).unwrap()[..3];
    let is_near = pixel.iter().zip(expected).all(|(found, expected)| (found - expected).abs() < 1e-5);
    assert!(is_near, "pixel {x} {y}: {pixel:?}, expected {expected:?}");
}

/// What is seen of a base colour that is not metal and wholly rough: besides it k_s = 0.04/(4π), unless more light would
/// leave than arrives.
fn rough(base: [f32; 3]) -> [f32; 3] {
    base.map(|rho| rho + 0.01f32.min((1.0 - rho) / 2.0))
}

const MATTE: &str =
    r#""materials": [{"pbrMetallicRoughness": {"baseColorFactor": [0.8, 0.8, 0.8, 1], "metallicFactor": 0}}]"#;

/// glTF 2.0, 3.9.2: they multiply the base colour.
#[test]
fn vertex_colours_are_seen() {
    // As floats, bytes and shorts.
    for accessor in [2, 3, 4] {
        let image = seen(&square(&format!(r#""COLOR_0": {accessor}"#), MATTE), "");
        is(&image, [32, 32], rough([0.8, 0.0, 0.0]));
        is(&image, [3, 60], rough([0.8, 0.0, 0.0]));
    }
    let none = square(r#""TEXCOORD_0": 1"#, MATTE);
    is(&seen(&none, ""), [32, 32], rough([0.8; 3]));
    // Without a material, and with a texture: half of it is red, and the other green.
    let plain = square(r#""COLOR_0": 2"#, MATTE).replace(r#", "material": 0"#, "");
    is(&seen(&plain, ""), [32, 32], [0.8, 0.0, 0.0]);
    let image = seen(&square(r#""COLOR_0": 2, "TEXCOORD_0": 1"#, &textured("")), "");
    is(&image, [3, 32], rough([1.0, 0.0, 0.0]));
    is(&image, [60, 32], rough([0.0, 0.0, 0.0]));
    // A material of the scene file stands in for all that the model says.
    let own = seen(&square(r#""COLOR_0": 2"#, MATTE), ", material: (diffuse: (0.1, 0.2, 0.3))");
    is(&own, [32, 32], [0.1, 0.2, 0.3]);
}

/// Wholly rough metal mirrors a quarter of its colour over π to an eye that it faces; and what is half metal is in between.
#[test]
fn metal_is_seen() {
    for (metallic, expected) in [(1.0, [0.2, 0.1, 0.05]), (0.5, [0.505, 0.255, 0.13])] {
        let metal = format!(
            r#""materials": [{{"pbrMetallicRoughness": {{"baseColorFactor": [0.8, 0.4, 0.2, 1], "metallicFactor": {metallic}}}}}]"#
        );
        is(&seen(&square(r#""TEXCOORD_0": 1"#, &metal), ""), [32, 32], expected);
    }
    // Colours of vertices are the metal's.
    let metal = r#""materials": [{"pbrMetallicRoughness": {"baseColorFactor": [0.8, 0.8, 0.8, 1]}}]"#;
    is(&seen(&square(r#""COLOR_0": 2"#, metal), ""), [32, 32], [0.2, 0.0, 0.0]);
}

fn textured(filter: &str) -> String {
    format!(
        r#""materials": [{{"pbrMetallicRoughness": {{"metallicFactor": 0, "baseColorTexture": {{"index": 0}}}}}}],
        "textures": [{{"source": 0, "sampler": 0}}],
        "samplers": [{{{filter}"wrapS": 33071, "wrapT": 33071}}]"#
    )
}

#[test]
fn a_texture_without_a_filter_has_hard_edges() {
    let image = seen(&square(r#""TEXCOORD_0": 1"#, &textured(r#""magFilter": 9728, "minFilter": 9728, "#)), "");
    for (x, expected) in [
        (0, [1.0, 0.0, 0.0]),
        (24, [1.0, 0.0, 0.0]),
        (31, [1.0, 0.0, 0.0]),
        (32, [0.0, 1.0, 0.0]),
        (63, [0.0, 1.0, 0.0]),
    ] {
        is(&image, [x, 32], rough(expected));
    }
    // Linear where the file says so, and where it says nothing of it.
    for filter in [r#""magFilter": 9729, "#, r#""minFilter": 9728, "#, ""] {
        let image = seen(&square(r#""TEXCOORD_0": 1"#, &textured(filter)), "");
        // Between the centres of the texels at pixels 16 and 48: (24.5 - 16) / 32 is green.
        is(&image, [24, 32], rough([1.0 - 8.5 / 32.0, 8.5 / 32.0, 0.0]));
    }
}
