//! The papers' own modes: each table against its twin in double precision, the pictures against reference data, and the
//! errors that the papers do not speak of, as facts.

use std::f64::consts::{FRAC_PI_2, PI};
use std::path::Path;

use tyndall_scene::Phase;
use tyndall_shaders::airlight_table::{h, h_k};
use tyndall_shaders::surface_table::{j, j_k};
use tyndall_tests::{Desk, reference, shipped};

use crate::accuracy::{render, samples};

/// Largest optical depth of a table, as `TABLE_DEPTH` of `airlight_table.wgsl`.
const DEPTH: f64 = 10.0;

/// A table as a pass wrote it.
struct Table {
    size: usize,
    channels: usize,
    data: Vec<f32>,
}

impl Table {
    fn at(&self, x: usize, y: usize) -> [f64; 4] {
        let start = (y * self.size + x) * self.channels;
        [0, 1, 2, 3].map(|k| if k < self.channels { f64::from(self.data[start + k]) } else { 0.0 })
    }

    /// Holds every `stride`th texel in both directions against a twin of `argument` (u or T) and `share` of the y axis;
    /// `tolerance` is of the table's largest value.
    fn check(&self, what: &str, stride: usize, tolerance: f64, twin: &dyn Fn(f64, f64) -> [f64; 4]) {
        let largest = self.data.iter().fold(0.0, |largest: f64, value| largest.max(f64::from(value.abs())));
        let last = (self.size - 1) as f64;
        let texels = (0..self.size).step_by(stride).flat_map(|y| (0..self.size).step_by(stride).map(move |x| (x, y)));
        for (x, y) in texels {
            let expected = twin(DEPTH * x as f64 / last, y as f64 / last);
            for (found, expected) in self.at(x, y).into_iter().zip(expected) {
                let error = (found - expected).abs() / largest;
                assert!(error <= tolerance, "{what}, texel {x}, {y}: {found} instead of {expected}, {error:.1e}");
            }
        }
    }
}

/// The table `port` of a mode's graph, in the reference scene of a ground and a shiny sphere.
fn table(desk: &Desk, mode: &str, port: &str, size: usize, settings: &[&str]) -> Table {
    let sizes = [format!("airlight_size={size}"), format!("surface_size={size}")];
    let settings: Vec<&str> = settings.iter().copied().chain(sizes.iter().map(String::as_str)).collect();
    let (graph, scene) = (shipped(&format!("modes/{mode}")), reference("ground_phong.scene.ron"));
    let table = desk.picture(&graph, scene, (8, 6), &format!("{port}.table"), &settings);
    assert_eq!([table.width as usize, table.height as usize], [size, size]);
    Table { size, channels: table.channels as usize, data: table.data }
}

fn theta(share: f64) -> f64 {
    PI * (share - 0.5)
}

const PHASES: [(&str, Phase); 6] = [
    ("Isotropic", Phase::Isotropic),
    ("HenyeyGreenstein(g: 0.9)", Phase::HenyeyGreenstein { g: 0.9 }),
    ("HenyeyGreenstein(g: -0.5)", Phase::HenyeyGreenstein { g: -0.5 }),
    ("HenyeyGreenstein(g: 0.99)", Phase::HenyeyGreenstein { g: 0.99 }),
    (
        "DoubleHenyeyGreenstein(g1: 0.95, g2: -0.3, f: 0.4)",
        Phase::DoubleHenyeyGreenstein { g1: 0.95, g2: -0.3, f: 0.4 },
    ),
    ("Schlick(k: 0.7)", Phase::Schlick { k: 0.7 }),
];

#[test]
fn h_is_its_twin() {
    let desk = Desk::new();
    for (text, phase) in PHASES {
        let table = table(&desk, "table", "h", 65, &[&format!("scene.medium.phase={text}")]);
        table.check(text, 8, 1e-5, &|u, share| [h(&phase, u, theta(share)), 0.0, 0.0, 0.0]);
    }
}

#[test]
fn h_k_is_its_twin() {
    let table = table(&Desk::new(), "legendre", "h_k", 65, &[]);
    table.check("H_k", 8, 1e-5, &|u, share| h_k(u, theta(share)));
}

#[test]
fn j_is_its_twin() {
    let desk = Desk::new();
    for (text, phase) in &PHASES[..3] {
        let set = format!("scene.medium.phase={text}");
        let lambert = table(&desk, "table", "j1", 9, &[&set]);
        lambert.check(text, 4, 5e-5, &|depth, share| [j(phase, 1.0, depth, FRAC_PI_2 * share), 0.0, 0.0, 0.0]);
    }
    for n in [2.0, 20.0, 200.0] {
        let set = format!("scene.objects.1.material.shininess={n}");
        let phong = table(&desk, "table", "jn", 9, &[&set]);
        let phase = Phase::HenyeyGreenstein { g: 0.5 };
        phong.check(&format!("n = {n}"), 4, 5e-5, &|depth, share| {
            [j(&phase, n, depth, FRAC_PI_2 * share), 0.0, 0.0, 0.0]
        });
    }
}

#[test]
fn j_k_is_its_twin() {
    let desk = Desk::new();
    for (port, n) in [("j1_k", 1.0), ("jn_k", 20.0)] {
        let table = table(&desk, "legendre", port, 9, &[]);
        table.check(port, 4, 5e-5, &|depth, share| j_k(n, depth, FRAC_PI_2 * share));
    }
}

/// At the thesis' two sizes: what the pictures of its figures hide.
#[test]
fn airlight_by_tables_errs_as_the_readme_says() {
    let desk = Desk::new();
    let errors = |mode: &str, name: &str, size: &str| {
        let picture = render(&desk, &format!("modes/{mode}"), name, "airlight", &[&format!("airlight_size={size}")]);
        let errors = samples(name, "airlight").errors(&picture);
        println!("{mode} {size}, {name}: {errors:?}");
        errors
    };
    for name in ["glow_g0.5", "glow_g0.9", "glow_rayleigh", "ground_sphere"] {
        let (coarse, fine) = (errors("table", name, "64"), errors("table", name, "512"));
        assert!(fine.p99 < 6e-3 && coarse.p95 > 5e-3 && coarse.p50 > 10.0 * fine.p50, "{name}");
    }
    // a lamp behind the eye: the difference of two nearly equal numbers, times e^(sigma_t |t|)
    let (coarse, fine) = (errors("table", "lamp_behind", "64"), errors("table", "lamp_behind", "512"));
    assert!(coarse.p95 > 1.0 && fine.p50 < 5e-3 && fine.p99 > 0.1 && errors("table", "lamp_behind", "2048").p99 < 0.05);
    // cos^N in eighths of the lit part
    assert!(errors("table", "spot", "512").p95 < 1e-2);
    // the series is exact for what it is: the cut series, and a phase function without higher terms
    for name in ["glow_legendre3", "glow_rayleigh"] {
        assert!(errors("legendre", name, "512").p99 < 6e-3, "{name}");
    }
    // and is not the phase function
    assert!(errors("legendre", "glow_g0.5", "512").p50 > 0.02 && errors("legendre", "glow_g0.9", "512").p50 > 1.0);
}

/// The sum of four terms of Henyey and Greenstein's function is negative straight back above g = 0.459.
#[test]
fn the_series_makes_light_negative() {
    let desk = Desk::new();
    let darkest = |g: f64| {
        let set = format!("scene.medium.phase=HenyeyGreenstein(g: {g})");
        let picture = render(&desk, "modes/legendre", "lamp_behind", "airlight", &[&set]);
        picture.data.into_iter().fold(f32::INFINITY, f32::min)
    };
    assert!(darkest(0.45) > 0.0 && darkest(0.75) < 0.0);
    let table =
        render(&desk, "modes/table", "glow_g0.5", "airlight", &["scene.medium.phase=HenyeyGreenstein(g: 0.75)"]);
    assert!(table.data.iter().all(|value| *value > 0.0), "the table has no such light");
}

/// Beyond u = 10 the lookup clamps: fog so thick that nothing is left shines.
#[test]
fn thick_fog_shines() {
    let desk = Desk::new();
    let set = ["scene.medium.extinction=(8, 8, 8)", "scene.lights.0.position=(-1.5, 1.5, 0)"];
    let brightest = |graph: &str| {
        let picture = render(&desk, graph, "glow_g0.5", "airlight", &set);
        f64::from(picture.data.into_iter().fold(0.0, f32::max))
    };
    let (clamped, right) = (brightest("modes/table"), brightest("airlight"));
    println!("{clamped:e} for {right:e}");
    assert!(right > 0.0 && clamped > 1.2 * right);
}

/// The thesis' tables end at 90 degrees, and light that fog scatters does not; and beyond T = 10 they clamp, so that what is
/// far away shines.
#[test]
fn surfaces_by_tables_err_as_the_readme_says() {
    let desk = Desk::new();
    for (mode, size, p50) in [("table", "64", 5e-3), ("table", "128", 1.5e-3), ("legendre", "64", 1e-2)] {
        let set = ["direct=false", &format!("surface_size={size}")];
        let picture = render(&desk, &format!("modes/{mode}"), "ground_phong", "surface", &set);
        let wanted = samples("ground_phong", "scattered");
        let (errors, black) = (wanted.errors(&picture), wanted.blackened(&picture));
        println!("{mode} {size}: {errors:?}, {black} black");
        assert!(errors.p50 < p50 && errors.max > 100.0 && black > 10, "{errors:?}, {black} black");
    }
}

#[test]
fn what_the_tables_leave_out_is_told() {
    let desk = Desk::new();
    let warned = |scene: Option<&Path>, settings: &[&str]| {
        desk.warnings(&desk.request(&shipped("modes/table"), scene, Some((8, 6)), settings))
    };
    let messages = warned(None, &[]);
    assert!(
        messages.contains("warning[limit]: pass `scattered`: a spot")
            && messages.contains("a directional light scatters")
    );
    assert!(messages.contains("table.graph.ron:"), "{messages}");
    assert!(!warned(None, &["scattered=false"]).contains("[limit]"));
    let scene = reference("ground_phong.scene.ron");
    let plain = warned(Some(&scene), &[]);
    assert!(!plain.contains("[limit]"), "{plain}");
    let ground = "scene.objects.0.material=(specular: (0.1, 0.1, 0.1), shininess: 5)";
    assert!(warned(Some(&scene), &[ground]).contains("one table for all Phong lobes"));
}
