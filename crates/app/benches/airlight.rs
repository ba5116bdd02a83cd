//! Airlight by quadrature against a march along the ray: time on the GPU, and error against double precision.
//!
//! `cargo bench -p tyndall --bench airlight` prints the table of the README. Both sides run in the program itself, in
//! turns within one run, so that their ratio holds on a machine that does other things too.

#![allow(clippy::print_stdout, clippy::unwrap_used, reason = "a benchmark prints, and stops where it cannot measure")]

use std::path::Path;
use std::process::Command;

use glam::DVec3;
use tyndall_shaders::airlight::airlight;
use tyndall_shaders::ray::{Ray, ray_of_pixel};
use tyndall_shaders::scene::{Camera, Light, Medium, Phase};

const SIZE: [u32; 2] = [640, 480];
const ROUNDS: usize = 5;

const SCENE: &str = "(
    camera: (position: (0.0, 1.5, 0.0), look_at: (0.0, 1.5, -8.0), vertical_fov: 50.0),
    medium: (extinction: (0.08, 0.1, 0.13), albedo: (0.9, 0.9, 0.9), phase: HenyeyGreenstein(g: 0.75)),
    lights: [Point(position: (0.3, 1.9, -8.0), intensity: (100.0, 90.0, 70.0))],
)";

/// A way to the same picture.
struct Method {
    name: String,
    graph: String,
    times: Vec<f64>,
    errors: Vec<f64>,
}

impl Method {
    fn new(name: String, pass: &str, param: &str, value: u32) -> Self {
        let graph = format!(
            "(version: 1, scene: \"one.scene.ron\", size: ({}, {}), passes: {{ \"air\": (use: \"{pass}\", params: \
             {{ \"{param}\": {value} }}) }}, outputs: {{ \"airlight\": \"air.radiance\" }})",
            SIZE[0], SIZE[1]
        );
        Self { name, graph, times: Vec::new(), errors: Vec::new() }
    }

    fn milliseconds(&mut self) -> f64 {
        self.times.sort_by(f64::total_cmp);
        self.times[self.times.len() / 2] / 1e3
    }

    fn error(&mut self, part: f64) -> f64 {
        self.errors.sort_by(f64::total_cmp);
        self.errors[((self.errors.len() - 1) as f64 * part).round() as usize]
    }
}

fn main() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("one.scene.ron"), SCENE).unwrap();
    let quadrature =
        [4, 8, 12].map(|n| Method::new(format!("quadrature, {n} nodes"), "airlight.homogeneous", "nodes", n));
    let march = [16, 64, 256, 1024].map(|n| Method::new(format!("march, {n} steps"), "march.airlight", "steps", n));
    let mut methods: Vec<Method> = quadrature.into_iter().chain(march).collect();
    let truth = truth();
    for method in &mut methods {
        std::fs::write(folder.path().join("one.graph.ron"), &method.graph).unwrap();
        method.errors = errors(folder.path(), &truth);
    }
    for _ in 0..ROUNDS {
        for method in &mut methods {
            std::fs::write(folder.path().join("one.graph.ron"), &method.graph).unwrap();
            method.times.push(gpu_us(folder.path()));
        }
    }
    let against = methods.iter_mut().find(|method| method.name == "march, 64 steps").unwrap().milliseconds();
    println!("\n| method | GPU time | of the 64-step march | p50 | p99 | max |\n| --- | --- | --- | --- | --- | --- |");
    for method in &mut methods {
        let (time, name) = (method.milliseconds(), method.name.clone());
        let [p50, p99, max] = [0.5, 0.99, 1.0].map(|part| method.error(part));
        println!("| {name} | {time:.1} ms | {:.2} | {p50:.1e} | {p99:.1e} | {max:.1e} |", time / against);
    }
}

fn tyndall(folder: &Path, arguments: &[&str]) {
    let program = env!("CARGO_BIN_EXE_tyndall");
    let output = Command::new(program).args(arguments).current_dir(folder).output().unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
}

/// GPU time of the pass, µs.
fn gpu_us(folder: &Path) -> f64 {
    tyndall(folder, &["bench", "one.graph.ron", "--frames", "5", "--json", "figures.json"]);
    let text = std::fs::read_to_string(folder.join("figures.json")).unwrap();
    let figures: serde_json::Value = serde_json::from_str(&text).unwrap();
    figures["passes"][0]["gpu_us"].as_f64().unwrap()
}

/// Pixels and their airlight: every eighth one, and all of those around the lamp.
fn truth() -> Vec<([u32; 2], DVec3)> {
    let (position, target) = (DVec3::new(0.0, 1.5, 0.0), DVec3::new(0.0, 1.5, -8.0));
    let half = 25_f64.to_radians().tan();
    let forward = (target - position).normalize();
    let right = DVec3::X * half * f64::from(SIZE[0]) / f64::from(SIZE[1]);
    let camera = Camera { position, nearest: 1e-6, right, up: DVec3::Y * half, forward };
    let medium = Medium {
        extinction: DVec3::new(0.08, 0.1, 0.13),
        albedo: DVec3::splat(0.9),
        phase: Phase::HenyeyGreenstein { g: 0.75 },
    };
    let lamp = DVec3::new(0.3, 1.9, -8.0);
    let light = Light::Point { position: lamp, intensity: DVec3::new(100.0, 90.0, 70.0), radius: 0.0 };
    let mut pixels = Vec::new();
    for y in 0..SIZE[1] {
        for x in 0..SIZE[0] {
            let ray = ray_of_pixel(&camera, [x, y], SIZE);
            if (x % 8 == 0 && y % 8 == 0) || beside(&ray, lamp) < 0.2 {
                pixels.push(([x, y], airlight(&light, &medium, &ray, 0.0, f64::INFINITY)));
            }
        }
    }
    pixels
}

/// Distance of a point from a ray, m.
fn beside(ray: &Ray, point: DVec3) -> f64 {
    ray.direction.cross(point - ray.origin).length()
}

/// Relative errors of the program's picture, of every channel.
fn errors(folder: &Path, truth: &[([u32; 2], DVec3)]) -> Vec<f64> {
    tyndall(folder, &["render", "one.graph.ron", "--output", "airlight=air.exr"]);
    let picture = tyndall_image::read(&folder.join("air.exr")).unwrap();
    let mut errors = Vec::new();
    for ([x, y], expected) in truth {
        let pixel = picture.pixel(*x, *y).unwrap();
        errors.extend((0..3).map(|channel| (f64::from(pixel[channel]) / expected[channel] - 1.0).abs()));
    }
    errors
}
