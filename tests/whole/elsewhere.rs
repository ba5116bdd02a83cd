//! A picture does not depend on where a scene stands, how it is turned, or in which unit it was measured: random scenes are
//! drawn as they are and moved, turned and scaled, and the two pictures must agree.

use glam::{DQuat, DVec3};
use tyndall_tests::broken::Random;
use tyndall_tests::{Desk, shipped};

/// With how far a pixel may be off, relative to its value and to a thousandth of the brightest: a point of the march that
/// lies on a shadow's edge is on one side or the other.
const GRAPHS: [(&str, f64); 4] =
    [("fog", 1e-4), ("volumetric-shadows", 1e-4), ("reference", 1e-2), ("modes/biri", 1e-4)];

/// Rounds of each graph; TYNDALL_ROUNDS asks for more.
const ROUNDS: usize = 3;

/// What part of the pixels may differ more: outlines and edges of shadows pass through centres of pixels, on one side or the
/// other.
const ON_EDGES: f64 = 0.03;

/// Where a scene is taken: each of its points p to `scale * rotation * p + offset`.
struct Elsewhere {
    scale: f64,
    rotation: DQuat,
    offset: DVec3,
}

impl Elsewhere {
    const HERE: Self = Self { scale: 1.0, rotation: DQuat::IDENTITY, offset: DVec3::ZERO };

    fn random(random: &mut Random) -> Self {
        let scale = 10_f64.powf(within(random, -6.0, 6.0));
        // ten million times the scene's own lengths
        let offset = scale * 10_f64.powf(within(random, 0.0, 7.0)) * direction(random);
        Self { scale, rotation: turned(random), offset }
    }

    fn place(&self, p: DVec3) -> String {
        written(self.scale * (self.rotation * p) + self.offset)
    }

    fn direction(&self, d: DVec3) -> String {
        written(self.rotation * d)
    }

    /// The rotation of an object that is turned by `own` where it stands.
    fn rotation(&self, own: DQuat) -> String {
        let (axis, angle) = (self.rotation * own).to_axis_angle();
        format!("(axis: {}, angle: {:?})", written(axis), angle.to_degrees())
    }
}

fn written(v: DVec3) -> String {
    format!("({:?}, {:?}, {:?})", v.x, v.y, v.z)
}

fn within(random: &mut Random, low: f64, high: f64) -> f64 {
    low + (high - low) * random.below(1 << 20) as f64 / f64::from(1 << 20)
}

fn inside(random: &mut Random, low: DVec3, high: DVec3) -> DVec3 {
    DVec3::new(within(random, low.x, high.x), within(random, low.y, high.y), within(random, low.z, high.z))
}

fn direction(random: &mut Random) -> DVec3 {
    inside(random, DVec3::splat(-1.0), DVec3::ONE).try_normalize().unwrap_or(DVec3::Y)
}

fn turned(random: &mut Random) -> DQuat {
    DQuat::from_axis_angle(direction(random), within(random, 0.0, 6.0))
}

enum Light {
    Point { position: DVec3, intensity: f64 },
    Spot { position: DVec3, direction: DVec3, intensity: f64, exponent: f64, cutoff: f64 },
    Directional { direction: DVec3, irradiance: f64 },
}

impl Light {
    fn random(random: &mut Random) -> Self {
        let position = inside(random, DVec3::new(-3.0, 1.5, -3.0), DVec3::new(3.0, 4.0, 3.0));
        match random.below(3) {
            0 => Self::Point { position, intensity: within(random, 5.0, 30.0) },
            1 => Self::Spot {
                position,
                direction: -position + direction(random),
                intensity: within(random, 5.0, 30.0),
                exponent: within(random, 0.0, 20.0),
                cutoff: within(random, 10.0, 80.0),
            },
            _ => Self::Directional {
                direction: direction(random) - DVec3::Y * 1.5,
                irradiance: within(random, 1.0, 5.0),
            },
        }
    }

    fn text(&self, to: &Elsewhere) -> String {
        let power = |of: f64| written(DVec3::new(1.0, 0.9, 0.7) * of);
        let intensity = |of: f64| power(of * to.scale * to.scale);
        match *self {
            Self::Point { position, intensity: of } => {
                format!("Point(position: {}, intensity: {})", to.place(position), intensity(of))
            }
            Self::Spot { position, direction, intensity: of, exponent, cutoff } => format!(
                "Spot(position: {}, direction: {}, intensity: {}, exponent: {exponent:?}, cutoff: {cutoff:?})",
                to.place(position),
                to.direction(direction),
                intensity(of)
            ),
            Self::Directional { direction, irradiance } => {
                format!("Directional(direction: {}, irradiance: {})", to.direction(direction), power(irradiance))
            }
        }
    }
}

struct Object {
    /// 0 a sphere, 1 a box, 2 a torus, 3 a plane.
    kind: usize,
    size: DVec3,
    position: DVec3,
    rotation: DQuat,
}

impl Object {
    fn random(random: &mut Random) -> Self {
        Self {
            kind: random.below(4),
            size: inside(random, DVec3::splat(0.3), DVec3::splat(1.5)),
            position: inside(random, DVec3::new(-2.0, 0.0, -2.0), DVec3::new(2.0, 1.5, 2.0)),
            rotation: turned(random),
        }
    }

    fn text(&self, to: &Elsewhere) -> String {
        let DVec3 { x, y, z } = self.size * to.scale;
        let mesh = match self.kind {
            0 => format!("Sphere(radius: {:?})", x / 2.0),
            1 => format!("Box(size: ({x:?}, {y:?}, {z:?}))"),
            2 => format!("Torus(major: {x:?}, minor: {:?})", 0.3 * x),
            _ => format!("Plane(size: ({:?}, {:?}))", 4.0 * x, 4.0 * z),
        };
        format!(
            "(mesh: {mesh}, translation: {}, rotation: {}, material: (specular: (0.2, 0.2, 0.2), shininess: 10.0))",
            to.place(self.position),
            to.rotation(self.rotation)
        )
    }
}

struct Scene {
    eye: DVec3,
    extinction: f64,
    g: f64,
    lights: Vec<Light>,
    objects: Vec<Object>,
}

impl Scene {
    fn random(random: &mut Random) -> Self {
        Self {
            eye: inside(random, DVec3::new(-2.0, 0.5, 3.0), DVec3::new(2.0, 3.0, 6.0)),
            extinction: within(random, 0.01, 0.2),
            g: within(random, -0.5, 0.85),
            lights: (0..1 + random.below(2)).map(|_| Light::random(random)).collect(),
            objects: (0..1 + random.below(3)).map(|_| Object::random(random)).collect(),
        }
    }

    fn text(&self, to: &Elsewhere) -> String {
        let extinction = written(DVec3::new(1.0, 1.2, 0.8) * self.extinction / to.scale);
        let lights: Vec<String> = self.lights.iter().map(|light| light.text(to)).collect();
        let objects: Vec<String> = self.objects.iter().map(|object| object.text(to)).collect();
        format!(
            "(camera: (position: {}, look_at: {}, up: {}, vertical_fov: 45.0), medium: (extinction: {extinction}, phase: HenyeyGreenstein(g: {:?})), lights: [{}], objects: [{}])",
            to.place(self.eye),
            to.place(DVec3::new(0.0, 0.7, 0.0)),
            to.direction(DVec3::Y),
            self.g,
            lights.join(", "),
            objects.join(", ")
        )
    }
}

/// What part of the numbers differ by more than `tolerance`.
fn part_that_differs(here: &[f32], there: &[f32], tolerance: f64) -> f64 {
    let brightest = f64::from(here.iter().copied().fold(0.0, f32::max));
    let differs = |(&a, &b): (&f32, &f32)| {
        let (a, b) = (f64::from(a), f64::from(b));
        let agrees = (a - b).abs() <= tolerance * a.abs().max(1e-3 * brightest);
        !agrees
    };
    here.iter().zip(there).filter(|&pair| differs(pair)).count() as f64 / here.len() as f64
}

#[test]
fn a_picture_is_the_same_elsewhere() {
    let rounds = std::env::var("TYNDALL_ROUNDS").ok().and_then(|text| text.parse().ok()).unwrap_or(ROUNDS);
    let seed = std::env::var("TYNDALL_SEED").ok().and_then(|text| text.parse().ok()).unwrap_or(0xe15e_u64);
    let desk = Desk::new();
    let mut random = Random(seed | 1);
    let mut wrong = Vec::new();
    for round in 0..rounds {
        let scene = Scene::random(&mut random);
        let to = Elsewhere::random(&mut random);
        let texts = [scene.text(&Elsewhere::HERE), scene.text(&to)];
        for (graph, tolerance) in GRAPHS {
            let [here, there] = texts.each_ref().map(|text| {
                desk.put("somewhere.scene.ron", text);
                desk.try_draw(&shipped(graph), "somewhere.scene.ron", (32, 24), &["radiance"], &[]).unwrap()
            });
            let part = part_that_differs(&here.pictures[0].data, &there.pictures[0].data, tolerance);
            if part > ON_EDGES {
                wrong.push(format!("round {round}, {graph}: {part:.4} of it differs:\n{}\n{}", texts[0], texts[1]));
            }
        }
    }
    assert!(wrong.is_empty(), "{} differ:\n{}", wrong.len(), wrong.join("\n"));
}
