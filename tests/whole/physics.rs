//! What must hold of light in a medium whatever the scene is.

use std::path::Path;

use tyndall_image::{Image, metrics};
use tyndall_render::Error;
use tyndall_tests::{Desk, shipped};

const SIZE: (u32, u32) = (24, 18);
const LAMP: &str = "Point(position: (1.0, 2.5, 0.0), intensity: (20.0, 18.0, 15.0))";
const SPOT: &str = "Spot(position: (-1.0, 3.0, 1.0), direction: (0.2, -1.0, -0.1), intensity: (30.0, 30.0, 30.0), exponent: 4.0, cutoff: 35.0)";
const SUN: &str = "Directional(direction: (0.3, -1.0, 0.2), irradiance: (0.5, 0.5, 0.6))";
const FLOOR: &str = "(mesh: Plane(size: (20.0, 20.0))), (mesh: Sphere(radius: 1.0), translation: (0.0, 1.0, 0.0), material: (specular: (0.2, 0.2, 0.2), shininess: 12.0))";
const CAMERA: &str = "camera: (position: (0.0, 1.5, 6.0), look_at: (0.0, 1.0, 0.0), vertical_fov: 50.0)";
const MEDIUM: &str =
    "medium: (extinction: (0.05, 0.06, 0.08), albedo: (0.9, 0.8, 0.7), phase: HenyeyGreenstein(g: 0.7))";
const BACKGROUND: &str = "background: (0.01, 0.02, 0.03)";

fn scene(lights: &str, objects: &str) -> String {
    format!("({CAMERA}, {MEDIUM}, {BACKGROUND}, lights: [{lights}], objects: [{objects}])")
}

/// The linear terms of a picture.
struct Terms {
    radiance: Image,
    airlight: Image,
    surface: Image,
    depth: Image,
}

impl Terms {
    fn each(&self) -> [&Image; 3] {
        [&self.radiance, &self.airlight, &self.surface]
    }

    fn assert_sound(&self, what: &str) {
        for image in self.each() {
            assert!(image.data.iter().all(|value| value.is_finite() && *value >= 0.0), "{what}");
        }
        assert!(self.depth.data.iter().all(|depth| *depth > 0.0), "{what}: depth");
    }
}

/// Draws the scene with `fog.graph.ron`.
fn draw(desk: &Desk, scene: &str, settings: &[&str]) -> Terms {
    desk.put("physics.scene.ron", scene);
    let ports = ["radiance", "airlight", "surface", "surfaces.depth"];
    let settings = [&["scattered=false"], settings].concat();
    let [radiance, airlight, surface, depth] = desk.draw(&shipped("fog"), "physics.scene.ron", SIZE, ports, &settings);
    Terms { radiance, airlight, surface, depth }
}

fn scaled(image: &Image, factor: f32) -> Image {
    Image { data: image.data.iter().map(|value| factor * value).collect(), ..image.clone() }
}

#[track_caller]
fn assert_near(found: &Image, wanted: &Image, tolerance: f64) {
    let errors = metrics::relative_errors(found, wanted, 1e-12, None).unwrap();
    assert!(errors.max <= tolerance, "{errors:?}");
}

fn is_black(image: &Image) -> bool {
    image.data.iter().all(|value| *value == 0.0)
}

#[test]
fn light_is_linear_in_intensity() {
    let desk = Desk::new();
    let text = scene(&format!("{LAMP}, {SPOT}"), FLOOR);
    let one = draw(&desk, &text, &[]);
    let doubled = ["scene.lights.0.intensity=(40, 36, 30)", "scene.lights.1.intensity=(60, 60, 60)"];
    let two = draw(&desk, &text, &doubled);
    assert!(!is_black(&one.airlight) && !is_black(&one.surface));
    // A factor of two is exact in floating point.
    assert_near(&two.airlight, &scaled(&one.airlight, 2.0), 1e-6);
    assert_near(&two.surface, &scaled(&one.surface, 2.0), 1e-6);
}

#[test]
fn the_order_of_lights_does_not_matter_and_they_add_up() {
    let desk = Desk::new();
    let draw = |lights: &str| draw(&desk, &scene(lights, FLOOR), &[]);
    let all = draw(&format!("{LAMP}, {SPOT}, {SUN}"));
    let turned = draw(&format!("{SUN}, {SPOT}, {LAMP}"));
    assert_near(&all.airlight, &turned.airlight, 1e-6);
    assert_near(&all.surface, &turned.surface, 1e-6);
    let each = [LAMP, SPOT, SUN].map(draw);
    for term in 0..2 {
        let of = |terms: &Terms| if term == 0 { terms.airlight.clone() } else { terms.surface.clone() };
        let mut sum = of(&each[0]);
        for other in &each[1..] {
            sum.data.iter_mut().zip(of(other).data).for_each(|(sum, value)| *sum += value);
        }
        assert_near(&of(&all), &sum, 1e-5);
    }
}

#[test]
fn without_extinction_there_is_no_airlight_and_nothing_hides_the_background() {
    let desk = Desk::new();
    let clear = draw(&desk, &scene(LAMP, FLOOR), &["scene.medium.extinction=(0, 0, 0)"]);
    assert!(is_black(&clear.airlight));
    for (index, depth) in clear.depth.data.iter().enumerate() {
        let at = 3 * index..3 * index + 3;
        let wanted = if depth.is_infinite() { &[0.01, 0.02, 0.03] } else { &clear.surface.data[at.clone()] };
        assert_eq!(&clear.radiance.data[at], wanted, "pixel {index}");
    }
    let none = format!("({CAMERA}, {BACKGROUND}, lights: [{LAMP}], objects: [{FLOOR}])");
    let none = draw(&desk, &none, &[]);
    assert!(is_black(&none.airlight), "no medium is a medium without extinction");
    assert_eq!(metrics::differing_bits(&none.radiance, &clear.radiance).unwrap(), 0);
}

#[test]
fn one_channel_without_extinction_is_clear_by_itself() {
    let desk = Desk::new();
    let terms = draw(&desk, &scene(LAMP, ""), &["scene.medium.extinction=(0.1, 0, 0.1)"]);
    for (radiance, airlight) in
        terms.radiance.data.as_chunks::<3>().0.iter().zip(terms.airlight.data.as_chunks::<3>().0)
    {
        assert_eq!((airlight[1], radiance[1]), (0.0, 0.02));
        assert!(airlight[0] > 0.0 && radiance[0] == airlight[0]);
    }
}

#[test]
fn phase_functions_that_are_equal_give_equal_pictures() {
    let desk = Desk::new();
    let text = scene(&format!("{LAMP}, {SPOT}, {SUN}"), FLOOR);
    let airlight = |phase: &str| draw(&desk, &text, &[&format!("scene.medium.phase={phase}")]).airlight;
    let isotropic = airlight("Isotropic");
    assert_near(&airlight("HenyeyGreenstein(0.0)"), &isotropic, 1e-5);
    assert_near(&airlight("Schlick(k: 0)"), &isotropic, 1e-5);
    assert_near(&airlight("CornetteShanks(0.0)"), &airlight("Rayleigh"), 1e-3);
    let forward = airlight("HenyeyGreenstein(g: 0.7)");
    assert_near(&airlight("DoubleHenyeyGreenstein(g1: 0.7, g2: -0.3, f: 0.0)"), &forward, 1e-3);
    assert_near(&airlight("DoubleHenyeyGreenstein(g1: -0.3, g2: 0.7, f: 1.0)"), &forward, 1e-3);
    assert!(metrics::relative_errors(&forward, &isotropic, 1e-12, None).unwrap().p50 > 0.01);
}

#[test]
fn every_phase_function_agrees_with_the_march() {
    let desk = Desk::new();
    desk.put("phase.scene.ron", &scene(&format!("{LAMP}, {SPOT}, {SUN}"), FLOOR));
    let phases = [
        "DoubleHenyeyGreenstein(g1: 0.8, g2: -0.4, f: 0.3)",
        "Schlick(k: 0.6)",
        "CornetteShanks(g: 0.75)",
        "CornetteShanks(g: -0.5)",
        "Rayleigh",
        "HenyeyGreenstein(g: -0.6)",
        "HenyeyGreenstein(g: 0.97)",
    ];
    let graphs = ["airlight", "reference"].map(shipped);
    for phase in phases {
        let set = format!("scene.medium.phase={phase}");
        let draw = |graph: &Path, more: &[&str]| {
            // Dense, so that a step of the march is 1 cm: beside a lamp it is only as good as its step is short.
            let settings = [set.as_str(), "scene.medium.extinction=(0.4, 0.5, 0.6)"];
            let settings: Vec<&str> = settings.into_iter().chain(more.iter().copied()).collect();
            desk.picture(graph, "phase.scene.ron", SIZE, "airlight", &settings)
        };
        let march = draw(&graphs[1], &["steps=4096", "scattered=false", "shadows=false"]);
        let errors = metrics::relative_errors(&draw(&graphs[0], &[]), &march, 1e-12, None).unwrap();
        assert!(errors.p99 < 0.01, "{phase}: {errors:?}");
    }
}

#[test]
fn the_sun_in_an_endless_medium_gives_albedo_times_phase_times_irradiance() {
    let desk = Desk::new();
    let terms = draw(&desk, &scene(SUN, ""), &["scene.medium.phase=Isotropic"]);
    let wanted = [0.9 * 0.5, 0.8 * 0.5, 0.7 * 0.6].map(|value: f64| value / (4.0 * std::f64::consts::PI));
    for pixel in terms.airlight.data.as_chunks::<3>().0 {
        for (found, wanted) in pixel.iter().zip(wanted) {
            assert!((f64::from(*found) / wanted - 1.0).abs() < 1e-5, "{found} {wanted}");
        }
    }
    // Into the sun and away from it, g = 0.7: p = (1 - g²) / (4π (1 ∓ g)³), at a pixel in the middle.
    for (direction, cosine) in [("(0, 0, 1)", 1.0), ("(0, 0, -1)", -1.0)] {
        let set = format!("scene.lights.0.direction={direction}");
        let size = [
            "scene.camera.look_at=(0, 1.5, 0)",
            "scene.medium.albedo=(1, 1, 1)",
            "scene.camera.vertical_fov=0.01",
            &set,
        ];
        let found = f64::from(draw(&desk, &scene(SUN, ""), &size).airlight.pixel(12, 9).unwrap()[0]);
        let g: f64 = 0.7;
        let phase = (1.0 - g * g) / (4.0 * std::f64::consts::PI * (1.0 + g * g - 2.0 * g * cosine).powf(1.5));
        assert!((found / (0.5 * phase) - 1.0).abs() < 1e-4, "{found} {}", 0.5 * phase);
    }
}

/// The lit part of a ray is where it is inside the cone: nothing outside, and the light of a point inside.
#[test]
fn a_spot_lights_its_cone_and_nothing_else() {
    let desk = Desk::new();
    let spot =
        "Spot(position: (0.0, 6.0, 0.0), direction: (0.0, -1.0, 0.0), intensity: (30.0, 30.0, 30.0), cutoff: 20.0)";
    let point = "Point(position: (0.0, 6.0, 0.0), intensity: (30.0, 30.0, 30.0))";
    let floor = "(mesh: Plane(size: (40.0, 40.0)))";
    let [spot, point] = [spot, point].map(|light| draw(&desk, &scene(light, floor), &[]));
    let radius = 6.0 * 20f64.to_radians().tan();
    let half = 25f64.to_radians().tan();
    let (mut inside, mut outside) = (0, 0);
    for y in 0..18 {
        for x in 0..24 {
            let depth = f64::from(spot.depth.pixel(x, y).unwrap()[0]);
            if !depth.is_finite() {
                continue;
            }
            // The camera is 1.5 m up, 6 m from the cone's axis, and looks a little down.
            let (forward, up) = (glam::DVec3::new(0.0, -0.5, -6.0).normalize(), glam::DVec3::Y);
            let right = forward.cross(up).normalize();
            let up = right.cross(forward);
            let along = |at: u32, count: f64| 2.0 * (f64::from(at) + 0.5) / count - 1.0;
            let ray = forward + right * (along(x, 24.0) * half * 24.0 / 18.0) - up * (along(y, 18.0) * half);
            let met = glam::DVec3::new(0.0, 1.5, 6.0) + ray.normalize() * depth;
            assert!(met.y.abs() < 1e-4, "{met}");
            let from_axis = met.x.hypot(met.z);
            let (found, wanted) = (spot.surface.pixel(x, y).unwrap(), point.surface.pixel(x, y).unwrap());
            if from_axis < radius - 1e-3 {
                inside += 1;
                assert!((found[0] / wanted[0] - 1.0).abs() < 1e-5, "{found:?} {wanted:?}");
            } else if from_axis > radius + 1e-3 {
                outside += 1;
                assert_eq!(found, [0.0; 3]);
            }
        }
    }
    assert!(inside > 5 && outside > 100, "{inside} {outside}");
    let dark = |image: &Image| image.data.iter().filter(|value| **value == 0.0).count();
    assert!(dark(&spot.airlight) > 0 && dark(&point.airlight) == 0);
    let more = |(spot, point): (&f32, &f32)| *spot > *point * 1.01;
    assert!(!spot.airlight.data.iter().zip(&point.airlight.data).any(more), "a cone has no more light than all round");
}

#[test]
fn lights_at_odd_places_give_sound_pictures() {
    let desk = Desk::new();
    let lamp = |position: &str| format!("Point(position: {position}, intensity: (20.0, 18.0, 15.0))");
    let text = scene(&lamp("(1, 2, 3)"), FLOOR);
    let places = [
        ("in the camera", "(0.0, 1.5, 6.0)"),
        ("behind the camera", "(0.0, 1.5, 9.0)"),
        ("on the axis of view", "(0.0, 1.25, 3.0)"),
        ("on the floor", "(1.5, 0.0, 1.0)"),
        ("below the floor", "(1.5, -2.0, 1.0)"),
        ("in the sphere", "(0.0, 1.0, 0.0)"),
        ("far away", "(1.0e7, 1.0e7, -1.0e7)"),
    ];
    for (what, place) in places {
        draw(&desk, &text, &[&format!("scene.lights.0.position={place}")]).assert_sound(what);
    }
    for (what, light) in [
        (
            "a spot in the camera",
            "Spot(position: (0.0, 1.5, 6.0), direction: (0.0, -0.5, -6.0), intensity: (9, 9, 9), cutoff: 30)",
        ),
        (
            "a spot of half a sphere",
            "Spot(position: (0, 3, 0), direction: (0, -1, 0), intensity: (9, 9, 9), cutoff: 90)",
        ),
        (
            "a spot of no width",
            "Spot(position: (0, 3, 0), direction: (0, -1, 0), intensity: (9, 9, 9), cutoff: 0.001, exponent: 1000)",
        ),
        ("a lamp with a radius", "Point(position: (0.0, 1.25, 3.0), intensity: (9, 9, 9), radius: 0.5)"),
        ("a sun along the view", "Directional(direction: (0.0, -0.5, -6.0), irradiance: (1, 1, 1))"),
        ("a sun against the view", "Directional(direction: (0.0, 0.5, 6.0), irradiance: (1, 1, 1))"),
    ] {
        draw(&desk, &scene(light, FLOOR), &["scene.medium.phase=HenyeyGreenstein(0.999)"]).assert_sound(what);
    }
}

#[test]
fn odd_media_give_sound_pictures() {
    let desk = Desk::new();
    let text = scene(&format!("{LAMP}, {SPOT}, {SUN}"), FLOOR);
    for set in [
        "scene.medium.extinction=(1e-9, 1e-4, 1e-12)",
        "scene.medium.extinction=(50, 5, 0)",
        "scene.medium.extinction=(1e6, 1e6, 1e6)",
        "scene.medium.albedo=(0, 0, 0)",
        "scene.medium.phase=HenyeyGreenstein(0.9999)",
        "scene.medium.phase=HenyeyGreenstein(-0.9999)",
        "scene.medium.phase=Schlick(0.9999)",
        "scene.medium.phase=CornetteShanks(-0.9999)",
    ] {
        draw(&desk, &text, &[set, "scattered=true"]).assert_sound(set);
    }
}

fn mean(image: &Image) -> f64 {
    image.data.iter().map(|value| f64::from(*value)).sum::<f64>() / image.data.len() as f64
}

/// Lobes narrower than any surface tells apart scatter as much to it, however narrow they are.
#[test]
fn narrow_lobes_light_surfaces_as_much() {
    let desk = Desk::new();
    let text = scene(LAMP, FLOOR);
    let lit = |g: f64| {
        let set = format!("scene.medium.phase=HenyeyGreenstein({g})");
        mean(&draw(&desk, &text, &[&set, "scattered=true", "direct=false"]).surface)
    };
    for (narrow, narrowest) in [(0.9999, 0.999_999_9), (-0.9999, -0.999_999_9)] {
        let (narrow, narrowest) = (lit(narrow), lit(narrowest));
        assert!(narrow > 0.0 && (narrowest / narrow - 1.0).abs() < 0.01, "{narrow} {narrowest}");
    }
}

/// A lamp so far away that nothing of it arrives leaves the others as they are.
#[test]
fn a_far_lamp_in_height_fog_hides_no_other() {
    let desk = Desk::new();
    let airlight = |lights: &str| {
        let medium = MEDIUM.replace("extinction:", "scale_height: 2.0, extinction:");
        desk.put("fog.scene.ron", &format!("({CAMERA}, {medium}, lights: [{lights}], objects: [{FLOOR}])"));
        desk.picture(&shipped("height-fog"), "fog.scene.ron", SIZE, "airlight", &[])
    };
    let far = "Point(position: (3000.0, 2.5, 0.0), intensity: (20.0, 18.0, 15.0))";
    let (one, both) = (airlight(LAMP), airlight(&format!("{far}, {LAMP}")));
    assert!(mean(&one) > 1e-4);
    assert_near(&both, &one, 1e-5);
}

#[test]
fn odd_cameras_and_surfaces_give_sound_pictures() {
    let desk = Desk::new();
    let text = scene(LAMP, FLOOR);
    for (what, settings) in [
        ("a camera in the floor", &["scene.camera.position=(0, 0, 6)", "scene.camera.look_at=(0, 0, 0)"][..]),
        ("a camera in the sphere", &["scene.camera.position=(0, 1, 0.001)", "scene.camera.look_at=(0, 1, -9)"]),
        ("a telescope", &["scene.camera.vertical_fov=0.001"]),
        ("a fisheye", &["scene.camera.vertical_fov=179"]),
        ("far away", &["scene.camera.position=(0, 1.5, 1e6)"]),
    ] {
        let terms = draw(&desk, &text, settings);
        for image in terms.each() {
            assert!(image.data.iter().all(|value| value.is_finite() && *value >= 0.0), "{what}");
        }
    }
    // A plane that reaches the horizon: below it every ray meets the plane at the distance that it must.
    let plane = "(mesh: Plane(size: (1.0e7, 1.0e7)))";
    let terms = draw(&desk, &scene(LAMP, plane), &["scene.camera.look_at=(0, 1.5, 0)"]);
    terms.assert_sound("a plane through the horizon");
    let half = 25f64.to_radians().tan();
    for y in 0..18 {
        let row = 1.0 - 2.0 * (f64::from(y) + 0.5) / 18.0;
        let column: f64 = 1.0 / 24.0 * half * 24.0 / 18.0;
        let slope = row * half;
        let found = f64::from(terms.depth.pixel(12, y).unwrap()[0]);
        if slope < 0.0 {
            let wanted = 1.5 / -slope * (1.0 + slope * slope + column * column).sqrt();
            assert!((found / wanted - 1.0).abs() < 1e-5, "row {y}: {found} {wanted}");
        } else {
            assert!(found.is_infinite(), "row {y}");
        }
    }
}

#[test]
fn scenes_of_nothing_are_drawn() {
    let desk = Desk::new();
    let empty = draw(&desk, &format!("({CAMERA})"), &[]);
    assert!(empty.each().into_iter().all(is_black) && empty.depth.data.iter().all(|depth| depth.is_infinite()));
    let no_lights = draw(&desk, &scene("", FLOOR), &[]);
    assert!(is_black(&no_lights.airlight) && is_black(&no_lights.surface));
    let no_objects = draw(&desk, &scene(LAMP, ""), &[]);
    assert!(is_black(&no_objects.surface) && !is_black(&no_objects.airlight));
    no_objects.assert_sound("no objects");
    let only_background = draw(&desk, &format!("({CAMERA}, {BACKGROUND})"), &[]);
    assert!(only_background.radiance.data.as_chunks::<3>().0.iter().all(|pixel| *pixel == [0.01, 0.02, 0.03]));
}

#[test]
fn exposure_is_a_factor_and_only_the_display_has_it() {
    let desk = Desk::new();
    let text = scene(LAMP, FLOOR);
    let one = draw(&desk, &text, &[]);
    let bright = draw(&desk, &text, &["exposure=3"]);
    for (bright, one) in bright.each().into_iter().zip(one.each()) {
        assert_eq!(metrics::differing_bits(bright, one).unwrap(), 0);
    }
}

/// n·l, the inverse square, attenuation on both legs, and the Phong lobe without a cosine of incidence: by hand.
#[test]
fn a_pixel_of_a_surface_by_hand() {
    let desk = Desk::new();
    let text = "(camera: (position: (0, 3, 0), look_at: (0, 0, 0), up: (0, 0, -1), vertical_fov: 0.01),
        medium: (extinction: (0.1, 0.2, 0.3), albedo: (1, 1, 1)),
        lights: [Point(position: (1.5, 2, 0), intensity: (10, 20, 30))],
        objects: [(mesh: Plane(size: (10, 10)), material: (diffuse: (0.4, 0.5, 0.6), specular: (0.3, 0.2, 0.1), shininess: 4))])";
    let found = draw(&desk, text, &[]).surface.pixel(12, 9).unwrap().to_vec();
    // d² = 1.5² + 2² = 6.25; the mirrored view ray points up, so that cos α = n·l = 2 / 2.5.
    let (distance, cosine) = (2.5f64, 0.8f64);
    let terms = [(0.4, 0.3, 10.0, 0.1), (0.5, 0.2, 20.0, 0.2), (0.6, 0.1, 30.0, 0.3)];
    for (found, (diffuse, specular, intensity, extinction)) in found.into_iter().zip(terms) {
        let reflected = diffuse / std::f64::consts::PI * cosine + specular * cosine.powi(4);
        let wanted: f64 = reflected * intensity * (-extinction * (distance + 3.0)).exp() / (distance * distance);
        assert!((f64::from(found) / wanted - 1.0).abs() < 1e-4, "{found} {wanted}");
    }
}

/// Ambient and emission are added to the whole picture only, by 1 − T; with a surface far away T is known.
#[test]
fn ambient_and_emission_grow_with_what_the_medium_hides() {
    let desk = Desk::new();
    let wall = "(mesh: Box(size: (400, 400, 2)), translation: (0, 0, -100), material: (diffuse: (0, 0, 0)))";
    let text = scene(LAMP, wall);
    let plain = draw(&desk, &text, &[]);
    let sets = ["scene.medium.ambient=(0.5, 0.25, 0.125)", "scene.medium.emission=(1, 2, 3)"];
    let glowing = draw(&desk, &text, &sets);
    assert_near(&glowing.airlight, &plain.airlight, 0.0);
    assert_near(&glowing.surface, &plain.surface, 0.0);
    // albedo 0.9, 0.8, 0.7; extinction 0.05, 0.06, 0.08
    let source = [(0.5 + 0.1, 0.05), (0.25 + 0.4, 0.06), (0.125 + 0.9, 0.08)];
    for (index, depth) in glowing.depth.data.iter().enumerate() {
        for (channel, (radiance, extinction)) in source.into_iter().enumerate() {
            let added = glowing.radiance.data[3 * index + channel] - plain.radiance.data[3 * index + channel];
            let wanted = radiance * -(-extinction * f64::from(*depth)).exp_m1();
            assert!((f64::from(added) / wanted - 1.0).abs() < 1e-4, "{added} {wanted}");
        }
    }
    let sky = draw(&desk, &scene("", ""), &sets);
    for pixel in sky.radiance.data.as_chunks::<3>().0 {
        assert!(pixel.iter().zip(source).all(|(found, (wanted, _))| (f64::from(*found) - wanted).abs() < 1e-6));
    }
}

/// A pass that is right in a homogeneous medium only does not draw height fog, and says so at its place.
#[test]
fn homogeneous_passes_refuse_height_fog() {
    let desk = Desk::new();
    desk.put("fog.scene.ron", &scene(LAMP, FLOOR).replace("extinction", "scale_height: 5, extinction"));
    let drawn = desk.try_draw(&shipped("fog"), "fog.scene.ron", SIZE, &["radiance"], &[]);
    let error = drawn.err().unwrap();
    let messages = error.to_string();
    assert!(matches!(error, Error::Mistakes(_)) && messages.contains("scene-refused"), "{messages}");
    assert!(messages.contains("airlight.homogeneous") && messages.contains("airlight.height_fog"), "{messages}");
    assert!(messages.contains("fog.graph.ron:"), "{messages}");
}

/// The graph of height fog draws the same as the one of homogeneous media where the density does not fall.
#[test]
fn height_fog_without_falloff_is_homogeneous() {
    let desk = Desk::new();
    desk.put("flat.scene.ron", &scene(&format!("{LAMP}, {SPOT}, {SUN}"), FLOOR));
    let draw =
        |graph: &str, settings: &[&str]| desk.picture(&shipped(graph), "flat.scene.ron", SIZE, "radiance", settings);
    let flat = draw("fog", &["scattered=false"]);
    assert_near(&draw("height-fog", &[]), &flat, 2e-3);
    assert_near(&draw("height-fog", &["scene.medium.scale_height=1e7"]), &flat, 2e-3);
    let falling = draw("height-fog", &["scene.medium.scale_height=2"]);
    assert!(metrics::relative_errors(&falling, &flat, 1e-12, None).unwrap().p50 > 0.01);
}

/// A table of 1/(4π) is isotropic, in every pass that asks for the phase function.
#[test]
fn a_measured_function_is_the_function_that_it_holds() {
    let desk = Desk::new();
    let table = desk.path("flat.phase.txt");
    desk.put("flat.phase.txt", "angle value\n0 7\n90 7\n180 7\n");
    desk.put("measured.scene.ron", &scene(&format!("{LAMP}, {SPOT}, {SUN}"), FLOOR));
    for (graph, settings) in [("airlight", &[][..]), ("reference", &["steps=64", "scattered=false", "shadows=false"])] {
        let draw = |phase: &str| {
            let set = format!("scene.medium.phase={phase}");
            let settings: Vec<&str> = settings.iter().copied().chain([set.as_str()]).collect();
            desk.picture(&shipped(graph), "measured.scene.ron", SIZE, "airlight", &settings)
        };
        assert_near(&draw(&format!("Measured({table:?})")), &draw("Isotropic"), 4e-3);
    }
}
