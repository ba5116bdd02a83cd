//! The committed model is what its generator makes, and it is sound.

#[path = "../examples/pavilion/build.rs"]
mod build;
#[path = "../examples/pavilion/glb.rs"]
mod glb;
#[path = "../examples/pavilion/model.rs"]
mod model;
#[path = "../examples/pavilion/pictures.rs"]
mod pictures;

use std::path::Path;
use std::sync::Arc;

use tyndall_document::render_text;
use tyndall_scene::model::LightKind;
use tyndall_scene::{Overrides, Scene};

const FOLDER: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../../graphs/scenes");

#[test]
fn the_generator_makes_the_committed_bytes() {
    let committed = std::fs::read(Path::new(FOLDER).join("models/pavilion.glb")).expect("the model is committed");
    assert!(committed.len() < 1 << 20, "{} bytes", committed.len());
    let how = "run `cargo run --release -p tyndall-scene --example pavilion` and look at the picture";
    assert!(committed == model::pavilion(), "the model is not what its generator makes: {how}");
}

#[test]
fn the_model_is_sound() {
    let (scene, warnings) = Scene::from_source(
        &tyndall_document::Source::new("test.scene.ron", "(objects: [(mesh: File(\"models/pavilion.glb\"))])"),
        Path::new(FOLDER),
        &Overrides::new(),
        &Arc::default(),
    )
    .unwrap_or_else(|errors| panic!("{}", render_text(&errors, false)));
    assert!(warnings.is_empty(), "{}", render_text(&warnings, false));
    // Lights and camera of the file count where the scene file gives none.
    assert_eq!(scene.lights.iter().filter(|l| l.kind == LightKind::Point).count(), 5);
    assert_eq!(scene.lights.len(), 6);
    let frame = scene.at(0.0);
    assert!((frame.camera.position - glam::DVec3::new(-3.1, 1.65, 11.2)).length() < 1e-6);
    assert!(frame.camera.up.y > 0.9 && frame.camera.right.y.abs() < 1e-6);
    assert!(frame.lights.iter().all(|l| l.position.y > 2.0));
    // Every solid is closed and wound outward: the shadow volumes to come depend on it.
    let adjacency = &scene.adjacency()[0];
    assert_eq!((adjacency.open().count(), adjacency.broken().count(), adjacency.degenerate.len()), (0, 0, 0));
    for instance in &scene.instances {
        let mesh = &instance.mesh;
        for &[a, b, c] in &mesh.triangles {
            let corner = |i: u32| mesh.positions[i as usize];
            let face = (corner(b) - corner(a)).cross(corner(c) - corner(a));
            assert!(mesh.normals[a as usize].dot(face) > 0.0, "a normal contradicts its triangle's winding");
        }
    }
}
