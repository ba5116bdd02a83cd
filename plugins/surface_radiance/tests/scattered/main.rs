//! Scattered light on surfaces, from the tables as a graph makes them on a GPU, against brute force in double precision.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]
#![allow(clippy::print_stdout, reason = "the measured errors, which the README quotes")]

mod desk;

use std::f64::consts::PI;

use desk::{ANGLES, Desk, LIGHTS, angle};
use glam::DVec3;
use rayon::prelude::*;
use tyndall_shaders::phase::phase;
use tyndall_shaders::reflection::{Field, LobeOverCircles, Surface, scattered_from_all_around};
use tyndall_shaders::scene::{Light, Medium, Phase};

/// With Lambert's first.
const SHININESSES: [f64; 8] = [1.0, 1.0, 5.0, 20.0, 50.0, 200.0, 1000.0, 20_000.0];

const PHASES: [(&str, Phase); 10] = [
    ("HenyeyGreenstein(g: 0.9)", Phase::HenyeyGreenstein { g: 0.9 }),
    ("HenyeyGreenstein(g: 0.75)", Phase::HenyeyGreenstein { g: 0.75 }),
    ("HenyeyGreenstein(g: 0.5)", Phase::HenyeyGreenstein { g: 0.5 }),
    ("HenyeyGreenstein(g: 0.0)", Phase::HenyeyGreenstein { g: 0.0 }),
    ("HenyeyGreenstein(g: -0.5)", Phase::HenyeyGreenstein { g: -0.5 }),
    (
        "DoubleHenyeyGreenstein(g1: 0.85, g2: -0.3, f: 0.2)",
        Phase::DoubleHenyeyGreenstein { g1: 0.85, g2: -0.3, f: 0.2 },
    ),
    ("Schlick(k: 0.8)", Phase::Schlick { k: 0.8 }),
    ("CornetteShanks(g: 0.6)", Phase::CornetteShanks { g: 0.6 }),
    ("Rayleigh", Phase::Rayleigh),
    ("Isotropic", Phase::Isotropic),
];

/// 1/m, of the three channels; what f32 holds.
const EXTINCTION: [f64; 3] = [0.0625, 0.03125, 0.09375];
const ALBEDO: [f64; 3] = [0.75, 1.0, 0.5];

/// Distances, m, for optical depths from 1e-3 to 10 in each channel; the last light is a directional one.
fn distances() -> Vec<f64> {
    (0..LIGHTS - 1)
        .map(|i| f64::from((1e-3f64 / 0.03125 * 10f64.powf(4.0 * i as f64 / (LIGHTS - 2) as f64)) as f32))
        .collect()
}

fn lights() -> String {
    let points =
        distances().into_iter().map(|d| format!("Point(position: (0.0, {d}, 0.0), intensity: (1.0, 1.0, 1.0)),"));
    let sun = "Directional(direction: (0.0, -1.0, 0.0), irradiance: (1.0, 1.0, 1.0)),".to_owned();
    points.chain([sun]).collect()
}

fn materials() -> String {
    SHININESSES[1..]
        .iter()
        .map(|n| format!("(mesh: Plane(size: (1.0, 1.0)), material: (specular: (1.0, 1.0, 1.0), shininess: {n:?})),"))
        .collect()
}

fn medium() -> String {
    format!("extinction: {}, albedo: {}", vector(EXTINCTION), vector(ALBEDO))
}

fn vector([x, y, z]: [f64; 3]) -> String {
    format!("({x}, {y}, {z})")
}

/// What is around the surface, per light and channel, and what it is to be multiplied by.
fn fields(kind: &Phase) -> Vec<[(Field, f64); 3]> {
    let around = |d: f64| [0, 1, 2].map(|i| (Field::of_point(kind, EXTINCTION[i] * d), ALBEDO[i] * EXTINCTION[i] / d));
    let sun = ALBEDO.map(|albedo| (Field::of_sun(kind), albedo));
    let mut fields: Vec<_> = distances().into_par_iter().map(around).collect();
    fields.push(sun);
    fields
}

/// What reaches a surface with a lobe of factor 1, per light, channel and angle.
fn truth(fields: &[[(Field, f64); 3]], lobe: &[LobeOverCircles]) -> Vec<[Vec<f64>; 3]> {
    let over = |(field, factor): &(Field, f64)| lobe.iter().map(|at| factor * field.over(at)).collect();
    fields.iter().map(|channels| channels.each_ref().map(over)).collect()
}

/// The largest error of each light and channel, over the largest value of all angles.
fn worst(found: &[Vec<[f64; 3]>], truth: &[[Vec<f64>; 3]]) -> f64 {
    let mut worst = 0.0_f64;
    for (light, expected) in truth.iter().enumerate() {
        for (channel, expected) in expected.iter().enumerate() {
            let peak = expected.iter().copied().fold(0.0, f64::max);
            for (angle, expected) in expected.iter().enumerate() {
                let value = found[light][angle][channel];
                assert!(value.is_finite() && value >= 0.0, "{value} of light {light} at angle {angle}");
                worst = worst.max((value - expected).abs() / peak);
            }
        }
    }
    worst
}

/// The project's promise is 1 % of the peak for Lambert and 2 % for Phong; half of that is asked here.
#[test]
fn lambert_and_phong_for_every_phase_function() {
    let desk = Desk::new(&SHININESSES);
    // brute force takes its time: the lobes beside one another, and once for all fields
    let lobe_at_angles = |n: &f64| (0..ANGLES).map(|j| LobeOverCircles::new(*n, angle(j))).collect::<Vec<_>>();
    let lobes: Vec<_> = SHININESSES.par_iter().map(lobe_at_angles).collect();
    for (text, kind) in &PHASES {
        let pictures = desk.draw(&lights(), &materials(), &format!("{}, phase: {text}", medium()));
        let fields = fields(kind);
        let error_of = |lobe: usize| {
            let mut expected = truth(&fields, &lobes[lobe]);
            if lobe == 0 {
                expected.iter_mut().flatten().flatten().for_each(|value| *value /= PI);
            }
            worst(&pictures[lobe], &expected)
        };
        let errors: Vec<f64> = (0..SHININESSES.len()).into_par_iter().map(error_of).collect();
        let listed: Vec<String> = errors.iter().map(|error| format!("{error:.1e}")).collect();
        println!("{text}: Lambert and {:?}: {}", &SHININESSES[1..], listed.join(", "));
        assert!(errors[0] < 5e-3 && errors[1..].iter().all(|error| *error < 1e-2), "{text}: {errors:?}");
    }
}

/// Over all directions that a surface can have, it reflects ρ + 2π·k_s/(n + 1) of the mean radiance around it: no more
/// than comes in, where that is at most 1.
#[test]
fn energy_is_kept() {
    let desk = Desk::new(&SHININESSES);
    let kind = Phase::HenyeyGreenstein { g: 0.75 };
    let pictures = desk.draw(&lights(), &materials(), &format!("{}, phase: HenyeyGreenstein(g: 0.75)", medium()));
    for (i, d) in distances().into_iter().enumerate() {
        for channel in 0..3 {
            let incoming = Field::of_point(&kind, EXTINCTION[channel] * d).all_around() / (4.0 * PI);
            let incoming = incoming * ALBEDO[channel] * EXTINCTION[channel] / d;
            for (lobe, n) in SHININESSES.iter().enumerate().filter(|(_, n)| **n < 100.0) {
                // trapezoids over the angles, which crowd at the light
                let at = |j: usize| pictures[lobe][i][j][channel] * angle(j).sin() / 2.0;
                let mean: f64 = (1..ANGLES).map(|j| 0.5 * (at(j) + at(j - 1)) * (angle(j) - angle(j - 1))).sum();
                let share = if lobe == 0 { 1.0 } else { 2.0 * PI / (n + 1.0) };
                assert!(
                    (mean / (incoming * share) - 1.0).abs() < 0.02,
                    "n {n}, {d} m: {mean:e}, {incoming:e} times {share}"
                );
            }
        }
    }
}

/// Light that is twice as strong is reflected twice as strongly, and a scene ten times as large with a tenth of the
/// extinction by a tenth as much of σ_s/d each: only the optical depth counts.
#[test]
fn linear_in_intensity_and_the_same_at_every_scale() {
    let desk = Desk::new(&SHININESSES);
    let phase = "phase: HenyeyGreenstein(g: 0.5)";
    let one = desk.draw(&lights(), &materials(), &format!("{}, {phase}", medium()));
    let brighter = lights().replace("intensity: (1.0, 1.0, 1.0)", "intensity: (4.0, 4.0, 4.0)");
    let four = desk.draw(&brighter, &materials(), &format!("{}, {phase}", medium()));
    let larger: String = distances()
        .into_iter()
        .map(|d| format!("Point(position: ({}, 0.0, 0.0), intensity: (1.0, 1.0, 1.0)),", 8.0 * d))
        .chain(["Directional(direction: (-1.0, 0.0, 0.0), irradiance: (1.0, 1.0, 1.0)),".to_owned()])
        .collect();
    let thinner = format!("extinction: {}, albedo: {}, {phase}", vector(EXTINCTION.map(|s| s / 8.0)), vector(ALBEDO));
    let large = desk.draw(&larger, &materials(), &thinner);
    for lobe in 0..SHININESSES.len() {
        for light in 0..LIGHTS - 1 {
            for j in 0..ANGLES {
                for channel in 0..3 {
                    let of = |pictures: &desk::Pictures| pictures[lobe][light][j][channel];
                    assert_eq!(of(&four), 4.0 * of(&one));
                    assert!(
                        (64.0 * of(&large) - of(&one)).abs()
                            <= 1e-4 * of(&one) + 1e-6 * pictures_peak(&one[lobe][light], channel)
                    );
                }
            }
        }
    }
}

fn pictures_peak(angles: &[[f64; 3]], channel: usize) -> f64 {
    angles.iter().map(|value| value[channel]).fold(0.0, f64::max)
}

/// Outside of what tables hold: no light without extinction, less and less of it in ever thinner and ever thicker media.
#[test]
fn limits() {
    let desk = Desk::new(&SHININESSES);
    let of = |extinction: f64| {
        let medium = format!("extinction: ({extinction:?}, {extinction:?}, 0.0), phase: HenyeyGreenstein(g: 0.75)");
        desk.draw(&lights(), &materials(), &medium)
    };
    for (lobe, pictures) in of(0.0).iter().enumerate() {
        assert!(pictures.iter().flatten().flatten().all(|value| *value == 0.0), "lobe {lobe}");
    }
    // 1e-7 of an optical depth: in proportion to the density
    let (thin, thinner) = (of(1e-8), of(1e-9));
    let last = LIGHTS - 2;
    for lobe in 0..SHININESSES.len() {
        for j in 0..ANGLES {
            let (a, b) = (thin[lobe][last][j], thinner[lobe][last][j]);
            assert!((a[0] - 10.0 * b[0]).abs() <= 1e-3 * a[0] && a[2] == 0.0, "lobe {lobe}, {a:?}, {b:?}");
        }
    }
    let thick = of(1e3);
    assert!(thick.iter().flat_map(|lobe| &lobe[last]).flatten().all(|value| *value == 0.0), "e^-300000 is nothing");
}

/// Isotropic scattering of a directional light is the same from everywhere: albedo·E/4 of it on a white surface over π.
#[test]
fn a_sun_in_isotropic_haze_lights_all_sides_alike() {
    let desk = Desk::new(&SHININESSES);
    let pictures = desk.draw(&lights(), &materials(), &format!("{}, phase: Isotropic", medium()));
    let of_sun = &pictures[0][LIGHTS - 1];
    assert_eq!(of_sun.len(), ANGLES);
    for colour in of_sun {
        for (channel, value) in colour.iter().enumerate() {
            assert!((value / (ALBEDO[channel] * phase(&Phase::Isotropic, 0.5)) - 1.0).abs() < 5e-4, "{value}");
        }
    }
}

/// Spots whose axis goes past the surface by an angle: the error of the approximation, of the peak over all angles.
#[test]
fn spots() {
    let desk = Desk::new(&SHININESSES);
    let kind = Phase::HenyeyGreenstein { g: 0.5 };
    let [mut inside, mut outside] = [0.0_f64; 2];
    for (exponent, cutoff) in [(0.0, 90.0), (8.0, 30.0), (64.0, 90.0)] {
        // how far the axis is from the way to the surface, degrees
        for (past, d) in [(0.0, 4.0), (20.0, 4.0), (45.0, 4.0), (90.0, 4.0), (20.0, 40.0)] {
            let turned = |degrees: f64| DVec3::new(degrees.to_radians().sin(), -degrees.to_radians().cos(), 0.0);
            let direction = turned(past).as_vec3().as_dvec3();
            let light = Light::Spot {
                position: DVec3::new(0.0, d, 0.0),
                intensity: DVec3::ONE,
                radius: 0.0,
                direction,
                exponent,
                cutoff,
            };
            let text = format!(
                "Spot(position: (0.0, {d}, 0.0), direction: {}, intensity: (1.0, 1.0, 1.0), exponent: {exponent:?}, cutoff: {cutoff:?}),",
                vector(direction.to_array())
            );
            let found = desk.draw(
                &text.repeat(LIGHTS),
                &materials(),
                "extinction: (0.0625, 0.0625, 0.0625), phase: HenyeyGreenstein(g: 0.5)",
            );
            let medium = Medium { extinction: DVec3::splat(0.0625), albedo: DVec3::ONE, phase: kind };
            let mut errors = [0.0_f64; 2];
            for (term, lobe) in [(0, 0), (1, 3)] {
                let angles: Vec<usize> = (0..ANGLES).step_by(3).collect();
                let truth: Vec<f64> = angles
                    .par_iter()
                    .map(|j| {
                        let axis = desk::turned(DVec3::Y, angle(*j));
                        let (diffuse, specular) =
                            if term == 0 { (DVec3::X, DVec3::ZERO) } else { (DVec3::ZERO, DVec3::X) };
                        let surface = Surface {
                            position: DVec3::ZERO,
                            normal: axis,
                            mirrored: axis,
                            diffuse,
                            specular,
                            shininess: SHININESSES[lobe],
                        };
                        scattered_from_all_around(&light, &medium, &surface).x
                    })
                    .collect();
                let peak = truth.iter().copied().fold(0.0, f64::max);
                for (j, expected) in angles.iter().zip(&truth) {
                    errors[term] = errors[term].max((found[lobe][0][*j][0] - expected).abs() / peak);
                }
            }
            println!(
                "cos^{exponent} in {cutoff} degrees, {past} degrees past, {d} m: Lambert {:.3}, n = 20 {:.3}",
                errors[0], errors[1]
            );
            let worst = if past == 0.0 { &mut inside } else { &mut outside };
            *worst = worst.max(errors[0]).max(errors[1]);
        }
    }
    // on the axis the approximation holds; beside a beam the side that the light comes from is not known
    assert!(inside < 0.06 && outside < 0.65, "{inside}, {outside}");
}
