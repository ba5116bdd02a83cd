//! The twins against numbers that were computed outside the project (NumPy, SciPy, mpmath) in double precision.

use glam::DVec3;
use serde_json::Value;
use tyndall_shaders::airlight::airlight;
use tyndall_shaders::phase::phase;
use tyndall_shaders::ray::Ray;
use tyndall_shaders::scene::{Light, Medium, Phase};

fn data() -> Value {
    serde_json::from_str(include_str!("data/airlight.json")).expect("the file is JSON")
}

fn list<'a>(data: &'a Value, name: &str) -> &'a Vec<Value> {
    data[name].as_array().expect("a list")
}

fn vector(value: &Value) -> DVec3 {
    DVec3::from_array([0, 1, 2].map(|i| value[i].as_f64().expect("a number")))
}

fn number(value: &Value) -> f64 {
    value.as_f64().expect("a number")
}

fn phase_of(value: &Value) -> Phase {
    let parameter = |name: &str| number(&value[name]);
    match value["type"].as_str().expect("a kind") {
        "isotropic" => Phase::Isotropic,
        "hg" => Phase::HenyeyGreenstein { g: parameter("g") },
        "double_hg" => Phase::DoubleHenyeyGreenstein { g1: parameter("g1"), g2: parameter("g2"), f: parameter("f") },
        "schlick" => Phase::Schlick { k: parameter("k") },
        "rayleigh" => Phase::Rayleigh,
        "cornette_shanks" => Phase::CornetteShanks { g: parameter("g") },
        kind => panic!("unknown phase function {kind}"),
    }
}

fn medium_of(case: &Value) -> Medium {
    Medium {
        extinction: DVec3::splat(number(&case["sigma_t"])),
        albedo: DVec3::splat(number(&case["albedo"])),
        phase: phase_of(&case["phase"]),
    }
}

fn airlight_of(case: &Value, light: &Light) -> f64 {
    let ray = Ray { origin: vector(&case["origin"]), direction: vector(&case["dir"]) };
    let end = case["segment"][1].as_f64().unwrap_or(f64::INFINITY);
    airlight(light, &medium_of(case), &ray, number(&case["segment"][0]), end).x
}

/// Compares, and says how many cases were not 0.
fn compare(cases: &[Value], light_of: impl Fn(&Value) -> Light) -> usize {
    let mut lit = 0;
    for case in cases {
        let expected = number(&case["L"]);
        let value = airlight_of(case, &light_of(case));
        assert!((value - expected).abs() <= 1e-9 * expected, "{case}: {value:e} instead of {expected:e}");
        lit += usize::from(expected > 0.0);
    }
    lit
}

#[test]
fn airlight_of_point_lights_and_spots() {
    let lit = compare(list(&data(), "point_and_spot"), |case| {
        let (position, intensity, radius) = (vector(&case["position"]), DVec3::ONE, 0.0);
        match case.get("axis") {
            None => Light::Point { position, intensity, radius },
            Some(axis) => Light::Spot {
                position,
                intensity,
                radius,
                direction: vector(axis).normalize(),
                exponent: number(&case["N"]),
                cutoff: number(&case["cutoff"]),
            },
        }
    });
    assert!(lit > 200);
}

#[test]
fn airlight_of_directional_lights() {
    let lit = compare(list(&data(), "directional"), |case| Light::Directional {
        direction: -vector(&case["toward_sun"]),
        irradiance: DVec3::ONE,
    });
    assert!(lit > 40);
}

#[test]
fn phase_functions() {
    let data = data();
    assert_eq!(list(&data, "phase").len(), 8);
    for case in list(&data, "phase") {
        for pair in case["values"].as_array().expect("a list") {
            let (mu, expected) = (number(&pair[0]), number(&pair[1]));
            let value = phase(&phase_of(&case["phase"]), (1.0 - mu) / 2.0);
            assert!((value / expected - 1.0).abs() < 1e-12, "{case}: {value} instead of {expected} at {mu}");
        }
    }
}
