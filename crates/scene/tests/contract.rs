//! A scene file with every field, the defaults, and what they become.

use std::path::Path;
use std::sync::Arc;

use tyndall_document::{Diagnostics, Source, render_text};
use tyndall_scene::layout;
use tyndall_scene::{Extensions, Override, Overrides, Phase, Scene};
use tyndall_shaders::phase::PHASE_FUNCTIONS;

fn read_with(text: &str, overrides: &[(&str, &str)]) -> Result<Scene, Diagnostics> {
    let mut out = Diagnostics::default();
    let argument = |path: &str, value: &str| format!("--set scene.{path}={value}");
    let overrides: Overrides = overrides
        .iter()
        .map(|(p, v)| Override::read(p, v, &argument(p, v), &mut out).expect("the value is RON"))
        .collect();
    Scene::from_source(&Source::new("test.scene.ron", text), Path::new("."), &overrides, &Arc::default()).map(|s| s.0)
}

fn read(text: &str) -> Scene {
    read_with(text, &[]).unwrap_or_else(|errors| panic!("{}", render_text(&errors, false)))
}

const CAMERA: &str = "camera: (position: (0, 1, 5), look_at: (0, 1, 0)),";

fn with_camera(rest: &str) -> Scene {
    read(&format!("({CAMERA} {rest})"))
}

fn view<T: bytemuck::Pod>(scene: &Scene, name: &str) -> T {
    *bytemuck::from_bytes(scene.encode(0.0, 2.0).bytes(name))
}

fn items<T: bytemuck::Pod>(scene: &Scene, name: &str) -> Vec<T> {
    let encoded = scene.encode(0.0, 2.0);
    let bytes = encoded.bytes(name);
    let count = u32::from_le_bytes([bytes[0], bytes[1], bytes[2], bytes[3]]) as usize;
    let elements: Vec<T> = bytemuck::pod_collect_to_vec(&bytes[16..]);
    assert_eq!(elements.len(), count.max(1), "{name}");
    elements[..count].to_vec()
}

#[test]
fn everything_of_the_contract() {
    let text = r#"(
        camera: (position: (0.0, 1.7, 6.0), look_at: (0.0, 1.0, 0.0), up: (0.0, 1.0, 0.0), vertical_fov: 45.0),
        medium: (extinction: (0.05, 0.06, 0.07), albedo: (1.0, 0.5, 1.0), phase: HenyeyGreenstein(g: 0.75)),
        background: (0.1, 0.2, 0.3),
        lights: [
            Point(position: (1.0, 3.0, 0.0), intensity: (20.0, 18.0, 15.0), radius: 0.1),
            Spot(position: (0.0, 4.0, 0.0), direction: (0.0, -2.0, 0.0), intensity: (30.0, 30.0, 30.0), exponent: 8.0, cutoff: 60.0),
            Directional(direction: (0.3, -1.0, 0.2), irradiance: (1.0, 1.0, 1.0)),
        ],
        objects: [
            (mesh: Sphere(radius: 1.0), translation: (0.0, 1.0, 0.0), material: (diffuse: (0.7, 0.6, 0.5), specular: (0.2, 0.2, 0.2), shininess: 20.0)),
            (mesh: Box(size: (1.0, 2.0, 1.0)), translation: (2.0, 1.0, 0.0), rotation: (axis: (0.0, 1.0, 0.0), angle: 30.0)),
            (mesh: Torus(major: 1.0, minor: 0.3), translation: (-2.0, 1.0, 0.0)),
            (mesh: Plane(size: (20.0, 20.0)), casts_shadow: false, material: (specular: (0.1, 0.1, 0.1))),
        ],
    )"#;
    let scene = read(text);
    let lights: Vec<layout::Light> = items(&scene, "lights");
    assert_eq!(lights.iter().map(|l| l.kind).collect::<Vec<_>>(), [0, 1, 2]);
    assert_eq!((lights[0].radius, lights[0].intensity), (0.1, [20.0, 18.0, 15.0]));
    assert_eq!((lights[1].direction, lights[1].exponent), ([0.0, -1.0, 0.0], 8.0));
    assert!((lights[1].cos_cutoff - 0.5).abs() < 1e-6);
    let medium: layout::Medium = view(&scene, "medium");
    assert_eq!(medium.scattering, [0.05, 0.03, 0.07]);
    assert_eq!(view::<layout::Phase>(&scene, "phase"), layout::Phase::from(&Phase::HenyeyGreenstein { g: 0.75 }));
    let background: layout::Background = view(&scene, "background");
    assert_eq!(background.radiance, [0.1, 0.2, 0.3]);
    let objects: Vec<layout::Object> = items(&scene, "objects");
    assert_eq!(objects.iter().map(|o| o.casts_shadow).collect::<Vec<_>>(), [1, 1, 1, 0]);
    let materials: Vec<layout::Material> = items(&scene, "materials");
    let of = |i: usize| materials[objects[i].material as usize];
    assert_eq!((of(0).diffuse, of(0).shininess), ([0.7, 0.6, 0.5], 20.0));
    assert_eq!((of(1).diffuse, of(1).specular, of(1).shininess, of(1).texture), ([0.8; 3], [0.0; 3], 1.0, u32::MAX));
    assert_eq!((of(3).diffuse, of(3).specular), ([0.8; 3], [0.1; 3]));
    assert!(scene.animated().is_empty());
    let names: Vec<&str> = scene.encode(0.0, 1.0).items.iter().map(|i| i.0).collect();
    assert_eq!(names, Extensions::default().data_names());
}

#[test]
fn defaults() {
    let scene = with_camera("");
    let medium: layout::Medium = view(&scene, "medium");
    assert_eq!((medium.extinction, medium.scattering), ([0.0; 3], [0.0; 3]));
    let isotropic = layout::Phase::from(&Phase::Isotropic);
    assert_eq!(view::<layout::Phase>(&scene, "phase"), isotropic);
    let camera: layout::Camera = view(&scene, "camera");
    let tangent = (45f64.to_radians() / 2.0).tan() as f32;
    assert_eq!((camera.position, camera.forward), ([0.0, 1.0, 5.0], [0.0, 0.0, -1.0]));
    assert_eq!((camera.up, camera.right), ([0.0, tangent, 0.0], [2.0 * tangent, 0.0, 0.0]));
    assert!(items::<layout::Light>(&scene, "lights").is_empty());
    assert!(items::<layout::Vertex>(&scene, "vertices").is_empty());
    assert!(items::<[u32; 4]>(&scene, "triangles").is_empty());
    assert!(scene.bounds(0.0).is_none());
    let given = with_camera(
        "medium: (extinction: (1, 2, 3)), lights: [Spot(position: (0, 0, 0), direction: (1, 0, 0), intensity: (1, 1, 1))]",
    );
    let medium: layout::Medium = view(&given, "medium");
    assert_eq!(medium.scattering, [1.0, 2.0, 3.0]);
    assert_eq!(view::<layout::Phase>(&given, "phase"), isotropic);
    let spot = items::<layout::Light>(&given, "lights")[0];
    assert_eq!((spot.cos_cutoff, spot.exponent, spot.radius), (0.0, 0.0, 0.0));
}

#[test]
fn every_phase_function_is_read_and_encoded() {
    for function in PHASE_FUNCTIONS {
        for share in [0.1, 0.4, 0.9] {
            let values: Vec<f64> = function.parameters.iter().map(|parameter| parameter.range.at(share)).collect();
            let expected = (function.make)(&mut |parameter| Some(parameter.range.at(share))).expect("all have a value");
            let written = |named: bool| {
                let names =
                    function.parameters.iter().map(|p| if named { format!("{}: ", p.name) } else { String::new() });
                names.zip(&values).map(|(name, value)| format!("{name}{value:?}")).collect::<Vec<_>>().join(", ")
            };
            for text in [written(true), written(false)] {
                let scene = with_camera(&format!("medium: (phase: {}({text}))", function.name));
                assert_eq!(scene.medium.as_ref().expect("a medium").phase, expected, "{text}");
                assert_eq!(view::<layout::Phase>(&scene, "phase"), layout::Phase::from(&expected), "{text}");
            }
        }
    }
}

#[test]
fn phase_functions() {
    for (text, expected) in [
        ("Isotropic", Phase::Isotropic),
        ("Isotropic()", Phase::Isotropic),
        ("HenyeyGreenstein(g: -0.5)", Phase::HenyeyGreenstein { g: -0.5 }),
        (
            "DoubleHenyeyGreenstein(g1: 0.8, g2: -0.3, f: 0.25)",
            Phase::DoubleHenyeyGreenstein { g1: 0.8, g2: -0.3, f: 0.25 },
        ),
        ("Schlick(k: 0.5)", Phase::Schlick { k: 0.5 }),
        ("Rayleigh", Phase::Rayleigh),
        ("CornetteShanks(g: 0.9)", Phase::CornetteShanks { g: 0.9 }),
        ("Droplets(diameter: 20)", Phase::Droplets { diameter: 20.0 }),
        ("Droplets(5)", Phase::Droplets { diameter: 5.0 }),
    ] {
        let scene = with_camera(&format!("medium: (phase: {text})"));
        assert_eq!(scene.medium.as_ref().expect("a medium").phase, expected, "{text}");
        assert_eq!(view::<layout::Phase>(&scene, "phase"), layout::Phase::from(&expected), "{text}");
    }
    // Any |g| below 1 is accepted; what single precision rounds to 1 keeps its width.
    let scene = with_camera("medium: (phase: HenyeyGreenstein(g: 0.9999999999))");
    let phase: layout::Phase = view(&scene, "phase");
    assert!((phase.lobes[0].rho / 5e-11 - 1.0).abs() < 1e-4, "{phase:?}");
    assert!(phase.legendre[1] <= 1.0, "{phase:?}");
}

/// The encoded lobes in single precision are the phase function.
#[test]
fn lobes_are_encoded() {
    let double = layout::Phase::from(&Phase::DoubleHenyeyGreenstein { g1: 0.8, g2: -0.3, f: 0.25 });
    assert_eq!(double.lobe_count, 2);
    let at = |w: f32| -> f32 {
        let of = |l: &layout::Lobe| {
            l.scale * (l.rho * l.rho * (1.0 - w) + w).powf(-1.5) * (1.0 + l.mu_squared * (1.0 - 2.0 * w).powi(2))
        };
        double.lobes.iter().map(of).sum()
    };
    let hg = |g: f64, mu: f64| (1.0 - g * g) / (4.0 * std::f64::consts::PI * (1.0 + g * g - 2.0 * g * mu).powf(1.5));
    for mu in [-1.0, -0.3, 0.5, 1.0] {
        let expected = 0.75 * hg(0.8, mu) + 0.25 * hg(-0.3, mu);
        assert!((f64::from(at((1.0 - mu as f32) / 2.0)) / expected - 1.0).abs() < 1e-5, "mu {mu}");
    }
    assert_eq!(layout::Phase::from(&Phase::Rayleigh).lobes[1], layout::Lobe { rho: 1.0, ..Default::default() });
}

#[test]
fn order_is_scale_rotate_translate() {
    let object = "objects: [(mesh: Plane(size: (2, 2)), scale: 3, rotation: (axis: (0, 2, 0), angle: 90), translation: (10, 1, 0))]";
    let vertices: Vec<layout::Vertex> = items(&with_camera(object), "vertices");
    // The corner (−1, 0, 1): scaled (−3, 0, 3), turned by 90° about +y (z to x, x to −z) (3, 0, 3), moved (13, 1, 3).
    let distance = glam::Vec3::from_array(vertices[0].position).distance(glam::Vec3::new(13.0, 1.0, 3.0));
    assert!(distance < 1e-5, "{:?}", vertices[0]);
}

/// A ball becomes an ellipsoid: its normals are the gradient of (x/2)² + (y/0.5)² + z², whichever axes are mirrored.
#[test]
fn three_numbers_scale_each_axis() {
    for signs in [glam::DVec3::ONE, glam::DVec3::new(-1.0, 1.0, 1.0), glam::DVec3::new(-1.0, -1.0, -1.0)] {
        let [x, y, z] = (signs * glam::DVec3::new(2.0, 0.5, 1.0)).to_array();
        let scene = with_camera(&format!("objects: [(mesh: Sphere(radius: 1), scale: ({x}, {y}, {z}))]"));
        let vertices: Vec<layout::Vertex> = items(&scene, "vertices");
        let gradient = |p: glam::DVec3| (p / glam::DVec3::new(4.0, 0.25, 1.0)).normalize();
        for vertex in &vertices {
            let [position, normal] = [vertex.position, vertex.normal].map(|v| glam::Vec3::from_array(v).as_dvec3());
            assert!((gradient(position) - normal).length() < 1e-5, "{position} {normal}");
        }
        // Triangles still run counter-clockwise from outside, and the ellipsoid is closed as the ball was.
        let triangles: Vec<[u32; 4]> = items(&scene, "triangles");
        let corner = |index: u32| glam::Vec3::from_array(vertices[index as usize].position).as_dvec3();
        let volume =
            triangles.iter().map(|[a, b, c, _]| corner(*a).dot(corner(*b).cross(corner(*c)))).sum::<f64>() / 6.0;
        assert!((volume / (4.0 / 3.0 * std::f64::consts::PI) - 1.0).abs() < 1e-3, "{signs}: {volume}");
        let edges = &scene.adjacency()[0].edges;
        assert!(edges.iter().all(|edge| edge.kind() == tyndall_scene::adjacency::EdgeKind::Manifold), "{signs}");
    }
    // One number is the same along all axes.
    let with = |scale: &str| with_camera(&format!("objects: [(mesh: Box(size: (1, 2, 3)), scale: {scale})]"));
    assert_eq!(with("3").encode(0.0, 1.0).items, with("(3, 3, 3)").encode(0.0, 1.0).items);
    for (scale, message) in
        [("(1, 0, 1)", "`scale` is 0; it must be above or below 0"), ("(1, 2)", "a tuple of 3 numbers")]
    {
        let text = format!("({CAMERA} objects: [(mesh: Box(size: (1, 1, 1)), scale: {scale})])");
        let messages = render_text(&read_with(&text, &[]).expect_err("it is wrong"), false);
        assert!(messages.contains(message), "{messages}");
    }
}

#[test]
fn keys_move_what_they_should_and_nothing_else() {
    let scene = read(
        "(camera: (position: Keys([(0, (0, 1, 5)), (2, (0, 3, 5))]), look_at: (0, 1, 0)),
          lights: [Point(position: (0, 0, 0), intensity: Keys([(1, (0, 0, 0)), (2, (8, 8, 8))]))],
          objects: [(mesh: Box(size: (1, 1, 1))), (mesh: Plane(size: (1, 1)), translation: Keys([(0, (0, 0, 0)), (1, (0, 1, 0))]))])",
    );
    let moving = ["camera", "lights", "vertices"];
    assert_eq!(scene.animated(), moving);
    let mut encoded = scene.encode(0.0, 1.0);
    let before = scene.encode(0.0, 1.0);
    assert_eq!(encoded.update(&scene, 1.5, 1.0), moving);
    assert_eq!(encoded.items, scene.encode(1.5, 1.0).items);
    assert_ne!(encoded.items, before.items);
    let camera: layout::Camera = *bytemuck::from_bytes(encoded.bytes("camera"));
    assert_eq!(camera.position, [0.0, 2.5, 5.0]);
    let light: layout::Light = bytemuck::pod_read_unaligned(&encoded.bytes("lights")[16..80]);
    assert_eq!(light.intensity, [4.0; 3]);
    // The box did not move.
    assert_eq!(encoded.bytes("vertices")[16..16 + 24 * 32], before.bytes("vertices")[16..16 + 24 * 32]);
    assert!(encoded.update(&scene, 1.5, 1.0).is_empty());
    assert_eq!(encoded.update(&scene, 1.5, 2.0), ["camera"]);
    assert_eq!(encoded.update(&scene, 0.0, 1.0), moving);
    assert_eq!(encoded.items, before.items);
    // Those that nobody reads are not worked out.
    let mut unread = scene.encode_for(0.0, 1.0, &|name| name == "vertices" || name == "medium");
    assert_eq!(unread.items.iter().map(|item| item.0).collect::<Vec<_>>(), ["medium", "vertices"]);
    assert_eq!(unread.update(&scene, 1.5, 1.0), ["vertices"]);
    assert!(unread.bytes("camera").is_empty() && unread.bytes("vertices") == scene.encode(1.5, 1.0).bytes("vertices"));
}

#[test]
fn overrides_replace_and_add() {
    let text = format!(
        "({CAMERA} lights: [Point(position: (0, 0, 0), intensity: (1, 1, 1))], objects: [(mesh: Sphere(radius: 1))])"
    );
    let overrides = [
        ("medium.extinction", "(1, 2, 3)"),
        ("medium.phase", "Schlick(k: 0.5)"),
        ("medium.phase.k", "0.25"),
        ("lights.0.intensity", "(9, 9, 9)"),
        ("lights.0.intensity.1", "7"),
        ("objects.0.material.diffuse", "(0.1, 0.2, 0.3)"),
        ("objects.0.mesh.radius", "2"),
        ("camera.vertical_fov", "90"),
        ("camera.vertical_fov", "60"),
    ];
    let scene = read_with(&text, &overrides).unwrap_or_else(|e| panic!("{}", render_text(&e, false)));
    let medium: layout::Medium = view(&scene, "medium");
    assert_eq!(medium.extinction, [1.0, 2.0, 3.0]);
    assert_eq!(view::<layout::Phase>(&scene, "phase"), layout::Phase::from(&Phase::Schlick { k: 0.25 }));
    assert_eq!(items::<layout::Light>(&scene, "lights")[0].intensity, [9.0, 7.0, 9.0]);
    assert_eq!(items::<layout::Material>(&scene, "materials")[0].diffuse, [0.1, 0.2, 0.3]);
    assert!((scene.bounds(0.0).expect("a sphere").max.x - 2.0).abs() < 1e-3);
    let camera: layout::Camera = view(&scene, "camera");
    assert!((camera.up[1] - 30f32.to_radians().tan()).abs() < 1e-6);
}

#[test]
fn mistakes_in_overrides_name_the_argument() {
    let text =
        format!("({CAMERA} lights: [Point(position: (0, 0, 0), intensity: (1, 1, 1))], medium: (albedo: (2, 0, 0)))");
    let messages = |overrides: &[(&str, &str)]| {
        let errors = read_with(&text, overrides).expect_err("there are mistakes");
        let line = |d: &tyndall_document::Diagnostic| {
            let place = match &d.place {
                tyndall_document::Place::Argument(argument) => argument.clone(),
                tyndall_document::Place::Text { source, span } => source.slice(*span).to_owned(),
                tyndall_document::Place::File(name) => name.clone(),
            };
            (d.code.0, place, d.suggestion.clone())
        };
        errors.iter().map(line).collect::<Vec<_>>()
    };
    let albedo = ("out-of-range", "2".to_owned(), None);
    assert_eq!(
        messages(&[("medium.extincton", "(1, 1, 1)")]),
        [
            albedo.clone(),
            (
                "unknown-field",
                "--set scene.medium.extincton=(1, 1, 1)".to_owned(),
                Some("did you mean `extinction`?".to_owned())
            )
        ]
    );
    assert_eq!(
        messages(&[("lights.3.intensity", "(1, 1, 1)")]),
        [albedo.clone(), ("unknown-path", "--set scene.lights.3.intensity=(1, 1, 1)".to_owned(), None)]
    );
    assert_eq!(
        messages(&[("lights.0.intensity", "(1, -1, 1)"), ("medium.albedo", "(1, 1, 1)")]),
        [("out-of-range", "--set scene.lights.0.intensity=(1, -1, 1)".to_owned(), None)]
    );
}

#[test]
fn scenes_of_the_repository() {
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/../../graphs/scenes");
    let entries = std::fs::read_dir(folder).expect("graphs/scenes");
    let mut count = 0;
    for entry in entries {
        let path = entry.expect("a folder entry").path();
        if path.to_string_lossy().ends_with(".scene.ron") {
            let (scene, warnings) = Scene::load(&path, &Overrides::new(), &Arc::default())
                .unwrap_or_else(|errors| panic!("{}", render_text(&errors, false)));
            assert!(warnings.is_empty(), "{}", render_text(&warnings, false));
            assert!(!scene.lights.is_empty() && !scene.instances.is_empty());
            count += 1;
        }
    }
    assert!(count >= 2, "{count} scenes in graphs/scenes");
}

/// Height fog, and what the medium sends out of itself: absent, they are nothing.
#[test]
fn height_fog_ambient_and_emission() {
    let plain = with_camera("medium: (extinction: (1, 2, 3))");
    let fog: layout::HeightFog = view(&plain, "height_fog");
    assert_eq!((fog.falloff, plain.has_height_fog()), (0.0, false));
    assert_eq!(view::<layout::Ambient>(&plain, "ambient").radiance, [0.0; 3]);
    let scene = with_camera(
        "medium: (albedo: (1, 0.5, 0), scale_height: 4, base_height: 7, ambient: (0.1, 0.1, 0.1), emission: (2, 2, 2))",
    );
    let fog: layout::HeightFog = view(&scene, "height_fog");
    assert_eq!((fog.falloff, fog.base_height, scene.has_height_fog()), (0.25, 7.0, true));
    assert_eq!(view::<layout::Ambient>(&scene, "ambient").radiance, [0.1, 1.1, 2.1]);
}

/// A measured phase function is read from its file, which is watched.
#[test]
fn measured_phase_functions() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../graphs/scenes");
    let text =
        "(camera: (position: (0, 1, 5), look_at: (0, 1, 0)), medium: (phase: Measured(\"phase/fog_20um.phase.txt\")))";
    let source = Source::new("test.scene.ron", text);
    let (scene, _) = Scene::from_source(&source, &folder, &Overrides::new(), &Arc::default()).expect("it is a scene");
    assert!(scene.files().iter().any(|file| file.ends_with("phase/fog_20um.phase.txt")), "{:?}", scene.files());
    let phase = scene.medium.as_ref().expect("a medium").phase;
    assert!(matches!(phase, Phase::Measured(_)), "{phase:?}");
    let encoded = scene.encode(0.0, 1.0);
    let count = u32::from_le_bytes(*encoded.bytes("phase_table").first_chunk().expect("a list"));
    assert_eq!(encoded.bytes("phase_table").len(), 16 + 16 * count as usize);
    let legendre = layout::Phase::from(&phase).legendre;
    assert!((legendre[0] - 1.0).abs() < 1e-6 && (0.85..0.88).contains(&legendre[1]), "{legendre:?}");
}
