//! Casters, lights and marches that are as bad as they can be: what comes of them, or is said of them.

use std::fmt::Write as _;

use tyndall_image::Image;
use tyndall_image::metrics::relative_errors;
use tyndall_render::Error;
use tyndall_tests::{Desk, shipped, text};

/// A scene of the triangles of `mesh.gltf` over a floor.
const SCENE: &str = r#"(
    camera: (position: (0.0, 1.5, 5.0), look_at: (0.0, 1.0, 0.0), vertical_fov: 50.0),
    medium: (extinction: (0.1, 0.1, 0.1), albedo: (0.9, 0.9, 0.9), phase: HenyeyGreenstein(g: 0.3)),
    lights: [
        Point(position: (-0.6, 2.9, -0.8), intensity: (20.0, 20.0, 20.0)),
        Directional(direction: (0.5, -1.0, -0.7), irradiance: (0.5, 0.6, 0.8)),
    ],
    objects: [(mesh: Plane(size: (30.0, 30.0))), (mesh: File("mesh.gltf"), translation: (0.0, 1.2, 0.0))],
)"#;

struct Mesh {
    positions: Vec<[f32; 3]>,
    triangles: Vec<[u32; 3]>,
}

/// A ring that stands askew: nothing of it is in a plane with anything else.
fn ring() -> Mesh {
    let (around, across) = (24, 10);
    let vertex = |k: u32| {
        let turn = |i: u32, n: u32| f64::from(i) / f64::from(n) * std::f64::consts::TAU;
        let (u, v) = (turn(k / across, around), turn(k % across, across));
        let r = 0.7 + 0.22 * v.cos();
        let (x, y, z) = (r * u.cos(), r * u.sin(), 0.22 * v.sin());
        [x + 0.31 * z, y, 0.8 * z - 0.47 * y].map(|x| x as f32)
    };
    let quad = |k: u32| {
        let (i, j) = (k / across, k % across);
        let at = |i: u32, j: u32| i % around * across + j % across;
        let [a, b, c, d] = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
        [[a, b, c], [a, c, d]]
    };
    let count = around * across;
    Mesh { positions: (0..count).map(vertex).collect(), triangles: (0..count).flat_map(quad).collect() }
}

/// Airlight and surfaces, with shadows.
fn pictures(desk: &Desk, mesh: &Mesh) -> [Image; 2] {
    let bytes: Vec<u8> = mesh.positions.iter().flatten().flat_map(|x| x.to_le_bytes()).collect();
    let vertices = bytes.len();
    let bytes: Vec<u8> =
        bytes.into_iter().chain(mesh.triangles.iter().flatten().flat_map(|i| i.to_le_bytes())).collect();
    std::fs::write(desk.path("mesh.bin"), &bytes).unwrap();
    let bound = |pick: fn(f32, f32) -> f32| {
        let all = mesh.positions.iter().copied().reduce(|a, b| std::array::from_fn(|i| pick(a[i], b[i])));
        all.unwrap().map(|x| x.to_string()).join(", ")
    };
    let gltf = format!(
        r#"{{
            "asset": {{ "version": "2.0" }},
            "scene": 0, "scenes": [{{ "nodes": [0] }}], "nodes": [{{ "mesh": 0 }}],
            "meshes": [{{ "primitives": [{{ "attributes": {{ "POSITION": 0 }}, "indices": 1 }}] }}],
            "accessors": [
                {{ "bufferView": 0, "componentType": 5126, "count": {}, "type": "VEC3", "min": [{}], "max": [{}] }},
                {{ "bufferView": 1, "componentType": 5125, "count": {}, "type": "SCALAR" }}
            ],
            "bufferViews": [
                {{ "buffer": 0, "byteOffset": 0, "byteLength": {vertices} }},
                {{ "buffer": 0, "byteOffset": {vertices}, "byteLength": {} }}
            ],
            "buffers": [{{ "uri": "mesh.bin", "byteLength": {} }}]
        }}"#,
        mesh.positions.len(),
        bound(f32::min),
        bound(f32::max),
        3 * mesh.triangles.len(),
        bytes.len() - vertices,
        bytes.len(),
    );
    desk.put("mesh.gltf", &gltf);
    desk.put("ring.scene.ron", SCENE);
    let graph = shipped("volumetric-shadows");
    desk.draw(&graph, "ring.scene.ron", (64, 48), ["airlight", "surface"], &["scattered=false"])
}

/// The largest error of `other`, relative to each number or a thousandth of the mean.
fn error(picture: &Image, other: &Image) -> f64 {
    let mean = picture.data.iter().map(|value| f64::from(*value)).sum::<f64>() / picture.data.len() as f64;
    relative_errors(other, picture, 1e-3 * mean, None).unwrap().max
}

/// Numbers below `n` in an order that looks random: 7919 is prime, and no divisor of `n`.
fn shuffled(n: u32) -> Vec<u32> {
    assert!(!n.is_multiple_of(7919));
    (0..n).map(|k| (k * 7919 + 13) % n).collect()
}

#[test]
fn the_order_of_triangles_corners_and_vertices_is_no_matter() {
    let desk = Desk::new();
    let mesh = ring();
    let plain = pictures(&desk, &mesh);
    let order = shuffled(mesh.positions.len() as u32);
    let mut positions = mesh.positions.clone();
    order.iter().zip(&mesh.positions).for_each(|(to, position)| positions[*to as usize] = *position);
    let turned = |k: u32| {
        let mut triangle = mesh.triangles[k as usize].map(|vertex| order[vertex as usize]);
        triangle.rotate_left(k as usize % 3);
        triangle
    };
    let triangles = shuffled(mesh.triangles.len() as u32).into_iter().map(turned).collect();
    let [airlight, surface] = pictures(&desk, &Mesh { positions, triangles });
    let errors = [error(&plain[0], &airlight), error(&plain[1], &surface)];
    println!("errors of airlight and surface: {errors:?}");
    assert!(errors[0] <= 1e-5 && errors[1] <= 1e-5, "{errors:?}");
}

/// Triangles without area, by their indices, by their positions, and along a line; a duplicate is not degenerate, and
/// casts as one does.
#[test]
fn degenerate_triangles_cast_nothing() {
    let desk = Desk::new();
    let mut mesh = ring();
    let plain = pictures(&desk, &mesh);
    let n = mesh.positions.len() as u32;
    mesh.positions.extend([mesh.positions[3], [0.5, 0.25, 0.75], [1.0, 0.5, 1.5], [1.5, 0.75, 2.25]]);
    mesh.triangles.extend([[3, 3, 40], [5, 5, 5], [3, n, 90], [n + 1, n + 2, n + 3], [n + 3, n + 2, n + 1]]);
    let [airlight, surface] = pictures(&desk, &mesh);
    let errors = [error(&plain[0], &airlight), error(&plain[1], &surface)];
    assert!(errors[0] <= 1e-6 && errors[1] <= 1e-6, "{errors:?}");
    mesh.triangles.extend(ring().triangles);
    let [airlight, surface] = pictures(&desk, &mesh);
    let errors = [error(&plain[0], &airlight), error(&plain[1], &surface)];
    assert!(errors[0] <= 1e-6 && errors[1] <= 1e-6, "{errors:?}");
    // And another triangle changes the picture.
    mesh.triangles.push([0, 60, 120]);
    assert!(error(&plain[0], &pictures(&desk, &mesh)[0]) > 1e-2);
}

/// A transform that is not finite is a mistake with its place, whatever it transforms.
#[test]
fn transforms_that_are_no_numbers_are_refused() {
    let desk = Desk::new();
    let graph = shipped("volumetric-shadows");
    let floor = "(mesh: Plane(size: (9.0, 9.0)))";
    for object in ["NaN", "inf", "-inf"].iter().flat_map(|number| {
        let keys = format!("translation: Keys([(0.0, (0.0, 0.0, 0.0)), (1.0, (0.0, {number}, 0.0))])");
        let rotation = format!("rotation: (axis: (0.0, 1.0, 0.0), angle: {number})");
        [format!("translation: (0.0, {number}, 0.0)"), keys, rotation]
    }) {
        let text = SCENE.replace(
            "(mesh: Plane(size: (30.0, 30.0)))",
            &format!("{floor},\n    (mesh: Box(size: (1.0, 1.0, 1.0)), {object})"),
        );
        desk.put("bad.scene.ron", &text.replace(", (mesh: File(\"mesh.gltf\"), translation: (0.0, 1.2, 0.0))", ""));
        let drawn = desk.try_draw(&graph, "bad.scene.ron", (8, 6), &["radiance"], &[]);
        let Err(error) = drawn else { panic!("{object} is drawn") };
        let messages = error.to_string();
        assert!(matches!(error, Error::Mistakes(_)), "{object}: {messages}");
        assert!(messages.contains("bad.scene.ron:9:") && messages.contains("error["), "{object}: {messages}");
    }
}

/// Of as many lights as there are bits for each shadows surfaces, and one more is messages.
#[test]
fn lights_without_a_bit_are_told() {
    let desk = Desk::new();
    let graph = shipped("volumetric-shadows");
    let messages = |count: u32| {
        let mut lights = String::new();
        for index in 0..count {
            let x = f64::from(index) * 0.015 - 1.0;
            write!(lights, "Point(position: ({x}, 3.0, 0.0), intensity: (0.1, 0.1, 0.1)),").unwrap();
        }
        let setting = format!("scene.lights=[{lights}]");
        desk.warnings(&desk.request(&graph, None, Some((8, 6)), &[&setting, "scattered=false"]))
    };
    assert!(!messages(128).contains("[limit]"), "{}", messages(128));
    assert!(
        messages(129).contains("warning[limit]: pass `air`: there are more lights than `lit` has bits for"),
        "{}",
        messages(129)
    );
}

/// Software Vulkan ends all loops of a thread after 65,535 rounds. What is rendered is right, or it is said that it is not.
#[test]
fn loops_that_the_driver_ends_are_told() {
    let desk = Desk::new();
    let graph = shipped("reference");
    let march = |steps: &str| {
        let settings = [&format!("steps={steps}"), "shadows=false"];
        let mut drawn = desk.try_draw(&graph, "test.scene.ron", (8, 6), &["airlight"], &settings).unwrap();
        (text(&drawn.warnings), drawn.pictures.remove(0))
    };
    let (messages, right) = march("16384");
    assert!(!messages.contains("[unfinished]"), "{messages}");
    let (messages, many) = march("65536");
    let error = error(&right, &many);
    println!("error {error}: {messages}");
    if messages.contains("[unfinished]") {
        assert!(
            messages.contains("warning[unfinished]: pass `air`: ") && messages.contains("in 48 pixels"),
            "{messages}"
        );
    } else {
        assert!(error < 1e-3, "{error} and not a word");
    }
}
