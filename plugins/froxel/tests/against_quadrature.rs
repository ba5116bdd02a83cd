//! The grid of froxels against the quadrature: right where the method must be, and better where it is finer.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

use tyndall_image::Image;
use tyndall_image::metrics::{relative_errors, sum_ratio};
use tyndall_tests::{Desk, shipped};

fn airlight(desk: &Desk, graph: &str, scene: &str, settings: &[&str]) -> Image {
    desk.put("froxels.scene.ron", scene);
    desk.picture(&shipped(graph), "froxels.scene.ron", (64, 48), "airlight", settings)
}

fn scene(light: &str, objects: &str) -> String {
    format!(
        "(
            camera: (position: (0.0, 1.5, 6.0), look_at: (0.0, 1.0, 0.0), vertical_fov: 50.0),
            medium: (extinction: (0.05, 0.1, 0.4), albedo: (0.9, 0.8, 0.7), phase: HenyeyGreenstein(g: 0.6)),
            lights: [{light}],
            objects: [{objects}],
        )"
    )
}

/// All that a froxel scatters of the sun's light is the same along a ray, so slices of any thickness are exact: borders,
/// sums and what lies within a slice are right to the last digits. Columns mix the phase function's values.
#[test]
fn the_sum_along_a_ray_is_exact() {
    let desk = Desk::new();
    let floor = "(mesh: Plane(size: (60.0, 60.0))), (mesh: Sphere(radius: 1.0), translation: (0.0, 1.0, 0.0))";
    let sun = scene("Directional(direction: (0.3, -1.0, 0.2), irradiance: (1.0, 1.0, 1.0))", floor)
        .replace("HenyeyGreenstein(g: 0.6)", "Isotropic");
    let quadrature = airlight(&desk, "airlight", &sun, &[]);
    for settings in [&["froxels.far=1e4"][..], &["froxels.slices=5", "froxels.near=3.0", "froxels.far=2e4"]] {
        let froxels = airlight(&desk, "froxels", &sun, settings);
        let errors = relative_errors(&froxels, &quadrature, 1e-6, None).unwrap();
        assert!(errors.max < 2e-5, "{settings:?}: {errors:?}");
    }
    // What is beyond the far end is missing: of 400 m to 2 m the whole of exp(-0.05 * 2) and so on.
    let short = airlight(&desk, "froxels", &sun, &["froxels.far=2.0"]);
    let (top, wanted) = (short.pixel(32, 0).unwrap(), quadrature.pixel(32, 0).unwrap());
    for (channel, extinction) in [0.05f32, 0.1, 0.4].into_iter().enumerate() {
        let seen = top[channel] / wanted[channel];
        assert!((seen - (1.0 - (-2.0 * extinction).exp())).abs() < 0.01, "{channel}: {seen}");
    }
}

#[test]
fn a_finer_grid_is_closer_to_the_truth() {
    let desk = Desk::new();
    let lamps = "Point(position: (0.5, 2.0, 9.0), intensity: (20.0, 18.0, 15.0)), \
                 Spot(position: (3.0, 3.5, 2.0), direction: (-1.0, -0.6, -0.5), intensity: (30.0, 30.0, 30.0), exponent: 4.0)";
    let scene = scene(lamps, "(mesh: Sphere(radius: 1.0), translation: (0.0, 1.0, 0.0))");
    let quadrature = airlight(&desk, "airlight", &scene, &[]);
    let error = |settings: &[&str]| {
        let froxels = airlight(&desk, "froxels", &scene, settings);
        relative_errors(&froxels, &quadrature, 1e-6, None).unwrap().p50
    };
    let coarse = error(&["froxels.width=16", "froxels.height=12", "froxels.slices=16"]);
    let fine = error(&["froxels.width=64", "froxels.height=48", "froxels.slices=64"]);
    let points = error(&["froxels.width=16", "froxels.height=12", "froxels.slices=16", "points=4"]);
    assert!(fine < 0.2 * coarse && fine < 5e-3, "{fine} against {coarse}");
    assert!(points < 0.5 * coarse, "{points} against {coarse}");
}

/// A lamp in a froxel: its core is blurred, and no light of it is lost.
#[test]
fn a_lamp_in_a_froxel_scatters_as_much_light() {
    let desk = Desk::new();
    for x in [0.0, 0.13, 0.21] {
        let lamp = scene(&format!("Point(position: ({x}, 1.2, 0.0), intensity: (20.0, 18.0, 15.0))"), "");
        let quadrature = airlight(&desk, "airlight", &lamp, &[]);
        let ratio = sum_ratio(&airlight(&desk, "froxels", &lamp, &[]), &quadrature).unwrap();
        assert!((ratio - 1.0).abs() < 0.03, "{x}: {ratio}");
    }
}
