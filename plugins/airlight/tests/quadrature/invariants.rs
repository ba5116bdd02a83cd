//! What must hold of airlight on the GPU whatever the numbers, without another computation to compare with: turned scenes,
//! scaled scenes, brighter lights, rays in two parts.

use glam::DVec3;
use tyndall_shaders::medium::transmittance;
use tyndall_shaders::ray::Ray;
use tyndall_shaders::scene::{Light, Medium};

use crate::NODES;
use crate::cases::{Case, Kind, Random, random};
use crate::on_gpu;

const KINDS: [Kind; 4] = [Kind::HenyeyGreenstein, Kind::CornetteShanks, Kind::Spot, Kind::WideSpot];

/// The lights and rays of a case in other coordinates.
fn moved(case: &Case, place: impl Fn(DVec3) -> DVec3, turn: impl Fn(DVec3) -> DVec3) -> Case {
    let light = match case.light {
        Light::Point { position, intensity, radius } => Light::Point { position: place(position), intensity, radius },
        Light::Spot { position, intensity, radius, direction, exponent, cutoff } => {
            Light::Spot { position: place(position), direction: turn(direction), intensity, radius, exponent, cutoff }
        }
        Light::Directional { direction, irradiance } => Light::Directional { direction: turn(direction), irradiance },
    };
    let ray = Ray { origin: place(case.ray.origin), direction: turn(case.ray.direction) };
    Case { light, ray, ..*case }
}

/// The largest relative difference of what both sides say, in parts of the brightest channel. Of each case, where there is
/// light.
fn differences(found: &[DVec3], expected: &[DVec3]) -> Vec<f64> {
    let one = |(found, expected): (&DVec3, &DVec3)| {
        let brightest = expected.max_element();
        (brightest > 1e-25).then(|| (found - expected).abs().max_element() / brightest)
    };
    let mut all: Vec<f64> = found.iter().zip(expected).filter_map(one).collect();
    all.sort_by(f64::total_cmp);
    all
}

fn expect(what: &str, differences: &[f64], p99: f64, worst: f64) {
    let at = |share: f64| differences[((differences.len() - 1) as f64 * share) as usize];
    let text =
        format!("{what}: {} cases, p50 {:.1e}, p99 {:.1e}, max {:.1e}", differences.len(), at(0.5), at(0.99), at(1.0));
    println!("{text}");
    assert!(differences.len() >= 400 && at(0.99) <= p99 && at(1.0) <= worst, "{text}");
}

fn airlight(cases: &[Case]) -> Vec<DVec3> {
    on_gpu::airlight(cases, NODES).into_iter().map(|found| DVec3::from_array(found.map(f64::from))).collect()
}

/// Axes that change places are a rotation which f32 holds exactly.
#[test]
fn turning_the_scene_changes_nothing() {
    for kind in KINDS {
        let cases = random(1000, kind, 15.0);
        let turn = |v: DVec3| DVec3::new(v.y, v.z, v.x);
        let turned: Vec<Case> = cases.iter().map(|case| moved(case, turn, turn)).collect();
        expect(&format!("{kind:?} turned"), &differences(&airlight(&turned), &airlight(&cases)), 2e-5, 2e-4);
    }
}

/// Metres 64 times as long and an extinction 64 times as thin: L is as I/m².
#[test]
fn scaling_the_scene_scales_airlight() {
    const SCALE: f64 = 64.0;
    for kind in KINDS {
        let cases = random(1000, kind, 15.0);
        let scaled = cases.iter().map(|case| {
            let larger = moved(case, |place| SCALE * place, |way| way);
            let medium = Medium { extinction: case.medium.extinction / SCALE, ..case.medium };
            Case { medium, way: SCALE * case.way, ..larger }
        });
        let found: Vec<DVec3> = airlight(&scaled.collect::<Vec<_>>()).iter().map(|l| SCALE * SCALE * l).collect();
        expect(&format!("{kind:?} scaled"), &differences(&found, &airlight(&cases)), 0.0, 1e-6);
    }
}

#[test]
fn light_is_linear_in_intensity() {
    let cases = random(1000, Kind::Spot, 15.0);
    let brighter: Vec<Case> = cases
        .iter()
        .map(|case| {
            let mut case = *case;
            if let Light::Spot { intensity, .. } = &mut case.light {
                *intensity = DVec3::new(3.0, 0.25, 0.0);
            }
            case
        })
        .collect();
    let expected: Vec<DVec3> = airlight(&cases).iter().map(|l| *l * DVec3::new(3.0, 0.25, 0.0)).collect();
    expect("brighter", &differences(&airlight(&brighter), &expected), 1e-6, 1e-6);
}

/// The near part, and the far part seen from where the near one ends, through the near one.
#[test]
fn parts_of_a_ray_add_up() {
    for kind in KINDS {
        let mut numbers = Random::new();
        let whole: Vec<Case> = random(1000, kind, 6.0);
        let cuts: Vec<f64> =
            whole.iter().map(|case| numbers.within(0.1, 0.9) * case.way.min(length_of(&case.light))).collect();
        let near: Vec<Case> = whole.iter().zip(&cuts).map(|(case, cut)| Case { way: *cut, ..*case }).collect();
        let far: Vec<Case> = whole.iter().zip(&cuts).map(|(case, cut)| beyond(case, *cut)).collect();
        let through = whole.iter().zip(&cuts).map(|(case, cut)| transmittance(&case.medium, *cut));
        let parts = airlight(&near).into_iter().zip(airlight(&far)).zip(through);
        let sum: Vec<DVec3> = parts.map(|((near, far), through)| near + through * far).collect();
        expect(&format!("{kind:?} in parts"), &differences(&sum, &airlight(&whole)), 1.5e-3, 5e-3);
    }
}

fn length_of(light: &Light) -> f64 {
    match light {
        Light::Point { position, .. } | Light::Spot { position, .. } => position.length(),
        Light::Directional { .. } => 1.0,
    }
}

/// What is left of a ray beyond a cut, with the eye where it is: f32 holds places near the origin best.
fn beyond(case: &Case, cut: f64) -> Case {
    let eye = case.ray.at(cut);
    Case {
        way: case.way - cut,
        ..moved(case, |place| if place == case.ray.origin { place } else { place - eye }, |way| way)
    }
}
