//! Pictures of the shipped graphs against reference data that this project did not compute (see `reference/README.md`).

use tyndall_image::Image;
use tyndall_image::metrics::relative_errors;
use tyndall_tests::{Desk, Samples, reference, shipped, sum_error};

/// 99 of 100 numbers are measured to be within 2e-4; three roundings of f32 in sums of 12 nodes leave no less.
const P99: f64 = 1e-3;
/// What the project promises of any segment. The worst pixels are those beside a lamp: a ray that passes it at `h`
/// is as bright as 1/h, and the f32 position of the lamp alone moves h.
const MAX: f64 = 6e-3;
/// Errors of single pixels go both ways, so that a sum must be better than they are.
const SUM: f64 = 5e-4;

const AIRLIGHT: [&str; 9] =
    ["glow_g0.5", "glow_g0.9", "glow_rayleigh", "lamp_behind", "spot", "ground_sphere", "box", "sphere", "box_sphere"];
const SURFACES: [&str; 6] = ["spot", "ground_sphere", "ground_phong", "box", "sphere", "box_sphere"];

/// Pixels of a term of a scene.
pub fn samples(name: &str, term: &str) -> Samples {
    Samples::read(&reference(&format!("{name}.{term}.npy")))
}

pub fn render(desk: &Desk, graph: &str, name: &str, term: &str, settings: &[&str]) -> Image {
    let scene = reference(&format!("{name}.scene.ron"));
    desk.picture(&shipped(graph), &scene, (160, 120), term, settings)
}

#[test]
fn airlight_agrees_with_the_reference() {
    let desk = Desk::new();
    for name in AIRLIGHT {
        let picture = render(&desk, "airlight", name, "airlight", &[]);
        let (errors, sum) =
            (samples(name, "airlight").errors(&picture), sum_error(&reference("sums.json"), name, &picture));
        println!("{name}: p50 {:.1e}, p99 {:.1e}, max {:.1e}, sum {sum:.1e}", errors.p50, errors.p99, errors.max);
        assert!(errors.p99 <= P99 && errors.max <= MAX && sum <= SUM, "{name}: {errors:?}, sum {sum:e}");
    }
}

#[test]
fn the_fog_graph_draws_the_same_airlight() {
    let desk = Desk::new();
    let [fog, alone] = ["fog", "airlight"].map(|graph| render(&desk, graph, "box", "airlight", &[]));
    assert_eq!(tyndall_image::metrics::differing_bits(&fog, &alone).unwrap(), 0);
}

#[test]
fn directly_lit_surfaces_agree_with_the_reference() {
    let desk = Desk::new();
    for name in SURFACES {
        let picture = render(&desk, "fog", name, "surface", &["scattered=false"]);
        let errors = samples(name, "surface").errors(&picture);
        println!("{name}: p50 {:.1e}, p99 {:.1e}, max {:.1e}", errors.p50, errors.p99, errors.max);
        assert!(errors.p99 <= P99 && errors.max <= MAX, "{name}: {errors:?}");
    }
}

/// Light that the medium scatters onto surfaces, from a table: 99 of 100 numbers are measured to be within 1.7e-3, the
/// worst where the ground is lit from far away at a grazing angle and the light comes from above the horizon alone.
const SCATTERED_P99: f64 = 4e-3;
const SCATTERED_MAX: f64 = 8e-3;

#[test]
fn surfaces_lit_by_scattered_light_agree_with_the_reference() {
    let desk = Desk::new();
    for graph in ["fog", "reference"] {
        let picture = render(&desk, graph, "ground_phong", "surface", &["direct=false"]);
        let errors = samples("ground_phong", "scattered").errors(&picture);
        println!("{graph}: p50 {:.1e}, p99 {:.1e}, max {:.1e}", errors.p50, errors.p99, errors.max);
        assert!(errors.p99 <= SCATTERED_P99 && errors.max <= SCATTERED_MAX, "{graph}: {errors:?}");
    }
    let fails = |what: &str, set: &str| {
        let errors = samples("ground_phong", "scattered").errors(&render(
            &desk,
            "fog",
            "ground_phong",
            "surface",
            &["direct=false", set],
        ));
        assert!(errors.p99 > SCATTERED_P99, "{what} passes: {errors:?}");
    };
    fails("g of 0.53 for 0.5", "scene.medium.phase=HenyeyGreenstein(0.53)");
    fails("an albedo of 0.99", "scene.medium.albedo=(0.7425, 0.792, 0.891)");
    fails("a shininess of 22 for 20", "scene.objects.1.material.shininess=22.0");
}

/// The two terms add up, each has its switch, and without both surfaces are black.
#[test]
fn terms_of_surfaces_add_up() {
    let desk = Desk::new();
    let of = |settings: &[&str]| render(&desk, "fog", "ground_phong", "surface", settings).data;
    let (both, direct, scattered) = (of(&[]), of(&["scattered=false"]), of(&["direct=false"]));
    for ((both, direct), scattered) in both.iter().zip(&direct).zip(&scattered) {
        assert!((both - direct - scattered).abs() <= 1e-6 * both, "{both} of {direct} and {scattered}");
    }
    assert!(direct != both && scattered != both);
    assert!(of(&["direct=false", "scattered=false"]).iter().all(|value| *value == 0.0));
}

/// The same comparisons must fail where the picture is wrong.
#[test]
fn wrong_pictures_are_noticed() {
    let desk = Desk::new();
    let name = "box";
    let fails = |what: &str, term: &str, picture: &Image| {
        let errors = samples(name, term).errors(picture);
        assert!(errors.p99 > P99 && errors.max > MAX, "{what} passes: {errors:?}");
    };
    let set = "scene.medium.extinction=(0.05, 0.05, 0.05)";
    let half = render(&desk, "airlight", name, "airlight", &[set]);
    fails("half the density", "airlight", &half);
    assert!(sum_error(&reference("sums.json"), name, &half) > SUM);
    fails("surfaces in half the density", "surface", &render(&desk, "fog", name, "surface", &[set]));
    let set = "scene.medium.phase=HenyeyGreenstein(0.51)";
    fails("g of 0.51 for 0.5", "airlight", &render(&desk, "airlight", name, "airlight", &[set]));

    let right = render(&desk, "airlight", name, "airlight", &[]);
    let shifted = |by: usize| {
        let mut data = right.data.clone();
        data.rotate_right(3 * by);
        Image::new(right.width, right.height, 3, data)
    };
    fails("a picture shifted by a column", "airlight", &shifted(1));
    fails("a picture shifted by a row", "airlight", &shifted(160));
    let scaled = |factor: f32| Image::new(160, 120, 3, right.data.iter().map(|value| factor * value).collect());
    assert!(sum_error(&reference("sums.json"), name, &scaled(1.001)) > SUM, "a picture brighter by 0.1 % passes");
    fails("a black picture", "airlight", &scaled(0.0));
    fails("a picture of NaN", "airlight", &scaled(f32::NAN));
}

/// Midpoints to the surface, or to an optical depth of 16, beyond which 1e-7 of the light is.
///
/// With 1,024 steps a step toward the sky is 0.16 m in this medium. A ray that passes the lamp at less than that jumps
/// over the peak: its error has no bound (0.4 to 0.7 are measured), and only the part of such rays has one. The samples
/// have more of them than the picture.
#[test]
fn the_march_agrees_with_the_quadrature_within_what_a_march_can() {
    let desk = Desk::new();
    for name in ["lamp_behind", "ground_sphere", "glow_g0.5"] {
        let march = render(&desk, "reference", name, "airlight", &["steps=1024", "scattered=false", "shadows=false"]);
        let errors = samples(name, "airlight").errors(&march);
        let quadrature = render(&desk, "airlight", name, "airlight", &[]);
        let whole = relative_errors(&march, &quadrature, 1e-9, None).unwrap();
        assert!(errors.p50 <= 1e-3 && errors.p99 <= 2e-2 && whole.p99 <= 1e-3, "{name}: {errors:?} {whole:?}");
    }
}
