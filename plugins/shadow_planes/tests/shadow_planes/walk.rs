//! The walk of `shadows.wgsl`, run on a GPU over thousands of rays, against brute force over all triangles in
//! double precision: triangles without order, strips and fans that share vertices, open, of any winding, intersecting.

use bytemuck::{Pod, Zeroable};
use glam::DVec3;
use tyndall_probe::Probe;
use tyndall_scene::Scene;
use tyndall_shaders::ray::Ray;
use tyndall_shaders::shadows::lit_intervals;

use crate::soup::{Random, Setting};

/// Metres; beyond there is nothing.
const FAR: f64 = 40.0;

/// Metres; nearer than this nothing is met: an eye on a triangle does not see it.
const NEAR: f64 = 1e-4;

#[repr(C)]
#[derive(Clone, Copy, Pod, Zeroable)]
struct Case {
    direction: [f32; 3],
    way: f32,
    eye: [f32; 3],
    light: u32,
}

const FILES: [(&str, &str); 2] = [
    ("shadows.wgsl", include_str!("../../shadows.wgsl")),
    ("shadow_data.wgsl", include_str!("../../shadow_data.wgsl")),
];

const SHADER: &str = r#"
#import scene
#import ray
#import "shadows.wgsl"

struct Case {
    direction: vec3<f32>,
    way: f32,
    eye: vec3<f32>,
    light: u32,
}

var<storage, read> cases: array<Case>;
var<storage, read_write> results: array<vec4<f32>>;

@compute @workgroup_size(64)
fn main(@builtin(global_invocation_id) id: vec3<u32>) {
    let query = cases[min(id.x, arrayLength(&cases) - 1u)];
    let light = shadow_lights.items[query.light];
    let ray = shadow_ray(light, Ray(query.eye, query.direction), query.way);
    var found = LitParts(0u, start_of_walk(light, ray));
    // length, sum of the starts, number
    var sum = vec3<f32>(0.0);
    loop {
        found = next_lit_parts(ray, found.walk);
        for (var i = 0u; i < found.count; i++) {
            let length = parts[i].y - parts[i].x;
            sum += select(vec3<f32>(0.0), vec3<f32>(length, parts[i].x * length, 1.0), length > 0.0);
        }
        if found.walk.x >= ray.way { break; }
    }
    if id.x < arrayLength(&cases) {
        results[id.x] = vec4<f32>(sum, select(0.0, 1.0, found.walk.depth <= 0));
    }
}"#;

/// Rays from the eye of a setting, each with where it meets the first triangle.
fn rays(setting: &Setting, random: &mut Random, count: usize) -> Vec<Ray> {
    let ray = |_| {
        let direction = random.cube().normalize().as_vec3().as_dvec3();
        Ray { origin: setting.eye, direction: direction.normalize() }
    };
    (0..count).map(ray).collect()
}

/// Distance to the first triangle.
fn way(ray: &Ray, setting: &Setting) -> f64 {
    let meets = |[a, b, c]: [DVec3; 3]| {
        let normal = (b - a).cross(c - a);
        let t = normal.dot(a - ray.origin) / normal.dot(ray.direction);
        let p = ray.at(t);
        let inside = [(a, b), (b, c), (c, a)].iter().all(|(u, v)| (v - u).cross(p - u).dot(normal) >= 0.0);
        (t > NEAR && inside).then_some(t)
    };
    setting.corners().into_iter().filter_map(meets).fold(FAR, f64::min)
}

/// The share of rays whose lit parts differ from the truth by more than 1e-4 of their way; the truth must be `hard`: so
/// many parts are there at most.
fn share_of_wrong_rays(what: &str, setting: &Setting, random: &mut Random, hard: usize) -> f64 {
    let scene: Scene = setting.scene();
    let encoded = scene.encode(0.0, 1.0);
    let lights = scene.twin(0.0, 1.0).lights;
    let casters = scene.twin(0.0, 1.0).casters;
    let rays = rays(setting, random, 4000);
    let case = |(index, ray): (usize, &Ray)| Case {
        direction: ray.direction.as_vec3().to_array(),
        way: way(ray, setting) as f32,
        eye: ray.origin.as_vec3().to_array(),
        light: (index % lights.len()) as u32,
    };
    let cases: Vec<Case> = rays.iter().enumerate().map(case).collect();
    let names = ["shadow_lights", "shadow_slices", "shadow_crossings", "shadow_edges"];
    let inputs = names.map(|name| (name, encoded.bytes(name)));
    let found = Probe::new(SHADER, &FILES, &[]).run_with(bytemuck::cast_slice(&cases), cases.len(), &inputs);
    let (mut wrong, mut most) = (0, 0);
    for ((ray, case), found) in rays.iter().zip(&cases).zip(&found) {
        let way = f64::from(case.way);
        let parts = lit_intervals(&lights[case.light as usize], &casters, ray, way);
        let length: f64 = parts.iter().map(|[from, to]| to - from).sum();
        let starts: f64 = parts.iter().map(|[from, to]| from * (to - from)).sum();
        most = most.max(parts.len());
        let close = |found: f32, expected: f64, scale: f64| (f64::from(found) - expected).abs() <= 1e-4 * scale;
        if !(close(found[0], length, way) && close(found[1], starts, way * way)) {
            wrong += 1;
        }
    }
    let share = f64::from(wrong) / rays.len() as f64;
    println!("{what}: {} triangles, up to {most} lit parts, {wrong} of {} rays wrong", casters.len(), rays.len());
    assert!(most >= hard, "{what} is too easy: {most} parts");
    share
}

/// A ray that passes within rounding of an edge of the mesh is another one in single precision. None of these do; one of
/// 4,000 may elsewhere.
const AT_EDGES: f64 = 2.5e-4;

#[test]
fn triangles_without_order() {
    let mut random = Random(0x5eed);
    for round in 0..6 {
        let count = [12, 60, 400][round % 3];
        let size = [0.9, 0.4, 0.15][round % 3];
        let mut setting = setting(&mut random);
        for index in 0..count {
            let centre = random.cube() * 2.0;
            setting.positions.extend((0..3).map(|_| rounded(centre + size * random.cube())));
            setting.triangles.push([3 * index, 3 * index + 1, 3 * index + 2]);
        }
        let share = share_of_wrong_rays("soup", &setting, &mut random, 4);
        assert!(share <= AT_EDGES, "{share}");
    }
}

/// Vertices are shared at random, so that edges have one triangle, two of either winding, three and more.
#[test]
fn meshes_that_are_no_manifolds() {
    let mut random = Random(0xfee1);
    for _ in 0..4 {
        let mut setting = setting(&mut random);
        setting.positions = (0..24).map(|_| rounded(random.cube() * 1.6)).collect();
        while setting.triangles.len() < 40 {
            let triangle = [(); 3].map(|()| (random.unit() * 24.0) as u32);
            if triangle[0] != triangle[1] && triangle[1] != triangle[2] && triangle[2] != triangle[0] {
                setting.triangles.push(triangle);
            }
        }
        let share = share_of_wrong_rays("no manifold", &setting, &mut random, 2);
        assert!(share <= AT_EDGES, "{share}");
    }
}

/// The eye is in the plane of light and edge of many triangles, and the light in the planes of others: a lattice of
/// squares whose vertices are whole numbers, as are eye and lamp.
#[test]
fn eye_and_light_on_planes() {
    let mut random = Random(0xa11);
    let mut setting = setting(&mut random);
    (setting.eye, setting.lamp, setting.sun) = (DVec3::new(0.0, 0.0, -4.0), DVec3::new(0.0, 3.0, 0.0), DVec3::NEG_Y);
    for (x, y, z) in [(-1, 0, 0), (0, 0, 0), (1, 1, 0), (-1, 2, 1), (0, 1, -1), (2, 0, -1), (-2, 3, 0)] {
        let first = setting.positions.len() as u32;
        let corner = |dx: i32, dz: i32| DVec3::new(f64::from(x + dx), f64::from(y), f64::from(z + dz));
        setting.positions.extend([corner(0, 0), corner(1, 0), corner(1, 1), corner(0, 1)]);
        setting.triangles.extend([[first, first + 1, first + 2], [first, first + 2, first + 3]]);
    }
    let share = share_of_wrong_rays("lattice", &setting, &mut random, 3);
    assert!(share <= AT_EDGES, "{share}");
}

/// The eye is on a face, on an edge and on a vertex of casters: of a soup, and of a mesh that shares its vertices.
#[test]
fn eyes_on_casters() {
    let mut random = Random(0xe7e);
    for round in 0..12 {
        let mut setting = setting(&mut random);
        if round % 2 == 0 {
            for index in 0..40 {
                let centre = random.cube() * 2.0;
                setting.positions.extend((0..3).map(|_| rounded(centre + 0.8 * random.cube())));
                setting.triangles.push([3 * index, 3 * index + 1, 3 * index + 2]);
            }
        } else {
            setting.positions = (0..16).map(|_| rounded(random.cube() * 1.6)).collect();
            setting.triangles = (0..14).map(|index| [index, index + 1, index + 2]).collect();
        }
        let [a, b, c] = setting.corners()[7];
        setting.eye = rounded([(a + b + c) / 3.0, 0.3 * a + 0.7 * b, c][round / 2 % 3]);
        let what = ["on a face", "on an edge", "on a vertex"][round / 2 % 3];
        let share = share_of_wrong_rays(what, &setting, &mut random, if round % 2 == 0 { 4 } else { 1 });
        assert!(share <= 4.0 * AT_EDGES, "{what}: {share}");
    }
}

fn setting(random: &mut Random) -> Setting {
    let eye = rounded(random.cube() * 2.5);
    let (lamp, sun) = (rounded(random.cube() * 2.5), random.cube());
    Setting { positions: Vec::new(), triangles: Vec::new(), eye, lamp, sun }
}

fn rounded(v: DVec3) -> DVec3 {
    v.as_vec3().as_dvec3()
}
