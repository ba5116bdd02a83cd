//! `air.wgsl` on a GPU against its twin in double precision, over random air, suns and rays.

use glam::{DVec3, Vec3};
use tyndall_aerial::atmosphere::Atmosphere;
use tyndall_probe::Probe;

/// `atmosphere.wgsl` makes the air of each case, so that it is held against the twin as well.
fn shader(result: &str) -> String {
    let atmosphere = include_str!("../../atmosphere.wgsl");
    let atmosphere = atmosphere.replace("var<uniform> params: Params;", "var<private> params: Params;");
    let atmosphere = atmosphere.replace("var<storage, read_write> air: Air;", "var<private> air: Air;");
    let atmosphere = atmosphere.replace("@compute @workgroup_size(1)\nfn main()", "fn make_air()");
    assert!(!atmosphere.contains("var<uniform>") && !atmosphere.contains("@compute"));
    format!(
        "{atmosphere}
        struct Case {{
            params: Params,
            sun: vec3<f32>,
            way: f32,
            irradiance: vec3<f32>,
            ray: vec3<f32>,
        }}
        var<storage, read> cases: array<Case>;
        var<storage, read_write> results: array<vec4<f32>>;

        @compute @workgroup_size(64)
        fn main(@builtin(global_invocation_id) id: vec3<u32>) {{
            if id.x >= arrayLength(&cases) {{
                return;
            }}
            let found = cases[id.x];
            params = found.params;
            make_air();
            var light: Light;
            light.kind = DIRECTIONAL;
            light.intensity = found.irradiance;
            light.direction = found.sun;
            let s = way_in_air(air, found.ray, found.way);
            results[id.x] = vec4<f32>({result}, 1.0);
        }}"
    )
}

#[derive(Debug, Clone, Copy)]
struct Case {
    atmosphere: Atmosphere,
    sun: DVec3,
    irradiance: DVec3,
    ray: DVec3,
    way: f64,
}

/// xorshift64 (Marsaglia 2003).
struct Random(u64);

impl Random {
    fn next(&mut self) -> f64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        (self.0 >> 11) as f64 / (1u64 << 53) as f64
    }

    fn within(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.next()
    }

    fn magnitude(&mut self, low: f64, high: f64) -> f64 {
        10f64.powf(self.within(low, high))
    }

    fn direction(&mut self) -> DVec3 {
        let (z, angle) = (self.within(-1.0, 1.0), self.within(0.0, 6.3));
        let side = (1.0 - z * z).sqrt();
        rounded(DVec3::new(side * angle.cos(), z, side * angle.sin()))
    }

    /// Some channels 0.
    fn coefficients(&mut self) -> DVec3 {
        rounded(DVec3::from_array([0; 3].map(|_| if self.next() < 0.1 { 0.0 } else { self.magnitude(-7.0, -3.0) })))
    }

    fn case(&mut self) -> Case {
        let mut number = |low: f64, high: f64| f64::from(self.within(low, high) as f32);
        let (rayleigh_height, mie_height) = (number(5e3, 2e4), number(500.0, 2e4));
        let g = if number(0.0, 1.0) < 0.2 { number(0.9, 0.9999) } else { number(-0.9, 0.9) };
        let g = rounded(DVec3::new(g, number(-0.9, 0.9), 0.76));
        let sun = self.direction();
        // one in five within a degree of the sun
        let near = rounded((self.magnitude(-5.0, -1.7) * self.direction() - sun).normalize());
        let ray = if self.next() < 0.2 { near } else { self.direction() };
        let endless = self.next() < 0.3;
        Case {
            atmosphere: Atmosphere {
                rayleigh: self.coefficients(),
                mie: self.coefficients(),
                absorption: self.coefficients(),
                g,
                rayleigh_height,
                mie_height,
                dome: self.next() < 0.5,
                from_space: self.next() < 0.5,
            },
            sun,
            irradiance: rounded(DVec3::new(self.within(0.1, 20.0), 18.0, 15.0)),
            ray,
            way: if endless { f64::INFINITY } else { f64::from(self.magnitude(-2.0, 6.0) as f32) },
        }
    }
}

fn rounded(vector: DVec3) -> DVec3 {
    vector.as_vec3().as_dvec3()
}

fn bytes(case: &Case) -> Vec<u8> {
    let Case { atmosphere: air, sun, irradiance, ray, way } = *case;
    let with = |vector: DVec3, last: f32| vector.as_vec3().extend(last).to_array();
    let mut bytes = Vec::new();
    for vector in [air.rayleigh, air.mie, air.absorption] {
        bytes.extend_from_slice(bytemuck::bytes_of(&with(vector, 0.0)));
    }
    bytes.extend_from_slice(bytemuck::bytes_of(&with(air.g, air.rayleigh_height as f32)));
    bytes.extend_from_slice(bytemuck::bytes_of(&(air.mie_height as f32)));
    let choices = [u32::from(air.dome), u32::from(air.from_space), 0];
    bytes.extend_from_slice(bytemuck::bytes_of(&choices));
    for vector in [with(sun, way as f32), with(irradiance, 0.0), with(ray, 0.0)] {
        bytes.extend_from_slice(bytemuck::bytes_of(&vector));
    }
    bytes
}

/// Relative errors of all channels, sorted; where both are darker than f32 can tell there is none.
fn errors(result: &str, cases: &[Case], wanted: impl Fn(&Case) -> DVec3) -> Vec<f64> {
    let all: Vec<u8> = cases.iter().flat_map(bytes).collect();
    let found =
        Probe::new(&shader(result), &[("air.wgsl", include_str!("../../air.wgsl"))], &[]).run(&all, cases.len());
    let mut errors = Vec::new();
    for (case, [r, g, b, _]) in cases.iter().zip(found) {
        let found = Vec3::new(r, g, b).as_dvec3();
        for (found, wanted) in found.to_array().into_iter().zip(wanted(case).to_array()) {
            assert!(found.is_finite() && found >= 0.0, "{found} for {case:?}");
            if wanted < 1e-25 {
                assert!(found < 1e-24, "{found:e} instead of {wanted:e} for {case:?}");
            } else {
                errors.push((found / wanted - 1.0).abs());
            }
        }
    }
    errors.sort_by(f64::total_cmp);
    errors
}

fn expect(what: &str, errors: &[f64], p99: f64, max: f64) {
    let at = |share: f64| errors[((errors.len() - 1) as f64 * share) as usize];
    let text =
        format!("{what}: {} values, p50 {:.1e}, p99 {:.1e}, max {:.1e}", errors.len(), at(0.5), at(0.99), at(1.0));
    println!("{text}");
    assert!(errors.len() > 2000 && at(0.99) <= p99 && at(1.0) <= max, "{text}");
}

fn cases() -> Vec<Case> {
    let mut random = Random(0x9e37_79b9_7f4a_7c15);
    (0..4000).map(|_| random.case()).collect()
}

/// An error of f32 in an optical depth of D is one of D times as much in e^-D: these cases have depths to 60.
#[test]
fn in_scattering() {
    let found = errors("in_scattering(air, source_of_sun(air, light, found.ray), s)", &cases(), |case| {
        case.atmosphere.air().in_scattering(
            case.sun,
            case.irradiance,
            case.ray,
            case.atmosphere.air().way(case.ray, case.way),
        )
    });
    expect("in-scattering", &found, 1e-4, 1e-3);
}

#[test]
fn extinction() {
    let found = errors("extinction_factor(air, s)", &cases(), |case| {
        case.atmosphere.air().extinction_factor(case.atmosphere.air().way(case.ray, case.way))
    });
    expect("extinction", &found, 1e-4, 1e-3);
}

#[test]
fn sunlight() {
    let found = errors("sunlight(air, light)", &cases(), |case| case.atmosphere.air().sunlight(case.sun));
    expect("sunlight", &found, 1e-4, 1e-3);
}

/// The test of the test: a factor of 1.001 is noticed.
#[test]
fn a_wrong_function_is_noticed() {
    let found = errors("1.001 * sunlight(air, light)", &cases(), |case| case.atmosphere.air().sunlight(case.sun));
    assert!(found[found.len() / 2] > 5e-4);
}
