//! What must hold of airlight whatever the numbers: additivity, linearity, limits.

use glam::DVec3;
use tyndall_shaders::airlight::airlight;
use tyndall_shaders::lights::incident;
use tyndall_shaders::medium::transmittance;
use tyndall_shaders::phase::phase;
use tyndall_shaders::quadrature::integrate;
use tyndall_shaders::ray::Ray;
use tyndall_shaders::scene::{Light, Medium, Phase};

const G: Phase = Phase::HenyeyGreenstein { g: 0.7 };

fn ray() -> Ray {
    Ray { origin: DVec3::new(0.0, 1.5, 0.0), direction: DVec3::new(0.1, 0.05, -1.0).normalize() }
}

fn medium(phase: Phase) -> Medium {
    Medium { extinction: DVec3::new(0.02, 0.1, 0.5), albedo: DVec3::new(1.0, 0.8, 0.5), phase }
}

fn point() -> Light {
    Light::Point { position: DVec3::new(1.0, 2.5, -8.0), intensity: DVec3::new(3.0, 2.0, 1.0), radius: 0.0 }
}

fn spot(exponent: f64, cutoff: f64) -> Light {
    let direction = DVec3::new(-0.3, -0.8, 0.2).normalize();
    Light::Spot {
        position: DVec3::new(1.0, 2.5, -8.0),
        intensity: DVec3::new(3.0, 2.0, 1.0),
        radius: 0.0,
        direction,
        exponent,
        cutoff,
    }
}

fn sun() -> Light {
    Light::Directional { direction: DVec3::new(0.2, -0.9, 0.3).normalize(), irradiance: DVec3::ONE }
}

fn close(a: DVec3, b: DVec3, tolerance: f64) -> bool {
    (a - b).abs().cmple(tolerance * b.abs()).all()
}

#[test]
fn parts_of_a_ray_add_up() {
    for light in [point(), spot(4.0, 40.0), spot(0.0, 150.0), sun()] {
        let part = |near, far| airlight(&light, &medium(G), &ray(), near, far);
        let whole = part(0.0, f64::INFINITY);
        let sum = part(0.0, 5.0) + part(5.0, 8.1) + part(8.1, 30.0) + part(30.0, f64::INFINITY);
        assert!(whole.min_element() > 0.0 && close(sum, whole, 1e-9), "{light:?}: {sum} and {whole}");
    }
}

#[test]
fn airlight_is_linear_in_intensity() {
    let brighter = Light::Point { position: DVec3::new(1.0, 2.5, -8.0), intensity: DVec3::splat(6.0), radius: 0.0 };
    let ratio = DVec3::new(2.0, 3.0, 6.0);
    let one = airlight(&point(), &medium(G), &ray(), 0.0, 20.0);
    assert!(close(airlight(&brighter, &medium(G), &ray(), 0.0, 20.0), one * ratio, 1e-12));
}

/// In ever thinner media, airlight divided by σ_s is the integral of p·I/r².
#[test]
fn a_thin_medium_only_scatters() {
    let thin = Medium { extinction: DVec3::splat(1e-9), ..medium(G) };
    let per_scattering = airlight(&point(), &thin, &ray(), 0.0, 20.0) / (thin.albedo * thin.extinction);
    let Light::Point { position, intensity, .. } = point() else { unreachable!("it is a point light") };
    let density = |x: f64| {
        let away = ray().at(x) - position;
        let mu = away.normalize().dot(-ray().direction);
        phase(&G, (1.0 - mu) / 2.0) / away.length_squared()
    };
    let expected = intensity * integrate(density, 0.0, 20.0, 1e-12);
    assert!(close(per_scattering, expected, 1e-6));
    let none = Medium { extinction: DVec3::ZERO, ..medium(G) };
    for light in [point(), spot(4.0, 40.0), sun()] {
        assert_eq!(airlight(&light, &none, &ray(), 0.0, f64::INFINITY), DVec3::ZERO);
    }
}

/// The definition of single scattering, point by point along the ray, gives the same.
#[test]
fn airlight_is_what_the_definition_says() {
    for light in [point(), spot(8.0, 60.0)] {
        let channel = |i: usize| {
            let at = |x: f64| {
                let incident = incident(&light, ray().at(x));
                let w = (1.0 - incident.to_light.dot(ray().direction)) / 2.0;
                let left = transmittance(&medium(G), x + incident.way);
                incident.irradiance[i] * phase(&G, w) * left[i]
            };
            medium(G).albedo[i] * medium(G).extinction[i] * integrate(at, 0.0, 40.0, 1e-11)
        };
        let expected = DVec3::new(channel(0), channel(1), channel(2));
        let value = airlight(&light, &medium(G), &ray(), 0.0, 40.0);
        assert!(close(value, expected, 1e-6), "{light:?}: {value} instead of {expected}");
    }
}

#[test]
fn phase_functions_meet_at_their_limits() {
    let of = |phase| airlight(&point(), &medium(phase), &ray(), 0.0, f64::INFINITY);
    assert!(close(of(Phase::HenyeyGreenstein { g: 1e-12 }), of(Phase::Isotropic), 1e-9));
    assert!(close(of(Phase::Schlick { k: 1e-12 }), of(Phase::Isotropic), 1e-9));
    assert!(close(of(Phase::CornetteShanks { g: 1e-12 }), of(Phase::Rayleigh), 1e-9));
    assert!(close(of(Phase::DoubleHenyeyGreenstein { g1: 0.7, g2: -0.4, f: 0.0 }), of(G), 1e-12));
}

/// A spot with N = 0 and a cutoff of nearly 180° is a point light; what one cutoff leaves out the rest of the cone has.
#[test]
fn spots_fill_the_sphere() {
    let of = |light| airlight(&light, &medium(G), &ray(), 0.0, f64::INFINITY);
    assert!(close(of(spot(0.0, 180.0)), of(point()), 1e-9));
    let Light::Spot { position, intensity, radius, direction, exponent, .. } = spot(0.0, 60.0) else {
        unreachable!("it is a spot")
    };
    let rest = Light::Spot { position, intensity, radius, direction: -direction, exponent, cutoff: 120.0 };
    assert!(close(of(spot(0.0, 60.0)) + of(rest), of(point()), 1e-9));
}

#[test]
fn a_ray_through_the_light_is_finite() {
    let through = Ray { origin: DVec3::ZERO, direction: DVec3::X };
    let light = |radius| Light::Point { position: DVec3::new(4.0, 0.0, 0.0), intensity: DVec3::ONE, radius };
    let of = |radius| airlight(&light(radius), &medium(G), &through, 0.0, f64::INFINITY).x;
    // like 1/h: h is floored at 1e-6 of 4 m, or at the radius
    assert!(of(0.0).is_finite() && (of(0.0) / of(0.004) / 1000.0 - 1.0).abs() < 0.01);
}
