//! Volumetric shadows: against reference data that this project did not compute, and where casters,
//! lights and eye stand as badly as they can.

use std::path::{Path, PathBuf};

use tyndall_image::Image;
use tyndall_image::metrics::relative_errors;
use tyndall_tests::{Desk, Samples, reference, sessions, shipped, sum_error, text};

const SCENES: [&str; 3] = ["box", "sphere", "box_sphere"];

/// The project promises p95 0.5 %, p99 1 % and 0.5 % of the sum. Measured are 8e-5, 1.1e-4 and 8e-6; the sphere is made of
/// triangles here, and of none in the reference.
const P99: f64 = 1e-3;
const MAX: f64 = 6e-3;
const SUM: f64 = 1e-4;

fn render(desk: &Desk, graph: &str, name: &str, term: &str) -> Image {
    let scene = reference(&format!("{name}.scene.ron"));
    desk.picture(&shipped(graph), scene, (160, 120), term, &["scattered=false"])
}

fn volumetric(desk: &Desk, name: &str, term: &str) -> Image {
    render(desk, "volumetric-shadows", name, term)
}

/// What was computed of shadows elsewhere; the scenes are those of other light, too.
fn shadowed(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/reference").join(name)
}

fn samples(name: &str, term: &str) -> Samples {
    Samples::read(&shadowed(&format!("{name}.{term}.npy")))
}

fn error_of_sum(name: &str, picture: &Image) -> f64 {
    sum_error(&shadowed("sums.json"), name, picture)
}

#[test]
fn shadowed_airlight_agrees_with_the_reference() {
    let desk = Desk::new();
    for name in SCENES {
        let picture = volumetric(&desk, name, "airlight");
        let sum = error_of_sum(name, &picture);
        let errors = samples(name, "shadowed").errors(&picture);
        println!("{name}: p50 {:.1e}, p99 {:.1e}, max {:.1e}, sum {sum:.1e}", errors.p50, errors.p99, errors.max);
        assert!(errors.p99 <= P99 && errors.max <= MAX && sum <= SUM, "{name}: {errors:?}, sum {sum:e}");
        let unshadowed = render(&desk, "fog", name, "airlight");
        let ignored = samples(name, "shadowed").errors(&unshadowed);
        assert!(ignored.p99 > 0.02 && error_of_sum(name, &unshadowed) > 0.01, "{ignored:?}");
        let brighter = picture.data.iter().zip(&unshadowed.data).filter(|(a, b)| a > b).count();
        assert_eq!(brighter, 0, "{name} is brighter than without shadows");
    }
}

#[test]
fn shadowed_surfaces_agree_with_the_reference() {
    let desk = Desk::new();
    for name in SCENES {
        let errors = samples(name, "shadowed_surface").errors(&volumetric(&desk, name, "surface"));
        println!("{name}: p50 {:.1e}, p99 {:.1e}, max {:.1e}", errors.p50, errors.p99, errors.max);
        assert!(errors.p99 <= P99 && errors.max <= MAX, "{name}: {errors:?}");
        let unshadowed = render(&desk, "fog", name, "surface");
        assert!(samples(name, "shadowed_surface").errors(&unshadowed).p99 > 1.0, "no pixel of {name} is dark");
    }
}

/// A scene over a floor, of what the camera and the lights are, and of objects.
fn scene(camera: &str, lights: &str, objects: &str) -> String {
    format!(
        "(
            camera: ({camera}, vertical_fov: 50.0),
            medium: (extinction: (0.1, 0.1, 0.1), albedo: (0.9, 0.9, 0.9), phase: HenyeyGreenstein(g: 0.3)),
            lights: [{lights}],
            objects: [{objects}],
        )"
    )
}

const CAMERA: &str = "position: (0.0, 1.5, 5.0), look_at: (0.0, 1.0, 0.0)";
const FLOOR: &str = "(mesh: Plane(size: (30.0, 30.0))),";

/// The airlight with shadows and without them. 49 pixels across, so that one column looks straight ahead.
fn pair(desk: &Desk, text: &str) -> [Image; 2] {
    desk.put("test.scene.ron", text);
    let pictures = ["volumetric-shadows", "fog"]
        .map(|graph| desk.picture(&shipped(graph), "test.scene.ron", (49, 37), "airlight", &["scattered=false"]));
    let [shadowed, unshadowed] = &pictures;
    for (a, b) in shadowed.data.iter().zip(&unshadowed.data) {
        // a part of a ray is summed at other nodes than the whole, and sums of single precision are rounded
        assert!(a.is_finite() && *a >= 0.0 && *a <= b * (1.0 + 4e-6), "{a} of {b} in {text}");
    }
    pictures
}

fn lamp(position: &str) -> String {
    format!("Point(position: {position}, intensity: (20.0, 20.0, 20.0)),")
}

fn mean(picture: &Image) -> f64 {
    picture.data.iter().map(|value| f64::from(*value)).sum::<f64>() / picture.data.len() as f64
}

#[test]
fn a_light_inside_a_caster_lights_nothing_outside() {
    let desk = Desk::new();
    let objects = format!("{FLOOR} (mesh: Box(size: (0.6, 0.6, 0.6)), translation: (0.2, 1.2, 0.0)),");
    let [shadowed, _] = pair(&desk, &scene(CAMERA, &lamp("(0.2, 1.2, 0.0)"), &objects));
    assert!(shadowed.data.iter().all(|value| *value == 0.0));
    // And an eye that is inside with it sees all of the light.
    let camera = "position: (0.35, 1.3, 0.2), look_at: (0.0, 1.1, 0.0)";
    let [shadowed, unshadowed] = pair(&desk, &scene(camera, &lamp("(0.2, 1.2, 0.0)"), &objects));
    assert_eq!(shadowed.data, unshadowed.data);
    // An eye in a box has shadow before it up to the walls, and the light is outside.
    let [shadowed, unshadowed] = pair(&desk, &scene(camera, &lamp("(3.0, 2.0, 1.0)"), &objects));
    assert!(shadowed.data.iter().all(|value| *value == 0.0) && mean(&unshadowed) > 0.0);
}

/// A lamp on a ceiling or a floor shines: a rounding error must not decide on which side it is.
#[test]
fn a_light_on_a_surface_shines() {
    let desk = Desk::new();
    for (y, near) in [("3.3", "3.2999"), ("0.0", "0.0001"), ("1.9", "1.8999")] {
        let objects = format!(
            "(mesh: Plane(size: (30.0, 30.0)), translation: (0.0, {y}, 0.0)), (mesh: Box(size: (0.5, 0.4, 0.5)), translation: (0.3, 1.0, 1.0)),"
        );
        let of = |y: &str| pair(&desk, &scene(CAMERA, &lamp(&format!("(-0.6, {y}, -0.4)")), &objects));
        let ([on, all], [beside, _]) = (of(y), of(near));
        assert!((mean(&on) / mean(&beside) - 1.0).abs() < 0.01, "{y}: {} {}", mean(&on), mean(&beside));
        assert!(mean(&on) > 0.5 * mean(&all));
    }
}

/// A floor hides a lamp that is a millimetre below it, however far it reaches, and all of the air above it is dark.
#[test]
fn a_lamp_close_below_a_floor_is_hidden() {
    let desk = Desk::new();
    for (size, depth) in [("40.0", 1e-4), ("400.0", 1e-4), ("4000.0", 1e-3)] {
        for tilt in [0.0_f64, 0.3] {
            let floor = format!(
                "(mesh: Plane(size: ({size}, {size})), rotation: (axis: (0.0, 0.0, 1.0), angle: {})),",
                tilt.to_degrees()
            );
            let lamp_at = |height: f64| lamp(&format!("({}, {}, -0.4)", -height * tilt.sin(), height * tilt.cos()));
            let [below, all] = pair(&desk, &scene(CAMERA, &lamp_at(-depth), &floor));
            println!("{size} m tilted by {tilt}: {:e}", mean(&below) / mean(&all));
            assert!(mean(&below) < 1e-6 * mean(&all), "{size} m tilted by {tilt}: {} of {}", mean(&below), mean(&all));
            let [above, all] = pair(&desk, &scene(CAMERA, &lamp_at(depth), &floor));
            assert!(mean(&above) > 0.99 * mean(&all), "{size} m tilted by {tilt}: {} of {}", mean(&above), mean(&all));
        }
    }
}

/// The eye is in the plane of a face, of an edge and the lamp, and in the middle of it all; one column of pixels looks along
/// these planes. What is seen is what is seen from a little beside, on one side or the other. The last lamp is on a face, too.
#[test]
fn an_eye_on_planes_sees_what_is_beside() {
    let desk = Desk::new();
    let boxes = "(mesh: Box(size: (1.0, 1.0, 1.0)), translation: (0.5, 1.0, 0.0)), (mesh: Box(size: (0.5, 0.5, 0.5)), translation: (-0.25, 2.0, 1.0)),";
    for (lamp_at, height) in [("(0.0, 3.0, -1.0)", "1.5"), ("(0.0, 3.0, 0.5)", "1.5"), ("(0.0, 1.85, 0.9)", "1.5")] {
        let of = |x: &str| {
            let camera = format!("position: ({x}, {height}, 5.0), look_at: ({x}, {height}, 0.0)");
            pair(&desk, &scene(&camera, &lamp(lamp_at), &format!("{FLOOR} {boxes}")))
        };
        let [[left, _], [on, all], [right, _]] = ["-0.0002", "0.0", "0.0002"].map(of);
        let close = |a: f32, b: f32| f64::from((a - b).abs()) <= 0.01 * f64::from(b) + 1e-3 * mean(&all);
        let sides = left.data.iter().zip(&right.data);
        let odd = on.data.iter().zip(sides).filter(|(on, (a, b))| !close(**on, **a) && !close(**on, **b)).count();
        assert!(odd * 100 <= on.data.len(), "{lamp_at}: {odd} of {}", on.data.len());
    }
}

/// Mean of the rows from one to before another.
fn rows(picture: &Image, from: usize, to: usize) -> f64 {
    let row = picture.width as usize * picture.channels as usize;
    let part = &picture.data[from * row..to * row];
    part.iter().map(|value| f64::from(*value)).sum::<f64>() / part.len() as f64
}

/// An eye on a floor sees light above the horizon and none below it, as one little above; one below it sees none at all,
/// however near it is, and however far the floor reaches. No picture shows what is nearer than a micrometre.
#[test]
fn an_eye_on_a_floor() {
    let desk = Desk::new();
    let objects = "(mesh: Box(size: (1.2, 1.0, 1.0)), translation: (-1.0, 1.4, -5.7)),";
    // On the diagonal of the floor, where its triangles meet, and beside it; lamps and a sun.
    for (x, z, light) in [
        (0.0, 0.0, lamp("(-1.7, 3.3, -7.2)")),
        (0.3, -1.1, lamp("(-1.7, 3.3, -7.2)")),
        (0.3, -1.1, "Directional(direction: (0.4, -1.0, 0.3), irradiance: (1.0, 1.0, 1.0)),".to_owned()),
    ] {
        let seen = |size: &str, y: f64| {
            let camera = format!("position: ({x:?}, {y:?}, {z:?}), look_at: ({x:?}, {y:?}, -7.0)");
            let floor = format!("(mesh: Plane(size: ({size}, {size}))), {objects}");
            pair(&desk, &scene(&camera, &light, &floor))
        };
        let ([above, _], [under, all]) = (seen("40.0", 1e-4), seen("40.0", -1e-4));
        for y in [0.0, 1e-8, 2e-7, 1e-6] {
            let [on, _] = seen("40.0", y);
            let (up, down) = (rows(&on, 0, 18), rows(&on, 19, 37));
            // Beyond the far edge of the floor there is light again.
            let (expected, most) = (rows(&above, 0, 18), rows(&under, 19, 37));
            println!("{x} {y:e}: {up:e} of {expected:e}, {down:e} of {most:e}");
            assert!((up / expected - 1.0).abs() < 1e-3 && down <= 1.001 * most, "{y:e}: {up:e}, {down:e}");
            assert!(most < 0.3 * rows(&all, 19, 37), "{most:e}");
        }
        for (size, y) in [("40.0", -1e-6), ("40.0", -1e-3), ("4000.0", -2e-4), ("1e6", -0.05)] {
            let [below, _] = seen(size, y);
            let (up, down) = (rows(&below, 0, 18), rows(&below, 19, 37));
            let (whole, most) = (rows(&above, 0, 18), rows(&under, 19, 37));
            assert!(up < 1e-6 * whole && down <= 1.001 * most, "{size} {y:e}: {up:e}, {down:e} of {most:e}");
        }
    }
}

/// An eye on a wall of a box sees what is before the wall, and no light within; one in the wall sees none.
#[test]
fn an_eye_on_a_face_of_a_box() {
    let desk = Desk::new();
    let seen = |x: f64| {
        let camera = format!("position: ({x:?}, 1.8, 0.3), look_at: ({x:?}, 1.2, -7.0)");
        let wall = "(mesh: Box(size: (2.0, 20.0, 20.0)), translation: (1.0, 0.0, 0.0)),";
        pair(&desk, &scene(&camera, &lamp("(-1.7, 3.3, -7.2)"), wall))
    };
    let side = |picture: &Image, columns: std::ops::Range<usize>| {
        let (width, channels) = (picture.width as usize, picture.channels as usize);
        let chosen = |index: &usize| columns.contains(&(index / channels % width));
        (0..picture.data.len()).filter(chosen).map(|index| f64::from(picture.data[index])).sum::<f64>()
    };
    let [beside, _] = seen(-1e-3);
    for x in [0.0, -1e-7] {
        let [on, _] = seen(x);
        let (left, right, expected) = (side(&on, 0..24), side(&on, 25..49), side(&beside, 0..24));
        assert!(
            (left / expected - 1.0).abs() < 1e-3 && right < 1e-5 * expected,
            "{x:e}: {left:e} {right:e} {expected:e}"
        );
    }
    let [inside, all] = seen(1e-6);
    assert!(mean(&inside) < 1e-6 * mean(&all), "{:e}", mean(&inside));
}

/// Many small parts of a caster far away: slices are narrow where they are, and no ray looks at more than it can.
#[test]
fn a_tree_far_away() {
    let desk = Desk::new();
    let graph = shipped("volumetric-shadows");
    let tree = graph.parent().unwrap().join("scenes/shadows/models/tree.glb");
    desk.put(
        "far.scene.ron",
        &format!(
            "(
                camera: (position: (0.0, 3.0, 300.0), look_at: (0.0, 3.2, 0.0), vertical_fov: 1.2),
                medium: (extinction: (0.01, 0.01, 0.01), phase: HenyeyGreenstein(g: 0.5)),
                lights: [Directional(direction: (1.0, -0.7, 0.1), irradiance: (1.0, 1.0, 1.0))],
                objects: [(mesh: File({:?})), (mesh: Plane(size: (400.0, 400.0)))],
            )",
            tree.to_str().unwrap()
        ),
    );
    let drawn = desk.try_draw(&graph, "far.scene.ron", (80, 60), &["airlight"], &[]).unwrap();
    assert!(drawn.warnings.is_empty(), "{}", text(&drawn.warnings));
}

/// Nodes err, and of parts less than of the whole: still no ray is brighter than without shadows, which `pair` asks.
#[test]
fn shadows_make_nothing_brighter() {
    let desk = Desk::new();
    let caster = |index: u32| {
        let turn = f64::from(index) * 2.4;
        let [x, y, z] = [1.6 * turn.cos(), 1.6 + 0.9 * (1.7 * turn).sin(), 1.2 * turn.sin() - 0.6];
        format!(
            "(mesh: Box(size: (0.3, 0.05, 0.4)), translation: ({x:?}, {y:?}, {z:?}), rotation: (axis: (1.0, 0.4, 0.2), angle: {:?})),",
            50.0 * turn
        )
    };
    // One of them in the beam of the narrow spot.
    let in_beam = "(mesh: Box(size: (0.04, 0.04, 0.04)), translation: (-0.46, 2.14, -0.4)),";
    let objects: String = (0..24).map(caster).collect::<String>() + FLOOR + in_beam;
    let spot = |exponent: f64, cutoff: f64| {
        format!(
            "Spot(position: (-0.7, 2.3, -1.2), direction: (0.3, -0.2, 1.0), intensity: (100.0, 100.0, 100.0), exponent: {exponent:?}, cutoff: {cutoff:?}),"
        )
    };
    let lamp_there = lamp("(-0.7, 2.3, -1.2)");
    for (light, extinction, g) in [
        (lamp_there.clone(), 2.0, -0.9),
        (lamp_there.clone(), 2.0, 0.0),
        (lamp_there.clone(), 0.02, 0.95),
        (spot(64.0, 5.0), 0.1, 0.75),
        (spot(8.0, 30.0), 0.1, 0.75),
        (spot(8.0, 30.0) + &lamp_there, 0.3, -0.9),
    ] {
        let text = scene(CAMERA, &light, &objects)
            .replace("(0.1, 0.1, 0.1)", &format!("({extinction:?}, {extinction:?}, {extinction:?})"))
            .replace("g: 0.3", &format!("g: {g:?}"));
        let [shadowed, unshadowed] = pair(&desk, &text);
        assert!(mean(&shadowed) < 0.999 * mean(&unshadowed), "no shadow: {} {}", mean(&shadowed), mean(&unshadowed));
    }
}

/// A caster of no area, as thin as a rounding error, far away, or nowhere in view casts nothing that is seen, and neither does what is not
/// to cast.
#[test]
fn casters_of_no_consequence() {
    let desk = Desk::new();
    let light = lamp("(-0.6, 2.5, -0.4)");
    let [_, unshadowed] = pair(&desk, &scene(CAMERA, &light, FLOOR));
    for caster in [
        "(mesh: Box(size: (1e-30, 1e-30, 1e-30)), translation: (0.2, 1.2, 0.5)),",
        "(mesh: Plane(size: (1e-12, 1e-12)), translation: (0.2, 1.2, 0.5)),",
        "(mesh: Box(size: (1.0, 1.0, 1.0)), translation: (0.0, 1e6, 0.0)),",
        "(mesh: Box(size: (1.0, 1.0, 1.0)), translation: (0.0, -3.0, 0.0)),",
    ] {
        let [shadowed, _] = pair(&desk, &scene(CAMERA, &light, &format!("{FLOOR} {caster}")));
        assert!(shadowed.data == unshadowed.data, "{caster}");
    }
    let box_of = |casts: bool| {
        format!("{FLOOR} (mesh: Box(size: (0.6, 0.6, 0.6)), translation: (0.2, 1.2, 0.5), casts_shadow: {casts}),")
    };
    let [without, all] = pair(&desk, &scene(CAMERA, &light, &box_of(false)));
    let [with, _] = pair(&desk, &scene(CAMERA, &light, &box_of(true)));
    assert!(without.data == all.data && mean(&with) < 0.995 * mean(&all));
}

/// Keys move a caster and a lamp: each frame is the picture of the scene as it is then.
#[test]
fn shadows_follow_what_moves() {
    let desk = Desk::new();
    let moving = |at: &str, lamp_at: &str| {
        let objects = format!("{FLOOR} (mesh: Box(size: (0.6, 0.6, 0.6)), translation: {at}),");
        scene(CAMERA, &lamp(lamp_at), &objects)
    };
    let keys = moving(
        "Keys([(0.0, (-1.0, 1.0, 0.0)), (1.0, (1.0, 1.5, 0.0))])",
        "Keys([(0.0, (0.0, 3.0, 0.0)), (1.0, (1.0, 2.5, -1.0))])",
    );
    desk.put("keys.scene.ron", &keys);
    let request = desk.request(
        &shipped("volumetric-shadows"),
        Some(Path::new("keys.scene.ron")),
        Some((49, 37)),
        &["scattered=false"],
    );
    let frames = sessions().with(|session| session.draw(&request, &["airlight"], 11..13)).unwrap().unwrap();
    let [before, frame] = frames.pictures.try_into().unwrap();
    let [still, unshadowed] = pair(&desk, &moving("(0.0, 1.25, 0.0)", "(0.5, 2.75, -0.5)"));
    let errors = relative_errors(&frame, &still, 1e-3 * mean(&still), None).unwrap();
    assert!(errors.max <= 1e-4, "{errors:?}");
    let moved = relative_errors(&before, &still, 1e-3 * mean(&still), None).unwrap();
    assert!(moved.max > 1e-2 && mean(&still) < 0.995 * mean(&unshadowed));
}
