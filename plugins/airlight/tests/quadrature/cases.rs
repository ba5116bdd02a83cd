//! Random rays, lights and media, the same in every run.

use std::f64::consts::PI;

use glam::DVec3;
use tyndall_shaders::phase::PhaseTable;
use tyndall_shaders::ray::Ray;
use tyndall_shaders::scene::{Light, Medium, Phase};

/// A ray of its own light through its own medium; every number is one that f32 holds.
#[derive(Debug, Clone, Copy)]
pub struct Case {
    pub light: Light,
    pub medium: Medium,
    pub ray: Ray,
    /// Metres, or infinite.
    pub way: f64,
}

#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Kind {
    Isotropic,
    HenyeyGreenstein,
    DoubleHenyeyGreenstein,
    Schlick,
    Rayleigh,
    CornetteShanks,
    /// Diameters from 5 to 50 µm.
    Droplets,
    /// Mie's function of a fog, as shipped.
    Measured,
    /// The same with spots as [`Kind::Spot`].
    MeasuredSpot,
    /// Cutoff from 5° to 90°, exponent to 64.
    Spot,
    /// Cutoff from 90° to 175°, exponent to 64.
    WideSpot,
}

/// xorshift64 (Marsaglia 2003).
pub struct Random(u64);

impl Random {
    /// The same numbers in every run.
    pub fn new() -> Self {
        Self(0x9e37_79b9_7f4a_7c15)
    }

    fn next(&mut self) -> f64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        (self.0 >> 11) as f64 / (1u64 << 53) as f64
    }

    pub fn within(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.next()
    }

    /// A power of ten.
    pub fn magnitude(&mut self, low: f64, high: f64) -> f64 {
        10f64.powf(self.within(low, high))
    }

    pub fn direction(&mut self) -> DVec3 {
        let z = self.within(-1.0, 1.0);
        let angle = self.within(0.0, 2.0 * PI);
        let side = (1.0 - z * z).sqrt();
        DVec3::new(side * angle.cos(), side * angle.sin(), z)
    }
}

fn rounded(value: f64) -> f64 {
    f64::from(value as f32)
}

fn rounded_vector(value: DVec3) -> DVec3 {
    value.as_vec3().as_dvec3()
}

/// `count` cases; `depth` is the largest optical depth of the light's distance.
pub fn random(count: usize, kind: Kind, depth: f64) -> Vec<Case> {
    let mut random = Random::new();
    (0..count).map(|_| case(&mut random, kind, depth)).collect()
}

fn case(random: &mut Random, kind: Kind, depth: f64) -> Case {
    let distance = random.magnitude(-1.0, 2.0);
    let extinction = depth * random.magnitude(-3.0, 0.0) / distance;
    let channels = DVec3::new(1.0, random.within(0.3, 1.0), random.within(0.3, 1.0));
    let medium =
        Medium { extinction: rounded_vector(extinction * channels), albedo: DVec3::ONE, phase: phase(random, kind) };

    let to_light = random.direction();
    let side = to_light.cross(random.direction()).normalize();
    let angle = match random.next() {
        toward if toward < 0.4 => random.magnitude(-4.0, 0.0),
        away if away < 0.55 => PI - random.magnitude(-4.0, 0.0),
        _ => random.within(1e-4, PI - 1e-4),
    };
    let direction = rounded_vector(to_light * angle.cos() + side * angle.sin());
    let position = rounded_vector(distance * to_light);
    let foot = position.dot(direction);
    let way = match random.next() {
        endless if endless < 0.3 => f64::INFINITY,
        across if across < 0.6 => distance * random.within(0.01, 3.0),
        before if before < 0.8 => (foot.abs() + 0.01 * distance) * random.within(0.3, 0.999),
        _ => distance * random.magnitude(-2.0, 1.5),
    };
    let intensity = DVec3::ONE;
    let light = match kind {
        Kind::Spot | Kind::WideSpot | Kind::MeasuredSpot => {
            let aim = direction * (foot + distance * random.within(-2.0, 2.0))
                + random.direction() * distance * random.within(0.0, 0.5);
            let aimed = if random.next() < 0.2 { random.direction() } else { (aim - position).normalize() };
            let cutoff = if kind == Kind::WideSpot { random.within(90.0, 175.0) } else { random.within(5.0, 90.0) };
            let exponent = if random.next() < 0.2 { 0.0 } else { rounded(64f64.powf(random.next())) };
            // the shader holds the cosine
            let cutoff = rounded(cutoff.to_radians().cos()).acos().to_degrees();
            Light::Spot { position, intensity, radius: 0.0, direction: rounded_vector(aimed), exponent, cutoff }
        }
        _ => Light::Point { position, intensity, radius: 0.0 },
    };
    Case { light, medium, ray: Ray { origin: DVec3::ZERO, direction }, way: rounded(way) }
}

/// g from −0.5 to 0.99, half of them evenly, half of them crowding at 0.99.
fn phase(random: &mut Random, kind: Kind) -> Phase {
    let even = random.next() < 0.5;
    let g = rounded(if even { random.within(-0.5, 0.99) } else { 1.0 - random.magnitude(-2.0, 0.17) });
    match kind {
        Kind::Isotropic => Phase::Isotropic,
        Kind::Rayleigh => Phase::Rayleigh,
        Kind::Schlick => Phase::Schlick { k: g },
        Kind::CornetteShanks => Phase::CornetteShanks { g },
        Kind::DoubleHenyeyGreenstein => {
            let g2 = rounded(random.within(-0.5, 0.5));
            Phase::DoubleHenyeyGreenstein { g1: g, g2, f: rounded(random.next()) }
        }
        Kind::Droplets => Phase::Droplets { diameter: rounded(random.within(5.0, 50.0)) },
        Kind::Measured | Kind::MeasuredSpot => fog(),
        Kind::HenyeyGreenstein | Kind::Spot | Kind::WideSpot => Phase::HenyeyGreenstein { g },
    }
}

/// The measured phase function that is shipped as an example.
pub fn fog() -> Phase {
    let text = include_str!("../../../../graphs/scenes/phase/fog_20um.phase.txt");
    let row = |line: &str| {
        let (angle, value) = line.split_once(' ').unwrap();
        (angle.parse().unwrap(), value.parse().unwrap())
    };
    let rows: Vec<(f64, f64)> = text.lines().filter(|line| !line.starts_with('#')).map(row).collect();
    Phase::Measured(PhaseTable::new(&rows).unwrap())
}
