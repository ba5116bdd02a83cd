//! Airlight of cases on the GPU.

use tyndall_probe::Probe;
use tyndall_scene::{layout, phase_table};
use tyndall_shaders::scene::{Light, Phase};

use crate::cases::Case;

const SHADER: &str = "
#import scene
#import ray
#import airlight

override nodes: u32 = 8;

struct Case {
    light: Light,
    medium: Medium,
    phase: Phase,
    origin: vec3<f32>,
    way: f32,
    direction: vec3<f32>,
}

var<storage, read> cases: array<Case>;
var<storage, read_write> results: array<vec4<f32>>;

@compute @workgroup_size(64)
fn main(@builtin(global_invocation_id) id: vec3<u32>) {
    if id.x >= arrayLength(&cases) {
        return;
    }
    let case_ = cases[id.x];
    let ray = Ray(case_.origin, case_.direction);
    var sum = vec3<f32>(0.0);
    var cursor = Cursor(0u, 0u, 0.0);
    loop {
        let piece = airlight(cursor, case_.light, case_.medium, case_.phase, ray, case_.way, nodes);
        sum += piece.radiance;
        cursor = piece.next;
        if cursor.light >= 1u { break; }
    }
    results[id.x] = vec4<f32>(sum, 1.0);
}
";

/// Airlight of each case, W/(sr m²). Of measured phase functions all cases have the same.
pub fn airlight(cases: &[Case], nodes: u32) -> Vec<[f32; 3]> {
    let table = phase_table(&cases[0].medium.phase);
    let probe = Probe::new(SHADER, &[], &[("nodes", f64::from(nodes)), ("phase_table_count", count(&table))]);
    let bytes: Vec<u8> = cases.iter().flat_map(bytes).collect();
    let results = probe.run_with(&bytes, cases.len(), &[("phase_table", &table)]);
    results.into_iter().map(|[r, g, b, _]| [r, g, b]).collect()
}

/// The element count at the front of a list of the scene.
pub fn count(list: &[u8]) -> f64 {
    f64::from(u32::from_le_bytes(*list.first_chunk().unwrap()))
}

fn bytes(case: &Case) -> Vec<u8> {
    let ray = [case.ray.origin.as_vec3().extend(case.way as f32), case.ray.direction.as_vec3().extend(0.0)];
    let mut bytes = bytemuck::bytes_of(&light(&case.light)).to_vec();
    bytes.extend_from_slice(bytemuck::bytes_of(&layout::Medium::from(&case.medium)));
    bytes.extend_from_slice(&phase(&case.medium.phase));
    bytes.extend_from_slice(bytemuck::cast_slice(&ray.map(|vector| vector.to_array())));
    bytes
}

/// A phase function as shaders read it, without its table.
pub fn phase(phase: &Phase) -> Vec<u8> {
    bytemuck::bytes_of(&layout::Phase::from(phase)).to_vec()
}

/// A light as shaders read it.
pub fn light(light: &Light) -> layout::Light {
    let floats = |vector: glam::DVec3| vector.as_vec3().to_array();
    match *light {
        Light::Point { position, intensity, radius } => layout::Light {
            position: floats(position),
            intensity: floats(intensity),
            radius: radius as f32,
            ..Default::default()
        },
        Light::Spot { position, intensity, radius, direction, exponent, cutoff } => layout::Light {
            position: floats(position),
            kind: 1,
            intensity: floats(intensity),
            radius: radius as f32,
            direction: floats(direction),
            exponent: exponent as f32,
            cos_cutoff: cutoff.to_radians().cos() as f32,
            sin_cutoff: cutoff.to_radians().sin() as f32,
            ..Default::default()
        },
        Light::Directional { direction, irradiance } => {
            layout::Light { kind: 2, intensity: floats(irradiance), direction: floats(direction), ..Default::default() }
        }
    }
}
