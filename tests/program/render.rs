//! `render`: which files appear, and what is in them.

use tyndall_image::{Image, metrics, read, read_array};
use tyndall_tests::{Desk, shipped};

use crate::run::Program;

fn image(desk: &Desk, name: &str) -> Image {
    read(&desk.path(name)).unwrap()
}

#[test]
fn without_output_every_graph_output_goes_to_out() {
    let desk = Desk::new();
    let ended = desk.ends(0, &["render", "fog.graph.ron", "--size", "40x30"]);
    let files = ["fog.airlight.exr", "fog.image.png", "fog.radiance.exr", "fog.surface.exr"];
    assert_eq!(desk.files("out"), files);
    for file in files {
        assert!(ended.out.contains(&format!("out/{file}")), "{}", ended.out);
    }
    let radiance = image(&desk, "out/fog.radiance.exr");
    assert_eq!((radiance.width, radiance.height, radiance.channels), (40, 30, 4));
    assert!(radiance.data.iter().all(|value| value.is_finite() && *value >= 0.0));
    assert!(radiance.data.chunks_exact(4).all(|pixel| pixel[3] == 1.0), "alpha is 1, in the sky too");
}

/// Light scattered onto surfaces comes from a table; where nothing feeds it, the switch says so and nothing else changes.
#[test]
fn a_switch_without_its_input_is_told() {
    let desk = Desk::new();
    let graph = std::fs::read_to_string(desk.path("fog.graph.ron")).unwrap();
    let bare = graph.replace(", \"table\": \"lobes.table\"", "");
    assert_ne!(bare, graph);
    desk.put("bare.graph.ron", &bare);
    let draw = |name: &str, more: &[&str]| {
        desk.ends(0, &[&["render", name, "--size", "8x6", "--output", "surface=a.exr"], more].concat()).err
    };
    let messages = draw("bare.graph.ron", &[]);
    assert!(messages.contains("warning[input-needed]") && messages.contains("`table`"), "{messages}");
    let without = image(&desk, "a.exr");
    for quiet in
        [draw("bare.graph.ron", &["--set", "scattered=false"]), draw("fog.graph.ron", &["--set", "scattered=false"])]
    {
        assert!(!quiet.contains("input-needed"), "{quiet}");
        assert_eq!(metrics::differing_bits(&image(&desk, "a.exr"), &without).unwrap(), 0);
    }
    assert!(!draw("fog.graph.ron", &[]).contains("input-needed"));
    assert_ne!(metrics::differing_bits(&image(&desk, "a.exr"), &without).unwrap(), 0);
}

#[test]
fn nothing_of_progress_is_in_a_pipe() {
    let desk = Desk::new();
    let pattern = "radiance=a.####.exr";
    let ended = desk.ends(0, &["render", "fog.graph.ron", "--size", "8x8", "--frames", "2..5", "--output", pattern]);
    assert!(!ended.out.contains(['\r', '\u{1b}']) && !ended.err.contains(['\r', '\u{1b}']));
    let frames: Vec<String> = desk.files("").into_iter().filter(|name| name.ends_with(".exr")).collect();
    assert_eq!(frames, ["a.0002.exr", "a.0003.exr", "a.0004.exr"]);
}

#[test]
fn any_port_can_be_written_in_every_format() {
    let desk = Desk::new();
    let outputs =
        ["surfaces.depth=b/depth.exr", "surfaces.depth=depth.npy", "surfaces.normal=normal.exr", "image=a.exr"];
    let more = ["image=a.png", "fogged.radiance=a.hdr", "radiance=a.npy"];
    let mut arguments = vec!["render", "fog.graph.ron", "--size", "32x20"];
    outputs.iter().chain(&more).for_each(|output| arguments.extend(["--output", output]));
    desk.ends(0, &arguments);
    let depth = image(&desk, "b/depth.exr");
    assert_eq!(depth.channels, 1);
    assert_eq!(read_array(&desk.path("depth.npy")).unwrap().shape, [20, 32]);
    assert_eq!(metrics::differing_bits(&image(&desk, "depth.npy"), &depth).unwrap(), 0);
    assert!(depth.data.contains(&f32::INFINITY), "the sky has no depth");
    let normal = image(&desk, "normal.exr");
    assert_eq!(normal.channels, 3);
    let png = image(&desk, "a.png").first_channels(3);
    let exr = image(&desk, "a.exr").first_channels(3);
    assert_eq!(metrics::absolute(&exr, &png, 1e-5).unwrap().failing, 0, "EXR is linear, PNG is read as sRGB");
    let hdr = image(&desk, "a.hdr");
    assert!(metrics::relative_rmse(&hdr, &image(&desk, "a.npy").first_channels(3)).unwrap() < 0.01);
    assert!(desk.files("out").is_empty());
}

#[test]
fn dump_writes_every_port_of_every_pass() {
    let desk = Desk::new();
    desk.ends(0, &["render", "fog.graph.ron", "--size", "16x12", "--dump", "ports"]);
    let files = desk.files("ports");
    for port in
        ["surfaces.depth", "surfaces.normal", "lit.radiance", "air.radiance", "fogged.radiance", "display.color"]
    {
        assert!(files.contains(&format!("{port}.exr")), "{port} is not in {files:?}");
    }
    assert!(files.contains(&"surfaces.material.npy".to_owned()), "{files:?}");
}

#[test]
fn two_runs_are_bit_equal() {
    let desk = Desk::new();
    for name in ["radiance=a.exr", "radiance=b.exr"] {
        desk.ends(0, &["render", "fog.graph.ron", "--size", "33x21", "--output", name]);
    }
    assert_eq!(metrics::differing_bits(&image(&desk, "a.exr"), &image(&desk, "b.exr")).unwrap(), 0);
}

#[test]
fn the_last_setting_wins_and_a_pass_beats_the_graph() {
    let desk = Desk::new();
    let brightness = |settings: &[&str]| {
        let mut arguments = vec!["render", "fog.graph.ron", "--size", "16x12", "--output", "image=a.exr"];
        settings.iter().for_each(|setting| arguments.extend(["--set", setting]));
        desk.ends(0, &arguments);
        image(&desk, "a.exr").first_channels(3).data.iter().sum::<f32>()
    };
    let once = brightness(&["exposure=0.1"]);
    assert!(brightness(&["exposure=0.2"]) > 1.5 * once);
    assert_eq!(brightness(&["exposure=0.2", "exposure=0.1"]), once);
    assert_eq!(brightness(&["display.exposure=0.1", "exposure=0.2"]), once);
    assert_eq!(brightness(&["exposure=0"]), 0.0);
}

#[test]
fn the_scene_can_be_set_and_light_is_linear_in_intensity() {
    let desk = Desk::new();
    let airlight = |settings: &[&str]| {
        let mut arguments = vec!["render", "fog.graph.ron", "--size", "16x12", "--output", "airlight=a.exr"];
        settings.iter().for_each(|setting| arguments.extend(["--set", setting]));
        desk.ends(0, &arguments);
        image(&desk, "a.exr").first_channels(3)
    };
    let dark = "scene.lights.1.irradiance=(0, 0, 0)";
    let one = airlight(&[dark]);
    let mut two = airlight(&[dark, "scene.lights.0.intensity=(40, 36, 30)"]);
    two.data.iter_mut().for_each(|value| *value /= 2.0);
    assert!(metrics::relative_errors(&two, &one, 1e-9, None).unwrap().max < 1e-5);
    let clear = airlight(&["scene.medium.extinction=(0, 0, 0)"]);
    assert!(clear.data.iter().all(|value| *value == 0.0), "no medium, no airlight");
}

#[test]
fn terms_add_up() {
    let desk = Desk::new();
    let size = ["--size", "24x16"];
    let outputs = ["radiance=r.npy", "airlight=a.npy", "surface=s.npy", "surfaces.depth=d.npy"];
    let mut arguments = vec!["render", "fog.graph.ron", size[0], size[1]];
    outputs.iter().for_each(|output| arguments.extend(["--output", output]));
    desk.ends(0, &arguments);
    let [radiance, airlight, surface] = ["r.npy", "a.npy", "s.npy"].map(|name| image(&desk, name).first_channels(3));
    let depth = image(&desk, "d.npy");
    let mut sky = 0;
    for (index, depth) in depth.data.iter().enumerate() {
        for channel in 0..3 {
            let at = index * 3 + channel;
            let sum = airlight.data[at] + surface.data[at];
            // Nothing of the background comes through an endless medium.
            assert!((radiance.data[at] - sum).abs() <= 1e-6 * sum, "pixel {index}: {} {sum}", radiance.data[at]);
        }
        if depth.is_infinite() {
            sky += 1;
            assert_eq!(surface.data[index * 3..index * 3 + 3], [0.0; 3]);
        }
    }
    assert!(sky > 0 && sky < depth.data.len());
}

#[test]
fn without_a_medium_the_background_is_seen() {
    let desk = Desk::new();
    let set = "scene.medium.extinction=(0, 0, 0)";
    desk.ends(0, &["render", "fog.graph.ron", "--size", "24x16", "--set", set, "--output", "radiance=a.exr"]);
    let top = image(&desk, "a.exr");
    assert_eq!(top.pixel(0, 0).unwrap(), [0.01, 0.02, 0.03, 1.0]);
}

#[test]
fn switches_switch() {
    let desk = Desk::new();
    let surface = |direct: bool, scattered: bool| {
        let (direct, scattered) = (format!("direct={direct}"), format!("scattered={scattered}"));
        let arguments = ["render", "fog.graph.ron", "--size", "16x12", "--output", "surface=a.exr"];
        desk.ends(0, &[&arguments[..], &["--set", &direct, "--set", &scattered]].concat());
        image(&desk, "a.exr").first_channels(3).data
    };
    let (direct, scattered) = (surface(true, false), surface(false, true));
    assert!(surface(false, false).iter().all(|value| *value == 0.0));
    assert!(direct.iter().any(|value| *value > 0.0) && scattered.iter().any(|value| *value > 0.0));
    for ((direct, scattered), both) in direct.iter().zip(&scattered).zip(surface(true, true)) {
        assert!((direct + scattered - both).abs() <= 1e-5 * both, "{direct} + {scattered} is not {both}");
    }
}

#[test]
fn the_march_agrees_with_the_quadrature() {
    let desk = Desk::new();
    let scene = desk.path("test.scene.ron");
    let render = |graph: &str, file: &str, set: &[&str]| {
        let graph = shipped(graph);
        let output = format!("airlight={file}");
        let mut arguments =
            vec!["render", graph.to_str().unwrap(), "--scene", scene.to_str().unwrap(), "--size", "40x30"];
        arguments.extend(["--output", &output]);
        set.iter().for_each(|set| arguments.extend(["--set", set]));
        desk.ends(0, &arguments);
        image(&desk, file).first_channels(3)
    };
    let quadrature = render("airlight", "a.npy", &[]);
    let march = render("reference", "m.npy", &["steps=4096", "shadows=false"]);
    let errors = metrics::relative_errors(&march, &quadrature, 1e-9, None).unwrap();
    assert!(errors.p99 < 1e-3 && errors.max < 2e-2, "{errors:?}");
    let coarse = render("reference", "c.npy", &["steps=4", "shadows=false"]);
    assert!(metrics::relative_errors(&coarse, &quadrature, 1e-9, None).unwrap().p50 > errors.p99);
}
