//! The models of `graphs/scenes/shadows` are what their generator makes, and they are sound.

#[path = "../examples/shadows/amphora.rs"]
mod amphora;
#[path = "../examples/shadows/columns.rs"]
mod columns;
#[path = "../examples/pavilion/glb.rs"]
#[allow(dead_code, reason = "the pavilion uses more of it")]
mod glb;
#[path = "../examples/shadows/pen.rs"]
mod pen;
#[path = "../examples/shadows/skin.rs"]
mod skin;
#[path = "../examples/shadows/tree.rs"]
mod tree;

use std::path::Path;
use std::sync::Arc;

use tyndall_document::render_text;
use tyndall_scene::{Overrides, Scene};

const FOLDER: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../../graphs/scenes/shadows");

#[test]
fn the_generator_makes_the_committed_bytes() {
    let how = "run `cargo run --release -p tyndall-scene --example shadows` and look at the pictures";
    let models =
        [("amphora", amphora::amphora()), ("columns", columns::columns()), ("tree", tree::tree()), ("pen", pen::pen())];
    for (name, made) in models {
        let path = Path::new(FOLDER).join("models").join(name).with_extension("glb");
        let committed = std::fs::read(path).expect("the model is committed");
        assert!(committed == made, "{name} is not what its generator makes: {how}");
    }
}

fn scene(name: &str) -> Scene {
    let loaded =
        Scene::load(&Path::new(FOLDER).join(name).with_extension("scene.ron"), &Overrides::new(), &Arc::default());
    let (scene, warnings) = loaded.unwrap_or_else(|errors| panic!("{}", render_text(&errors, false)));
    assert!(warnings.is_empty(), "{}", render_text(&warnings, false));
    scene
}

/// The published shadow planes need closed meshes; the exact ones do not, but a hole would let light through.
#[test]
fn the_models_are_closed_and_wound_outward() {
    for (name, triangles) in [("amphora", 20_000), ("columns", 15_000), ("tree", 100_000), ("pen", 1_000)] {
        let scene = scene(name);
        let adjacency = &scene.adjacency()[0];
        assert_eq!((adjacency.broken().count(), adjacency.degenerate.len()), (0, 0), "{name}");
        let of_model = scene.instances.iter().filter(|instance| instance.object == 0);
        let mut count = 0;
        for mesh in of_model.map(|instance| &instance.mesh) {
            count += mesh.triangles.len();
            for &[a, b, c] in &mesh.triangles {
                let corner = |i: u32| mesh.positions[i as usize];
                let face = (corner(b) - corner(a)).cross(corner(c) - corner(a));
                let lit = [a, b, c].iter().any(|i| mesh.normals[*i as usize].dot(face) > 0.0);
                assert!(lit, "{name}: all normals contradict their triangle's winding");
            }
        }
        assert!(count > triangles, "{name} has {count} triangles");
    }
}

#[test]
fn the_pen_comes_back_to_where_it_began() {
    let scene = scene("pen");
    let height = |time: f64| scene.bounds(time).expect("a pen").max.y;
    assert!((height(0.0) - height(4.0)).abs() < 1e-6 && (height(0.0) - height(2.0)).abs() > 0.005);
}
