//! `shaders/height_fog.wgsl` on a GPU against its twin: rays, lights and fogs at random.

use glam::DVec3;
use tyndall_probe::Probe;
use tyndall_scene::layout;
use tyndall_shaders::height_fog::airlight;
use tyndall_shaders::scene::{HeightFog, Light};

use crate::Errors;
use crate::cases::{Case, Kind, Random, random};
use crate::on_gpu;

const SHADER: &str = "
#import scene
#import ray
#import height_fog

override nodes: u32 = 12;

struct Case {
    light: Light,
    medium: Medium,
    phase: Phase,
    origin: vec3<f32>,
    way: f32,
    direction: vec3<f32>,
    attenuated_sun: f32,
    fog: HeightFog,
}

var<storage, read> cases: array<Case>;
var<storage, read_write> results: array<vec4<f32>>;

@compute @workgroup_size(64)
fn main(@builtin(global_invocation_id) id: vec3<u32>) {
    if id.x >= arrayLength(&cases) {
        return;
    }
    let c = cases[id.x];
    let ray = Ray(c.origin, c.direction);
    var sum = vec3<f32>(0.0);
    var cursor = HeightCursor(0u, 0u, 0.0, 0.0);
    loop {
        let piece = height_airlight(cursor, c.light, c.medium, c.fog, c.phase, ray, c.way, c.attenuated_sun > 0.0, nodes);
        sum += piece.radiance;
        cursor = piece.next;
        if cursor.light >= 1u { break; }
    }
    results[id.x] = vec4<f32>(sum, 1.0);
}
";

/// A case in fog; `attenuated_sun` counts for directional lights only.
#[derive(Debug, Clone, Copy)]
struct Foggy {
    case: Case,
    fog: HeightFog,
    attenuated_sun: bool,
}

impl Foggy {
    fn bytes(&self) -> Vec<u8> {
        let case = &self.case;
        let sun = f32::from(u8::from(self.attenuated_sun));
        let ray = [case.ray.origin.as_vec3().extend(case.way as f32), case.ray.direction.as_vec3().extend(sun)];
        let (base_height, falloff) = (self.fog.base_height as f32, self.fog.falloff as f32);
        let mut bytes = bytemuck::bytes_of(&on_gpu::light(&case.light)).to_vec();
        bytes.extend_from_slice(bytemuck::bytes_of(&layout::Medium::from(&case.medium)));
        bytes.extend_from_slice(&on_gpu::phase(&case.medium.phase));
        bytes.extend_from_slice(bytemuck::cast_slice(&ray.map(|vector| vector.to_array())));
        bytes.extend_from_slice(bytemuck::bytes_of(&layout::HeightFog { base_height, falloff, ..Default::default() }));
        bytes
    }

    fn expected(&self) -> DVec3 {
        let Case { light, medium, ray, way } = &self.case;
        airlight(light, medium, &self.fog, ray, *way, self.attenuated_sun)
    }
}

fn errors(cases: &[Foggy], nodes: u32) -> Errors {
    let probe = Probe::new(SHADER, &[], &[("nodes", f64::from(nodes))]);
    let bytes: Vec<u8> = cases.iter().flat_map(Foggy::bytes).collect();
    let found = probe.run(&bytes, cases.len());
    let error =
        |(case, found): (&Foggy, [f32; 4])| crate::error_of(case, [found[0], found[1], found[2]], case.expected());
    Errors::from(cases.iter().zip(found).filter_map(error).collect())
}

/// Scale heights from 0.3 to 30 times the distance of the light, the eye from two of them below the base to three above.
fn foggy(count: usize, kind: Kind) -> Vec<Foggy> {
    let mut fogs = Random::new();
    let cases = random(count, kind, 4.0).into_iter();
    cases
        .map(|case| {
            let (Light::Point { position, .. } | Light::Spot { position, .. }) = case.light else {
                unreachable!("cases have no other lights")
            };
            let scale_height = position.length() * fogs.magnitude(-0.5, 1.5);
            let falloff = f64::from((1.0 / scale_height) as f32);
            let base_height = f64::from((scale_height * fogs.within(-3.0, 2.0)) as f32);
            Foggy { case, fog: HeightFog { base_height, falloff }, attenuated_sun: false }
        })
        .collect()
}

/// Measured are the figures of the README.
#[test]
fn lights_in_height_fog() {
    errors(&foggy(300, Kind::HenyeyGreenstein), 12).expect("height fog, HG", 200, 3e-3, 2e-2);
    errors(&foggy(90, Kind::DoubleHenyeyGreenstein), 12).expect("height fog, double HG", 60, 3e-3, 2e-2);
    errors(&foggy(200, Kind::Spot), 12).expect("height fog, spots", 60, 5e-3, 3e-2);
    errors(&foggy(90, Kind::HenyeyGreenstein), 16).expect("height fog, 16 nodes", 60, 2e-3, 1e-2);
}

/// In closed form, whether the fog takes of the light on its way down or not.
#[test]
fn the_sun_in_height_fog() {
    let mut directions = Random::new();
    let mut cases = foggy(800, Kind::HenyeyGreenstein);
    for (i, foggy) in cases.iter_mut().enumerate() {
        let mut direction = directions.direction();
        direction.y = -direction.y.abs().max(0.02);
        let direction = direction.normalize().as_vec3().as_dvec3();
        foggy.case.light = Light::Directional { direction, irradiance: DVec3::new(3.0, 2.0, 1.0) };
        foggy.attenuated_sun = i % 2 == 0;
    }
    errors(&cases, 12).expect("height fog, sun", 600, 1e-4, 2e-3);
}

/// A scale height beyond all bounds is the homogeneous medium, light by light.
#[test]
fn without_falloff_it_is_homogeneous() {
    let cases = random(600, Kind::HenyeyGreenstein, 4.0);
    let foggy: Vec<Foggy> =
        cases.iter().map(|&case| Foggy { case, fog: HeightFog::NONE, attenuated_sun: false }).collect();
    let probe = Probe::new(SHADER, &[], &[("nodes", 12.0)]);
    let bytes: Vec<u8> = foggy.iter().flat_map(Foggy::bytes).collect();
    let found = probe.run(&bytes, cases.len());
    let plain = on_gpu::airlight(&cases, 12);
    let error = |(found, plain): (&[f32; 4], &[f32; 3])| {
        let channel = |i: usize| if plain[i] > 1e-28 { (f64::from(found[i] / plain[i]) - 1.0).abs() } else { 0.0 };
        channel(0).max(channel(1)).max(channel(2))
    };
    Errors::from(found.iter().zip(&plain).map(error).collect()).expect("no falloff", 600, 2e-3, 4e-3);
}
