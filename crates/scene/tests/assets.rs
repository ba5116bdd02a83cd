//! Files that nobody here made, in the folder named by `TYNDALL_ASSETS`.
//!
//! Set but missing fails; unset, a line says how many checks did not run.

use std::io::Write;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use tyndall_document::{Diagnostics, Source, render_text};
use tyndall_scene::{Overrides, Scene};

const CHECKS: usize = 6;

fn assets() -> Option<PathBuf> {
    let folder = std::env::var_os("TYNDALL_ASSETS").map(PathBuf::from)?;
    // Relative to the workspace, whichever crate's tests run.
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..").join(folder);
    assert!(folder.is_dir(), "TYNDALL_ASSETS names {}, which is not there", folder.display());
    Some(folder)
}

fn load(folder: &Path, fields: &str, file: &str) -> (Scene, Diagnostics) {
    let text = format!(
        "(camera: (position: (0.0, 0.0, 3.0), look_at: (0.0, 0.0, 0.0)), objects: [(mesh: File(\"{file}\"), {fields})])"
    );
    let source = Source::new("assets.scene.ron", text);
    Scene::from_source(&source, folder, &Overrides::new(), &Arc::default())
        .unwrap_or_else(|errors| panic!("{file}: {}", render_text(&errors, false)))
}

fn counts(scene: &Scene) -> (usize, usize) {
    let vertices = scene.instances.iter().map(|i| i.mesh.positions.len()).sum();
    (vertices, scene.instances.iter().map(|i| i.mesh.triangles.len()).sum())
}

#[test]
fn real_files() {
    let Some(folder) = assets() else {
        // Not `println!`: a test runner keeps that of a test which passes to itself.
        writeln!(std::io::stdout(), "not run: {CHECKS} tests need TYNDALL_ASSETS").unwrap();
        return;
    };
    let checks = [flight_helmet, flight_helmet_encodes, spot, alien, cake, tile];
    assert_eq!(checks.len(), CHECKS);
    checks.iter().for_each(|check| check(&folder));
}

fn flight_helmet(folder: &Path) {
    let (scene, warnings) = load(folder, "", "flight-helmet/FlightHelmet.gltf");
    assert_eq!(counts(&scene), (55_392, 94_722));
    assert_eq!((scene.materials.len(), scene.textures.len(), scene.instances.len()), (6, 5, 6));
    assert!(scene.materials.iter().all(|m| m.texture.is_some()));
    assert!(scene.textures.iter().all(|t| (t.width, t.height) == (512, 512)));
    // All channels of all textures, linear: leather and wood are not metal, so the helmet is not black.
    let sum: u64 = scene.textures.iter().flat_map(|t| &t.texels).map(|t| u64::from(t & 0xff)).sum();
    let mean = sum as f64 / (5.0 * 512.0 * 512.0);
    assert!(mean > 20.0 && mean < 200.0, "mean red {mean}");
    let text = render_text(&warnings, false);
    assert!(text.contains("LensesMat") && warnings.len() == 1, "{text}");
    assert_eq!(scene.files().len(), 1 + 1 + 10);
}

fn flight_helmet_encodes(folder: &Path) {
    let (scene, _) = load(folder, "scale: 2.0", "flight-helmet/FlightHelmet.gltf");
    let encoded = scene.encode(0.0, 1.0);
    assert_eq!(encoded.bytes("vertices").len(), 16 + 55_392 * 32);
    assert_eq!(encoded.bytes("triangles").len(), 16 + 94_722 * 16);
    assert_eq!(encoded.bytes("texels").len(), 5 * 512 * 512 * 4);
    let bounds = scene.bounds(0.0).expect("it has vertices");
    assert!(bounds.max.y > 1.2 && bounds.max.y < 1.6, "{bounds:?}");
}

fn spot(folder: &Path) {
    let (scene, warnings) = load(folder, "rotation: (axis: (0.0, 1.0, 0.0), angle: 33.0), scale: 0.7", "spot/spot.glb");
    assert_eq!(counts(&scene).1, 5856);
    assert!(warnings.is_empty());
    let adjacency = scene.adjacency();
    assert!(adjacency[0].is_closed() && adjacency[0].degenerate.is_empty());
    assert_eq!(adjacency[0].edges.len(), 5856 * 3 / 2);
    // The file has no material: the default one.
    assert_eq!(scene.materials[scene.instances[0].material].diffuse.x, 0.8);
}

fn alien(folder: &Path) {
    let (scene, warnings) = load(folder, "material: (diffuse: (0.2, 0.8, 0.3))", "kenney/alien.glb");
    assert!(counts(&scene).1 > 100 && scene.instances.len() > 6);
    assert_eq!(scene.materials.len(), 1);
    assert!(warnings.is_empty());
    let bounds = scene.bounds(0.0).expect("it has vertices");
    assert!(bounds.max.y > 0.5 && bounds.min.y > -0.1, "{bounds:?}");
}

fn cake(folder: &Path) {
    let (scene, warnings) = load(folder, "", "kenney/cakeBirthday.glb");
    // One line for what is not read (KHR_materials_unlit).
    let codes: Vec<&str> = warnings.iter().map(|warning| warning.code.0).collect();
    assert_eq!(codes, ["gltf-ignored"]);
    assert!(counts(&scene).1 > 500);
    // For want of factors everything is rough metal.
    assert!(scene.materials.iter().all(|m| m.metallic_roughness.is_some_and(|metal| metal.metallic == 1.0)));
}

fn tile(folder: &Path) {
    let (scene, _) = load(folder, "", "kenney/tile.glb");
    assert_eq!(counts(&scene), (64, 20));
}
