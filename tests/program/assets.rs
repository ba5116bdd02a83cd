//! Models that nobody here made, in the folder named by `TYNDALL_ASSETS` (relative to the workspace).
//!
//! Set but missing fails; unset, a line says how many tests did not run.

use std::io::Write;
use std::path::PathBuf;

use tyndall_image::read;
use tyndall_tests::{Desk, root};

use crate::run::Program;

/// File, its fields in a scene, and height of its middle.
///
/// The small ones name no metallic factor, which means 1: by themselves they reflect no diffuse light at all.
const MODELS: [(&str, &str, f64); 5] = [
    ("flight-helmet/FlightHelmet.gltf", "scale: 3.0", 1.0),
    ("spot/spot.glb", "", 0.0),
    ("kenney/alien.glb", "material: (diffuse: (0.5, 0.5, 0.5))", 0.5),
    ("kenney/cakeBirthday.glb", "scale: 2.0, material: (diffuse: (0.5, 0.5, 0.5))", 0.2),
    ("kenney/tile.glb", "material: (diffuse: (0.5, 0.5, 0.5))", 0.0),
];

fn assets() -> Option<PathBuf> {
    let folder = std::env::var_os("TYNDALL_ASSETS").map(PathBuf::from)?;
    let folder = root().join(folder);
    assert!(folder.is_dir(), "TYNDALL_ASSETS names {}, which is not there", folder.display());
    Some(folder)
}

#[test]
fn real_models_render() {
    let Some(folder) = assets() else {
        // Past the test harness, which would keep to itself what a test prints that passes.
        writeln!(std::io::stdout(), "not run: 1 test needs TYNDALL_ASSETS").unwrap();
        return;
    };
    let desk = Desk::new();
    for (file, fields, middle) in MODELS {
        let path = folder.join(file).canonicalize().unwrap();
        let scene = format!(
            "(camera: (position: (1.2, {:?}, 3.0), look_at: (0.0, {middle:?}, 0.0)),
              medium: (extinction: (0.02, 0.02, 0.02)),
              lights: [Point(position: (2.0, 3.0, 3.0), intensity: (40.0, 40.0, 40.0))],
              objects: [(mesh: File({:?}), {fields})])",
            middle + 0.8,
            path.to_str().unwrap()
        );
        desk.put("model.scene.ron", &scene);
        let mut arguments = vec!["render", "fog.graph.ron", "--scene", "model.scene.ron", "--size", "160x120"];
        ["surface=s.npy", "airlight=a.npy", "surfaces.depth=d.npy", "image=i.png"]
            .iter()
            .for_each(|output| arguments.extend(["--output", output]));
        desk.ends(0, &arguments);
        let [surface, airlight, depth] = ["s.npy", "a.npy", "d.npy"].map(|name| read(&desk.path(name)).unwrap());
        assert!(surface.data.iter().all(|value| value.is_finite() && *value >= 0.0), "{file}");
        assert!(airlight.data.iter().all(|value| value.is_finite() && *value > 0.0), "{file}");
        let hit: Vec<bool> = depth.data.iter().map(|depth| depth.is_finite()).collect();
        let part = hit.iter().filter(|hit| **hit).count() as f64 / hit.len() as f64;
        assert!((0.02..0.7).contains(&part), "{file} covers {part}");
        let lit =
            surface.data.as_chunks::<3>().0.iter().zip(&hit).filter(|(pixel, hit)| **hit && pixel[0] > 0.0).count();
        assert!(lit as f64 > 0.2 * part * hit.len() as f64, "{file}: only {lit} pixels are lit");
        let dark = surface.data.as_chunks::<3>().0.iter().zip(&hit).all(|(pixel, hit)| *hit || *pixel == [0.0; 3]);
        assert!(dark, "{file}: light comes from where nothing is");
    }
}
