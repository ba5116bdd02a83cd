//! The published shadow planes: right where they were made for, and their failures as facts. The exact ones, which reference
//! data vouch for, are what they are held against.

use tyndall_image::Image;
use tyndall_tests::{Desk, reference, shipped};

/// Airlight of a scene: exact, as published, and with the planes added up without a stencil.
struct Airlight {
    exact: Vec<f32>,
    published: Vec<f32>,
    summed: Vec<f32>,
}

impl Airlight {
    /// Of a scene of `tests/reference`, or of another file.
    fn of(desk: &Desk, scene: &std::path::Path) -> Self {
        let render = |graph: &str, settings: &[&str]| -> Image {
            let settings = [&["scattered=false"], settings].concat();
            desk.picture(&shipped(graph), scene, (160, 120), "airlight", &settings)
        };
        Self {
            exact: render("volumetric-shadows", &[]).data,
            published: render("modes/biri", &[]).data,
            summed: render("modes/biri", &["stencil=false"]).data,
        }
    }

    /// Least and greatest ratio to the exact airlight, where there is any.
    fn ratios(&self, picture: &[f32]) -> [f32; 2] {
        let lit = self.exact.iter().zip(picture).filter(|(exact, _)| **exact > 0.0);
        lit.map(|(exact, drawn)| drawn / exact).fold([f32::MAX, f32::MIN], |[low, high], r| [low.min(r), high.max(r)])
    }

    /// Share of numbers that are wrong by more than 1 %.
    fn wrong(&self, picture: &[f32]) -> f64 {
        let pairs = self.exact.iter().zip(picture);
        pairs.filter(|(exact, drawn)| (*drawn - *exact).abs() > 0.01 * **exact).count() as f64 / picture.len() as f64
    }
}

/// An eye in light, before the casters of `objects`, or wherever `camera` is.
fn scene(desk: &Desk, camera: &str, light: &str, objects: &str) -> Airlight {
    let text = format!(
        "(
            camera: (position: {camera}, look_at: (0.0, 1.0, 0.0), vertical_fov: 50.0),
            medium: (extinction: (0.1, 0.1, 0.1), albedo: (0.9, 0.9, 0.9), phase: HenyeyGreenstein(g: 0.3)),
            lights: [Point(position: {light}, intensity: (20.0, 20.0, 20.0), radius: 0.02)],
            objects: [(mesh: Plane(size: (30.0, 30.0)), casts_shadow: false), {objects}],
        )"
    );
    desk.put("test.scene.ron", &text);
    Airlight::of(desk, &desk.path("test.scene.ron"))
}

const BEFORE: &str = "(0.0, 1.5, 5.0)";
const TILTED: &str = "rotation: (axis: (0.3, 1.0, 0.1), angle: 28.0)";

#[test]
fn one_convex_caster_is_right() {
    let desk = Desk::new();
    for name in ["box", "sphere"] {
        let airlight = Airlight::of(&desk, &reference(&format!("{name}.scene.ron")));
        for picture in [&airlight.published, &airlight.summed] {
            let [low, high] = airlight.ratios(picture);
            println!("{name}: {low} to {high}");
            assert!(low > 0.9999 && high < 1.0001, "{name}: {low} to {high}");
        }
    }
}

/// A box behind another in its shadow, and the box and the ball of the reference: the order of their edges is not that of
/// their planes. Without a stencil, what is in both shadows is subtracted twice, or its surface added.
#[test]
fn overlapping_shadows_are_wrong() {
    let desk = Desk::new();
    let boxes = format!(
        "(mesh: Box(size: (0.5, 0.5, 0.5)), translation: (-0.9, 1.6, -0.6), {TILTED}),
         (mesh: Box(size: (0.5, 0.5, 0.5)), translation: (0.4, 1.2, -0.2)),"
    );
    let in_line = scene(&desk, BEFORE, "(-1.9, 2.0, -1.0)", &boxes);
    let reference = Airlight::of(&desk, &reference("box_sphere.scene.ron"));
    for (name, airlight, darkest) in [("in line", in_line, 0.88), ("box_sphere", reference, 0.68)] {
        let (published, summed) = (airlight.ratios(&airlight.published), airlight.ratios(&airlight.summed));
        let wrong = [airlight.wrong(&airlight.published), airlight.wrong(&airlight.summed)];
        println!("{name}: published {published:?}, summed {summed:?}, wrong {wrong:?}");
        assert!(published[0] < darkest && published[1] > 1.15 && wrong[0] > 0.01, "{name}: {published:?}, {wrong:?}");
        assert!(summed[0] < darkest && summed[1] > 2.0 && wrong[1] > 0.01, "{name}: {summed:?}, {wrong:?}");
    }
}

#[test]
fn intersecting_planes_are_wrong() {
    let cross = format!(
        "(mesh: Box(size: (1.6, 0.2, 0.3)), translation: (0.0, 1.2, 0.0), rotation: (axis: (0.0, 0.3, 1.0), angle: 40.0)),
         (mesh: Box(size: (0.2, 1.4, 0.3)), translation: (0.0, 1.2, 0.0), {TILTED}),"
    );
    let airlight = scene(&Desk::new(), BEFORE, "(-1.0, 2.9, -1.0)", &cross);
    let ([low, high], wrong) = (airlight.ratios(&airlight.published), airlight.wrong(&airlight.published));
    println!("{low} to {high}, wrong {wrong}");
    assert!(low < 0.9 && high > 1.1 && wrong > 0.01, "{low} to {high}, {wrong}");
}

/// One caster that is not convex: planes in the wrong order subtract what was never added.
#[test]
fn a_ring_makes_light_negative() {
    let ring = "(mesh: Torus(major: 0.6, minor: 0.18), translation: (0.1, 1.5, -0.2), rotation: (axis: (1.0, 0.0, 0.3), angle: 50.0)),";
    let airlight = scene(&Desk::new(), BEFORE, "(-1.0, 2.9, -1.0)", ring);
    let darkest = |picture: &[f32]| picture.iter().copied().fold(f32::INFINITY, f32::min);
    println!("{} instead of {}", darkest(&airlight.published), darkest(&airlight.exact));
    assert!(darkest(&airlight.exact) > 0.0 && darkest(&airlight.published) < 0.0);
}

/// Nobody counts the shadow that the eye is in: where nothing is lit, light is drawn.
#[test]
fn an_eye_in_shadow_sees_light_that_is_not_there() {
    let wall = "(mesh: Box(size: (1.2, 0.9, 0.3)), translation: (0.1, 1.9, 1.2)),";
    let airlight = scene(&Desk::new(), BEFORE, "(0.3, 2.6, -2.2)", wall);
    let dark: Vec<f32> = airlight
        .exact
        .iter()
        .zip(&airlight.published)
        .filter(|(exact, _)| **exact == 0.0)
        .map(|pair| *pair.1)
        .collect();
    let shining = dark.iter().filter(|drawn| **drawn > 0.01).count();
    println!("{shining} of {} dark numbers shine", dark.len());
    assert!(dark.len() > 3000 && shining > dark.len() * 9 / 10, "{shining} of {}", dark.len());
}
