//! Scenes of numbers that nobody means, as far as scene files take them: a picture is finite and nowhere below 0, or the
//! scene is refused.

use tyndall_tests::broken::Random;
use tyndall_tests::{Desk, shipped};

const GRAPHS: [&str; 10] = [
    "airlight",
    "fog",
    "volumetric-shadows",
    "reference",
    "height-fog",
    "froxels",
    "aerial-perspective",
    "modes/biri",
    "modes/table",
    "modes/legendre",
];

/// Rounds of each graph; TYNDALL_ROUNDS asks for more.
const ROUNDS: usize = 12;

const PLACES: [&str; 14] =
    ["0.0", "0.0", "1.0", "-1.0", "2.5", "1e-9", "-1e-4", "1e3", "-1e5", "1e7", "1e12", "-1e12", "3e-39", "0.7071"];
const LENGTHS: [&str; 9] = ["0.0", "0.0", "1e-12", "1e-3", "0.5", "2.0", "1e4", "1e9", "1e12"];
const SIZES: [&str; 7] = ["1e-9", "1e-3", "0.5", "2.0", "30.0", "1e4", "1e8"];
const POWERS: [&str; 8] = ["0.0", "1e-30", "1e-6", "1.0", "20.0", "1e6", "1e15", "1e20"];
const EXTINCTIONS: [&str; 12] =
    ["0.0", "0.0", "1e-38", "1e-30", "1e-20", "1e-10", "1e-3", "0.1", "3.0", "1e3", "1e8", "1e12"];
const UNIT: [&str; 5] = ["0.0", "1e-9", "0.5", "0.999999", "1.0"];
const PHASES: [&str; 12] = [
    "Isotropic",
    "Rayleigh",
    "HenyeyGreenstein(g: 0.999999)",
    "HenyeyGreenstein(g: -0.999999)",
    "HenyeyGreenstein(g: 0.5)",
    "HenyeyGreenstein(g: 1e-20)",
    "DoubleHenyeyGreenstein(g1: 0.9999999, g2: -0.99999, f: 0.5)",
    "DoubleHenyeyGreenstein(g1: 0.0, g2: 0.99, f: 1.0)",
    "Schlick(k: 0.9999999)",
    "Schlick(k: -0.99999)",
    "CornetteShanks(g: 0.99999)",
    "Droplets(diameter: 20.0)",
];
const ANGLES: [&str; 7] = ["1e-6", "0.01", "5.0", "30.0", "70.0", "89.999", "90.0"];
const EXPONENTS: [&str; 8] = ["0.0", "1e-6", "0.5", "1.0", "3.0", "64.0", "1e4", "1e30"];

/// A scene that is chosen at random.
struct Draw<'a>(&'a mut Random);

impl Draw<'_> {
    fn of(&mut self, choices: &[&str]) -> String {
        (*self.0.of(choices)).to_owned()
    }

    fn three(&mut self, choices: &[&str]) -> String {
        format!("({}, {}, {})", self.of(choices), self.of(choices), self.of(choices))
    }

    fn light(&mut self) -> String {
        let (position, power) = (self.three(&PLACES), self.three(&POWERS));
        let (radius, direction) = (self.of(&LENGTHS), self.three(&PLACES));
        match self.0.below(3) {
            0 => format!("Point(position: {position}, intensity: {power}, radius: {radius})"),
            1 => format!("Directional(direction: {direction}, irradiance: {power})"),
            _ => format!(
                "Spot(position: {position}, direction: {direction}, intensity: {power}, exponent: {}, cutoff: {}, radius: {radius})",
                self.of(&EXPONENTS),
                self.of(&ANGLES)
            ),
        }
    }

    fn object(&mut self) -> String {
        let mesh = match self.0.below(4) {
            0 => format!("Sphere(radius: {})", self.of(&SIZES)),
            1 => format!("Box(size: {})", self.three(&SIZES)),
            2 => format!("Plane(size: ({}, {}))", self.of(&SIZES), self.of(&SIZES)),
            _ => "Torus(major: 1.0, minor: 0.3)".to_owned(),
        };
        format!(
            "(mesh: {mesh}, translation: {}, rotation: (axis: (1.0, 0.3, 0.2), angle: {}), material: (diffuse: {}, specular: {}, shininess: {}))",
            self.three(&PLACES),
            self.of(&PLACES),
            self.three(&UNIT),
            self.three(&UNIT),
            self.of(&EXPONENTS)
        )
    }

    fn many(&mut self, of: fn(&mut Self) -> String) -> String {
        (0..1 + self.0.below(3)).map(|_| of(self)).collect::<Vec<_>>().join(", ")
    }

    fn medium(&mut self) -> String {
        let height = match self.0.below(3) {
            0 => format!(", scale_height: {}, base_height: {}", self.of(&LENGTHS), self.of(&PLACES)),
            _ => String::new(),
        };
        format!(
            "medium: (extinction: {}, albedo: {}, phase: {}, ambient: {}, emission: {}{height}),",
            self.three(&EXTINCTIONS),
            self.three(&UNIT),
            self.of(&PHASES),
            self.three(&POWERS),
            self.three(&POWERS)
        )
    }

    fn scene(&mut self) -> String {
        let medium = if self.0.below(4) == 0 { String::new() } else { self.medium() };
        format!(
            "(camera: (position: {}, look_at: {}, vertical_fov: {}), {medium} background: {}, lights: [{}], objects: [{}])",
            self.three(&PLACES),
            self.three(&PLACES),
            self.of(&["45.0", "1.0", "120.0", "179.0"]),
            self.three(&POWERS),
            self.many(Self::light),
            self.many(Self::object)
        )
    }
}

#[test]
fn pictures_are_finite_or_refused() {
    let rounds = std::env::var("TYNDALL_ROUNDS").ok().and_then(|text| text.parse().ok()).unwrap_or(ROUNDS);
    let seed = std::env::var("TYNDALL_SEED").ok().and_then(|text| text.parse().ok()).unwrap_or(0x5eed_u64);
    let desk = Desk::new();
    let mut random = Random(seed | 1);
    let (mut drawn, mut wrong) = (0, Vec::new());
    for round in 0..rounds {
        let scene = Draw(&mut random).scene();
        desk.put("extreme.scene.ron", &scene);
        for graph in GRAPHS {
            let ports = ["radiance", "airlight", "surface"];
            let ports = if graph == "airlight" { &ports[1..2] } else { &ports[..] };
            let Ok(pictures) = desk.try_draw(&shipped(graph), "extreme.scene.ron", (8, 6), ports, &[]) else {
                continue;
            };
            drawn += 1;
            for (port, picture) in ports.iter().zip(&pictures.pictures) {
                // what the papers do takes differences of large numbers, and four terms of a series
                let least = if graph.starts_with("modes/") { f32::MIN } else { 0.0 };
                let odd = picture.data.iter().filter(|value| !(value.is_finite() && **value >= least)).count();
                if odd > 0 {
                    wrong.push(format!("round {round}, {graph}, {odd} of {port}: {scene}"));
                }
            }
        }
    }
    assert!(wrong.is_empty(), "{} of {drawn}:\n{}", wrong.len(), wrong.join("\n"));
    assert!(drawn > rounds, "only {drawn} are drawn");
}
