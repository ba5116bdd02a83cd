//! Light outdoors: `aerial-perspective.graph.ron` against reference data, against double precision,
//! and at its limits.

use std::path::Path;

use glam::DVec3;
use tyndall_aerial::atmosphere::Atmosphere;
use tyndall_gpu::GpuError;
use tyndall_image::{Image, metrics};
use tyndall_render::Error;
use tyndall_shaders::ray::ray_of_pixel;
use tyndall_shaders::scene::Camera;
use tyndall_tests::{Desk, Samples, shipped};

/// The terms of a picture.
struct Terms {
    airlight: Image,
    surface: Image,
    radiance: Image,
    transmittance: Image,
    depth: Image,
    lit: Image,
}

fn draw(desk: &Desk, scene: impl AsRef<Path>, size: (u32, u32), settings: &[&str]) -> Terms {
    let ports = ["airlight", "surface", "radiance", "transmittance.attenuated", "surfaces.depth", "lit.radiance"];
    let [airlight, surface, radiance, transmittance, depth, lit] =
        desk.draw(&shipped("aerial-perspective"), scene, size, ports, settings);
    Terms { airlight, surface, radiance, transmittance, depth, lit }
}

#[track_caller]
fn assert_near(found: &Image, wanted: &Image, tolerance: f64) {
    let errors = metrics::relative_errors(found, wanted, 1e-12, None).unwrap();
    assert!(errors.max <= tolerance, "{errors:?}");
}

fn is_black(image: &Image) -> bool {
    image.data.iter().all(|value| *value == 0.0)
}

/// Of the airlight, in the middle.
fn red_over_blue(terms: &Terms) -> f32 {
    let pixel = terms.airlight.pixel(6, 4).unwrap();
    pixel[0] / pixel[2]
}

/// A wall across the view at this distance, in the light of a sun at the left behind the eye.
fn wall(distance: f64) -> String {
    let size = 100.0 * distance;
    format!(
        "(camera: (position: (0, 10, 0), look_at: (0, 10, -1), vertical_fov: 30),
          background: (0.5, 0.25, 0.125),
          lights: [Directional(direction: (0.6, -0.5, -0.7), irradiance: (20, 18, 15))],
          objects: [(mesh: Plane(size: ({size:?}, {size:?})), rotation: (axis: (1, 0, 0), angle: 90), translation: (0, 10, -{distance:?}))])"
    )
}

fn at_wall(desk: &Desk, distance: f64, settings: &[&str]) -> Terms {
    desk.put("wall.scene.ron", &wall(distance));
    draw(desk, "wall.scene.ron", (12, 8), settings)
}

fn sky(desk: &Desk, settings: &[&str]) -> Terms {
    let settings: Vec<&str> = ["scene.objects=[]"].into_iter().chain(settings.iter().copied()).collect();
    at_wall(desk, 1.0, &settings)
}

/// Measured: 1e-5 at most, of an optical depth of 10 in f32.
#[test]
fn every_term_agrees_with_the_reference() {
    let desk = Desk::new();
    let reference = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/reference");
    let mie = "atmosphere.mie=(2e-5, 2e-5, 2e-5)";
    let errors = |settings: &[&str]| {
        let Terms { airlight, surface, radiance, transmittance, .. } =
            draw(&desk, reference.join("aerial.scene.ron"), (160, 120), settings);
        let terms =
            [("airlight", airlight), ("surface", surface), ("radiance", radiance), ("transmittance", transmittance)];
        terms.map(|(term, picture)| {
            (term, Samples::read(&reference.join(format!("aerial.{term}.npy"))).errors(&picture))
        })
    };
    for (term, errors) in errors(&[mie]) {
        println!("{term}: p50 {:.1e}, p99 {:.1e}, max {:.1e}", errors.p50, errors.p99, errors.max);
        assert!(errors.p99 <= 2e-5 && errors.max <= 5e-5, "{term}: {errors:?}");
    }
    // The same comparison must fail where the air, the phase function or the light is wrong.
    for wrong in [
        "atmosphere.mie=(2.01e-5, 2.01e-5, 2.01e-5)",
        "atmosphere.g=(0.75, 0.75, 0.75)",
        "atmosphere.absorption=(1e-7, 1e-7, 1e-7)",
        "sunlight=\"space\"",
        "sky=\"dome\"",
    ] {
        let [(_, errors), ..] = errors(&[mie, wrong]);
        assert!(errors.max > 5e-5, "{wrong} passes: {errors:?}");
    }
}

/// All that a graph can choose at once: two suns, one of them low, in dusty air that absorbs, from space, a sky dome.
#[test]
fn every_pixel_agrees_with_double_precision() {
    const SIZE: [u32; 2] = [48, 36];
    let desk = Desk::new();
    let suns = [
        (DVec3::new(0.3, -0.5, 0.6), DVec3::new(20.0, 19.0, 18.0)),
        (DVec3::new(-0.5, -0.05, 0.4), DVec3::new(3.0, 2.0, 1.0)),
    ];
    let lights = suns.map(|(d, e)| {
        format!(
            "Directional(direction: ({:?}, {:?}, {:?}), irradiance: ({:?}, {:?}, {:?}))",
            d.x, d.y, d.z, e.x, e.y, e.z
        )
    });
    desk.put(
        "mars.scene.ron",
        &format!(
            "(camera: (position: (0, 100, 0), look_at: (0, 110, -100), vertical_fov: 60), lights: [{}],
              objects: [(mesh: Plane(size: (200000, 200000)))])",
            lights.join(", ")
        ),
    );
    let terms = draw(&desk, "mars.scene.ron", (48, 36), &["preset=\"mars\"", "sky=\"dome\"", "sunlight=\"space\""]);
    let air = Atmosphere {
        rayleigh: DVec3::new(1.6e-7, 2.7e-7, 5.6e-7),
        mie: DVec3::new(4.51e-5, 3.99e-5, 3.35e-5),
        absorption: DVec3::new(2.3e-6, 6.4e-6, 1.18e-5),
        g: DVec3::new(0.730, 0.765, 0.816),
        rayleigh_height: 11_000.0,
        mie_height: 11_000.0,
        dome: true,
        from_space: true,
    }
    .air();
    let forward = DVec3::new(0.0, 10.0, -100.0).normalize();
    let half = 30f64.to_radians().tan();
    let up = DVec3::X.cross(forward) * half;
    let camera = Camera {
        position: DVec3::new(0.0, 100.0, 0.0),
        nearest: 1e-6,
        right: DVec3::X * half * 4.0 / 3.0,
        up,
        forward,
    };
    let all: DVec3 = suns.iter().map(|(_, e)| *e).sum();
    let left: DVec3 = suns.iter().map(|(d, e)| *e * air.sunlight(d.normalize())).sum::<DVec3>() / all;
    let (mut skies, mut grounds) = (0, 0);
    for (x, y) in (0..SIZE[1]).flat_map(|y| (0..SIZE[0]).map(move |x| (x, y))) {
        let ray = ray_of_pixel(&camera, [x, y], SIZE).direction;
        let depth = f64::from(terms.depth.pixel(x, y).unwrap()[0]);
        let s = air.way(ray, depth);
        let airlight: DVec3 = suns.iter().map(|(d, e)| air.in_scattering(d.normalize(), *e, ray, s)).sum();
        let pixel = |image: &Image| {
            let channels = image.pixel(x, y).unwrap();
            DVec3::new(f64::from(channels[0]), f64::from(channels[1]), f64::from(channels[2]))
        };
        let near = |found: DVec3, wanted: DVec3| {
            ((found - wanted) / wanted.max(DVec3::splat(1e-12))).abs().max_element() < 1e-4
        };
        assert!(near(pixel(&terms.airlight), airlight), "{x}, {y}: {} {airlight}", pixel(&terms.airlight));
        let lit = pixel(&terms.lit) * left * air.extinction_factor(s);
        assert!(near(pixel(&terms.surface), lit), "{x}, {y}: {} {lit}", pixel(&terms.surface));
        if depth.is_infinite() { skies += 1 } else { grounds += 1 }
    }
    assert!(skies > 200 && grounds > 200, "{skies} {grounds}");
}

#[test]
fn at_no_distance_there_is_no_air_and_at_any_the_horizon() {
    let desk = Desk::new();
    let sky = sky(&desk, &[]);
    let near = at_wall(&desk, 0.01, &[]);
    assert_near(&near.surface, &near.lit, 1e-5);
    let most = |image: &Image| image.data.iter().copied().fold(0.0, f32::max);
    assert!(most(&near.airlight) < 1e-5 * most(&sky.airlight) && most(&near.airlight) > 0.0);
    // What is far enough cannot be told from the sky.
    let far = at_wall(&desk, 1e7, &[]);
    assert_near(&far.airlight, &sky.airlight, 1e-6);
    assert_near(&far.radiance, &sky.radiance, 1e-6);
    assert!(is_black(&far.surface) && is_black(&far.transmittance) && !is_black(&near.surface));
    // With a dome the horizon is not endless, but nearly.
    let dome =
        self::sky(&desk, &["sky=\"dome\"", "scene.camera.look_at=(0, 10, -1)", "scene.camera.vertical_fov=0.001"]);
    let endless = self::sky(&desk, &["scene.camera.vertical_fov=0.001"]);
    assert_near(&dome.airlight, &endless.airlight, 2e-4);
}

#[test]
fn a_way_in_two_parts_gives_the_same() {
    let desk = Desk::new();
    let [near, far, both] = [3000.0, 9000.0, 12_000.0].map(|distance| at_wall(&desk, distance, &[]));
    let mut sum = near.airlight.clone();
    for (index, value) in sum.data.iter_mut().enumerate() {
        *value += near.transmittance.data[index] * far.airlight.data[index];
    }
    assert_near(&both.airlight, &sum, 1e-5);
    let product = near.transmittance.data.iter().zip(&far.transmittance.data).map(|(a, b)| a * b).collect();
    let product = Image { data: product, ..near.transmittance };
    assert_near(&both.transmittance, &product, 1e-5);
    // L = L_in + F_ex L_0
    let mut whole = both.airlight.clone();
    for (index, value) in whole.data.iter_mut().enumerate() {
        *value += both.transmittance.data[index] * both.lit.data[index];
    }
    assert_near(&both.radiance, &whole, 1e-6);
}

/// Isotropic air without absorption sends on all that it takes, into 4π: an endless way shows E/(4π), whatever there is
/// of it; where half is absorbed, half of that.
#[test]
fn no_more_is_scattered_than_is_lost() {
    let desk = Desk::new();
    let isotropic = ["atmosphere.rayleigh=(0, 0, 0)", "atmosphere.g=(0, 0, 0)"];
    for (mie, absorption, share) in [("1e-5", "0", 1.0), ("3e-3", "0", 1.0), ("1e-5", "1e-5", 0.5)] {
        let (mie, absorption) = (
            format!("atmosphere.mie=({mie}, {mie}, {mie})"),
            format!("atmosphere.absorption=({absorption}, {absorption}, {absorption})"),
        );
        let terms = sky(&desk, &[isotropic[0], isotropic[1], &mie, &absorption]);
        for pixel in terms.airlight.data.as_chunks::<3>().0 {
            for (found, e) in pixel.iter().zip([20.0, 18.0, 15.0]) {
                let wanted = share * e / (4.0 * std::f64::consts::PI);
                assert!((f64::from(*found) / wanted - 1.0).abs() < 1e-5, "{found} {wanted}");
            }
        }
    }
}

#[test]
fn without_air_the_background_is_seen_and_without_a_sun_nothing_else() {
    let desk = Desk::new();
    let none = ["rayleigh", "mie", "absorption"].map(|name| format!("atmosphere.{name}=(0, 0, 0)"));
    let none: Vec<&str> = none.iter().map(String::as_str).collect();
    for sky_is in ["sky=\"endless\"", "sky=\"dome\""] {
        let settings: Vec<&str> = none.iter().copied().chain([sky_is]).collect();
        let terms = sky(&desk, &settings);
        assert!(is_black(&terms.airlight));
        assert!(terms.radiance.data.as_chunks::<3>().0.iter().all(|pixel| *pixel == [0.5, 0.25, 0.125]));
    }
    // Endless air hides it; through a dome some of it is seen.
    assert_near(&sky(&desk, &[]).radiance, &sky(&desk, &[]).airlight, 1e-7);
    let zenith = ["sky=\"dome\"", "scene.camera.look_at=(0, 99, -1)", "scene.lights=[]"];
    let seen = sky(&desk, &zenith);
    assert!(is_black(&seen.airlight));
    assert!(seen.radiance.data.as_chunks::<3>().0.iter().all(|[r, _, b]| (0.3..0.5).contains(r) && *b < 0.1));
    let lamp = "scene.lights=[Point(position: (0, 12, -5), intensity: (20, 18, 15))]";
    assert!(is_black(&sky(&desk, &[lamp]).airlight), "only directional lights shine on air");
}

#[test]
fn a_sun_that_has_set_gives_no_light_from_space_and_all_of_it_on_the_ground() {
    let desk = Desk::new();
    let below = "scene.lights.0.direction=(0.6, 0.5, -0.7)";
    let space = at_wall(&desk, 5000.0, &[below, "sunlight=\"space\""]);
    assert!(is_black(&space.airlight) && is_black(&space.surface) && !is_black(&space.lit));
    assert!(!is_black(&at_wall(&desk, 5000.0, &[below]).airlight));
    // The lower, the redder.
    let at = |y: &str| {
        let set = format!("scene.lights.0.direction=(0.6, {y}, -0.7)");
        red_over_blue(&at_wall(&desk, 5000.0, &[&set, "sunlight=\"space\""]))
    };
    assert!(at("-0.05") > 2.0 * at("-0.3") && at("-0.3") > at("-2"));
}

#[test]
fn light_is_linear_in_irradiance() {
    let desk = Desk::new();
    let one = at_wall(&desk, 5000.0, &["sunlight=\"space\""]);
    let two = at_wall(&desk, 5000.0, &["sunlight=\"space\"", "scene.lights.0.irradiance=(40, 36, 30)"]);
    let doubled = |image: &Image| Image { data: image.data.iter().map(|value| 2.0 * value).collect(), ..image.clone() };
    assert_near(&two.radiance, &doubled(&one.radiance), 1e-6);
}

#[test]
fn a_preset_is_one_word_and_each_of_its_values_can_be_given() {
    let desk = Desk::new();
    let draw = |settings: &[&str]| at_wall(&desk, 8000.0, settings).radiance;
    let clear = draw(&[]);
    let all: Vec<Image> =
        ["clear", "hazy", "overcast", "mars"].map(|name| draw(&[&format!("preset=\"{name}\"")])).into();
    assert_eq!(metrics::differing_bits(&clear, &all[0]).unwrap(), 0);
    for (index, one) in all.iter().enumerate() {
        assert!(all[..index].iter().all(|other| metrics::differing_bits(one, other).unwrap() > 0));
    }
    let by_hand = draw(&[
        "atmosphere.rayleigh=(1.6e-7, 2.7e-7, 5.6e-7)",
        "atmosphere.mie=(4.51e-5, 3.99e-5, 3.35e-5)",
        "atmosphere.absorption=(2.3e-6, 6.4e-6, 1.18e-5)",
        "atmosphere.g=(0.730, 0.765, 0.816)",
    ]);
    assert_eq!(metrics::differing_bits(&by_hand, &all[3]).unwrap(), 0, "the heights do not matter here");
    let one_of_it = draw(&["preset=\"mars\"", "atmosphere.g=(0.76, 0.76, 0.76)"]);
    assert!(metrics::differing_bits(&one_of_it, &all[3]).unwrap() > 0);
    // Bluish toward the sun, reddish-brown away from it.
    let with_sun = |direction: &str| {
        let set = format!("scene.lights.0.direction={direction}");
        red_over_blue(&sky(&desk, &["preset=\"mars\"", "scene.lights.0.irradiance=(1, 1, 1)", &set]))
    };
    assert!(with_sun("(0, -0.05, 1)") < 0.7 && with_sun("(0, -0.05, -1)") > 1.4);
}

#[test]
fn what_air_cannot_be_is_refused() {
    let desk = Desk::new();
    desk.put("wall.scene.ron", &wall(100.0));
    for (set, hint) in [
        ("atmosphere.g=(1, 0, 0)", "`g` must be between"),
        ("atmosphere.g=(0, -1, 0)", "`g` must be between"),
        ("atmosphere.g=(0, 0, 1.5)", "`g` must be between"),
        ("atmosphere.mie=(-1e-5, 0, 0)", "`mie` must be between"),
        ("atmosphere.rayleigh=(0, -1, 0)", "`rayleigh` must be between"),
        ("atmosphere.absorption=(inf, 0, 0)", "inf"),
        ("atmosphere.mie_height=-1", "`mie_height` must be between"),
        ("atmosphere.mie=1e-5", "3 numbers"),
        ("preset=\"marz\"", "did you mean `mars`?"),
        ("atmosphere.preset=\"cler\"", "did you mean `clear`?"),
        ("sky=\"dom\"", "did you mean `dome`?"),
        ("atmosphere.sunlight=\"spice\"", "did you mean `space`?"),
        ("atmosphere.beta=1", "no parameter `beta`"),
    ] {
        let drawn = desk.try_draw(&shipped("aerial-perspective"), "wall.scene.ron", (12, 8), &["radiance"], &[set]);
        let Err(error) = drawn else { panic!("{set} is drawn") };
        let is_input = matches!(error, Error::Mistakes(_) | Error::Gpu(GpuError::Input { .. }));
        assert!(is_input && error.to_string().contains(hint), "{set}: {error}");
    }
    for set in ["atmosphere.g=(0.99999994, -0.99999994, 0)", "atmosphere.mie=(1e6, 1e-12, 0)"] {
        let terms = at_wall(&desk, 8000.0, &[set]);
        assert!(terms.radiance.data.iter().all(|value| value.is_finite() && *value >= 0.0), "{set}");
    }
}
