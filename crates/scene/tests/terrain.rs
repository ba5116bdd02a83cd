//! The committed terrain is what its generator makes, and it is sound.

#[path = "../examples/terrain/erosion.rs"]
mod erosion;
#[path = "../examples/pavilion/glb.rs"]
#[allow(dead_code, reason = "the pavilion uses more of it")]
mod glb;
#[path = "../examples/terrain/model.rs"]
mod model;
#[path = "../examples/terrain/noise.rs"]
mod noise;

use std::path::Path;
use std::sync::Arc;

use tyndall_document::render_text;
use tyndall_scene::{Overrides, Scene};

const FOLDER: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../../graphs/scenes");

#[test]
fn the_generator_makes_the_committed_bytes() {
    let committed = std::fs::read(Path::new(FOLDER).join("models/terrain.glb")).expect("the model is committed");
    assert!(committed.len() < 1 << 20, "{} bytes", committed.len());
    let how = "run `cargo run --release -p tyndall-scene --example terrain` and look at the picture";
    assert!(committed == model::terrain(), "the model is not what its generator makes: {how}");
}

#[test]
fn the_scene_is_sound() {
    let loaded = Scene::load(&Path::new(FOLDER).join("terrain.scene.ron"), &Overrides::new(), &Arc::default());
    let (scene, warnings) = loaded.unwrap_or_else(|errors| panic!("{}", render_text(&errors, false)));
    assert!(warnings.is_empty(), "{}", render_text(&warnings, false));
    let mesh = &scene.instances[0].mesh;
    assert!(mesh.positions.len() > 10_000);
    for &[a, b, c] in &mesh.triangles {
        let corner = |i: u32| mesh.positions[i as usize];
        let face = (corner(b) - corner(a)).cross(corner(c) - corner(a));
        assert!(face.y > 0.0 && mesh.normals[a as usize].y > 0.0, "the ground looks up");
    }
}

/// Water finds its way: no place but the edge and a few hollows lies lower than all eight around it.
#[test]
fn rivers_run_to_the_edge() {
    let heights =
        erosion::Heights::eroded(60, 60, |_, _| 200.0, |x, z| 20.0 * noise::noise(x as f64 / 5.0, z as f64 / 5.0, 1));
    let at = |x: usize, z: usize| heights.data[z * 60 + x];
    let mut hollows = 0;
    for (x, z) in (1..59).flat_map(|z| (1..59).map(move |x| (x, z))) {
        let around = [(0, 0), (0, 1), (0, 2), (1, 0), (1, 2), (2, 0), (2, 1), (2, 2)];
        hollows += usize::from(around.iter().all(|(i, j)| at(x + i - 1, z + j - 1) > at(x, z)));
    }
    assert!(hollows <= 5, "{hollows}");
    assert!(at(30, 30) > 500.0 && at(0, 0) < 30.0);
}
