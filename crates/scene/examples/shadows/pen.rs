//! A fountain pen that writes, 14 cm long: a loop of four seconds.

use std::f32::consts::TAU;

use glam::{Quat, Vec3};
use serde_json::json;

use crate::glb::{Glb, Shape};
use crate::skin::{rod, turned};

/// Keys of the movement, and its duration, s.
const KEYS: usize = 48;
const SECONDS: f32 = 4.0;

/// The file `graphs/scenes/shadows/models/pen.glb`.
pub fn pen() -> Vec<u8> {
    let mut glb = Glb::default();
    let lacquer = glb.material("lacquer", [0.05, 0.06, 0.10], None);
    let gold = glb.material("gold", [0.80, 0.58, 0.20], None);
    let parts = [(&barrel(), lacquer), (&nib(), gold), (&ring(), gold), (&clip(), gold)];
    let mesh = glb.mesh("pen", &parts);
    let root = glb.node("pen", Vec3::ZERO, Quat::IDENTITY, &json!({ "mesh": mesh }), &[]);
    let time = |k: usize| k as f32 / KEYS as f32;
    let seconds: Vec<f32> = (0..=KEYS).map(|k| SECONDS * time(k)).collect();
    let turns: Vec<Quat> = (0..=KEYS).map(|k| turn(time(k))).collect();
    let places: Vec<Vec3> = (0..=KEYS).map(|k| place(time(k))).collect();
    let input = numbers(&mut glb, "SCALAR", seconds.iter().copied(), Some([0.0, SECONDS]));
    let rotation = numbers(&mut glb, "VEC4", turns.iter().flat_map(|turn| turn.to_array()), None);
    let translation = glb.triples(&places);
    let channel = |sampler: usize, path: &str| json!({ "sampler": sampler, "target": { "node": root, "path": path } });
    let sampler = |output: usize| json!({ "input": input, "output": output });
    glb.add(
        "animations",
        json!({
            "channels": [channel(0, "rotation"), channel(1, "translation")],
            "samplers": [sampler(rotation), sampler(translation)],
        }),
    );
    glb.finish(&[root])
}

fn numbers(glb: &mut Glb, kind: &str, values: impl Iterator<Item = f32>, range: Option<[f32; 2]>) -> usize {
    let bytes: Vec<u8> = values.flat_map(f32::to_le_bytes).collect();
    let width = if kind == "VEC4" { 16 } else { 4 };
    let view = glb.view(&bytes);
    let count = bytes.len() / width;
    let mut accessor = json!({ "bufferView": view, "componentType": 5126, "count": count, "type": kind });
    if let Some([min, max]) = range {
        accessor["min"] = json!([min]);
        accessor["max"] = json!([max]);
    }
    glb.add("accessors", accessor)
}

/// Where the tip writes: two loops on the way there, none on the way back.
fn place(time: f32) -> Vec3 {
    let (sin, cos) = (TAU * time).sin_cos();
    let (loop_sin, loop_cos) = (3.0 * TAU * time).sin_cos();
    Vec3::new(-0.030 * cos + 0.008 * loop_cos, 0.001 + 0.010 * (1.0 - sin).max(0.0) * 0.5, 0.010 * loop_sin)
}

/// Leaning to the right and toward the writer, swaying.
fn turn(time: f32) -> Quat {
    let (sin, cos) = (TAU * time).sin_cos();
    Quat::from_rotation_z(-0.22 + 0.30 * cos) * Quat::from_rotation_x(0.24 + 0.16 * sin) * Quat::from_rotation_y(0.7)
}

fn barrel() -> Shape {
    let profile = [
        (0.0, 0.014),
        (0.0032, 0.014),
        (0.0046, 0.0165),
        (0.0044, 0.020),
        (0.0050, 0.034),
        (0.0052, 0.036),
        (0.0062, 0.038),
        (0.0066, 0.060),
        (0.0067, 0.085),
        (0.0066, 0.110),
        (0.0062, 0.130),
        (0.0054, 0.137),
        (0.0036, 0.1405),
        (0.0, 0.142),
    ];
    turned(&profile, 32)
}

fn nib() -> Shape {
    let profile = [(0.0, 0.0), (0.0004, 0.0006), (0.0010, 0.005), (0.0020, 0.012), (0.0026, 0.016), (0.0, 0.0165)];
    turned(&profile, 16)
}

fn ring() -> Shape {
    let profile = [(0.0, 0.0835), (0.0066, 0.0835), (0.0070, 0.084), (0.0070, 0.0875), (0.0066, 0.088), (0.0, 0.088)];
    turned(&profile, 32)
}

fn clip() -> Shape {
    let path = [
        (Vec3::new(0.0, 0.134, 0.0045), 0.0009),
        (Vec3::new(0.0, 0.135, 0.0085), 0.0010),
        (Vec3::new(0.0, 0.131, 0.0098), 0.0011),
        (Vec3::new(0.0, 0.115, 0.0094), 0.0011),
        (Vec3::new(0.0, 0.100, 0.0082), 0.0012),
        (Vec3::new(0.0, 0.096, 0.0080), 0.0016),
    ];
    rod(&path, 10)
}
