//! Files that `render` writes: names of channels, alpha, where the background is, and what a failure leaves behind.

use std::path::Path;

use tyndall_image::{Image, metrics, read, read_array};
use tyndall_tests::{Desk, SCENE};

use crate::run::Program;

fn image(desk: &Desk, name: &str) -> Image {
    read(&desk.path(name)).unwrap()
}

/// `fog.graph.ron` at 16x12 with these further arguments.
fn fog<'a>(more: &[&'a str]) -> Vec<&'a str> {
    ["render", "fog.graph.ron", "--size", "16x12"].iter().chain(more).copied().collect()
}

/// Names of the channels in an EXR file's header, in its order, each with its type: 2 is 32-bit float.
fn channels(path: &Path) -> Vec<(String, u32)> {
    const START: &[u8] = b"channels\0chlist\0";
    let bytes = std::fs::read(path).unwrap();
    let start = bytes.windows(START.len()).position(|part| part == START).unwrap() + START.len() + 4;
    let mut rest = &bytes[start..];
    let mut channels = Vec::new();
    while rest[0] != 0 {
        let end = rest.iter().position(|byte| *byte == 0).unwrap();
        let name = String::from_utf8(rest[..end].to_vec()).unwrap();
        channels.push((name, u32::from_le_bytes(*rest[end + 1..].first_chunk().unwrap())));
        rest = &rest[end + 17..];
    }
    channels
}

#[test]
fn exr_channels_are_named_by_what_they_mean() {
    let desk = Desk::new();
    let ports =
        ["radiance", "airlight", "surface", "image", "surfaces.depth", "surfaces.normal", "surfaces.raster_depth"];
    let outputs: Vec<String> = ports.iter().map(|port| format!("{port}={port}.exr")).collect();
    let mut arguments = fog(&[]);
    outputs.iter().for_each(|output| arguments.extend(["--output", output]));
    desk.ends(0, &arguments);
    for port in ports {
        let wanted: &[&str] = match port {
            "surfaces.depth" | "surfaces.raster_depth" => &["Y"],
            "surfaces.normal" => &["X", "Y", "Z"],
            _ => &["A", "B", "G", "R"],
        };
        let wanted: Vec<(String, u32)> = wanted.iter().map(|name| ((*name).to_owned(), 2)).collect();
        assert_eq!(channels(&desk.path(&format!("{port}.exr"))), wanted, "{port}");
        let image = image(&desk, &format!("{port}.exr"));
        if image.channels == 4 {
            assert!(image.data.as_chunks::<4>().0.iter().all(|pixel| pixel[3] == 1.0), "{port}: alpha is 1, sky too");
        }
    }
    // The sky has no depth, everything else a finite one; normals are unit vectors, and none in the sky.
    let (depth, normal) = (image(&desk, "surfaces.depth.exr"), image(&desk, "surfaces.normal.exr"));
    for (depth, normal) in depth.data.iter().zip(normal.data.as_chunks::<3>().0) {
        let length = normal.iter().map(|part| part * part).sum::<f32>().sqrt();
        assert!(if depth.is_infinite() { length == 0.0 } else { (length - 1.0).abs() < 1e-5 }, "{depth} {normal:?}");
    }
    assert!(depth.data[0] == f32::INFINITY && depth.data.iter().any(|depth| depth.is_finite()));
}

#[test]
fn the_background_is_in_radiance_and_image_alone() {
    let desk = Desk::new();
    let outputs = ["radiance=r.npy", "airlight=a.npy", "surface=s.npy", "image=i.exr"];
    let draw = |background: &str| {
        let clear = "scene.medium.extinction=(0, 0.01, 0)";
        let background = format!("scene.background={background}");
        let mut arguments = fog(&["--set", clear, "--set", &background]);
        outputs.iter().for_each(|output| arguments.extend(["--output", output]));
        desk.ends(0, &arguments);
        ["r.npy", "a.npy", "s.npy", "i.exr"].map(|name| image(&desk, name))
    };
    let (black, red) = (draw("(0, 0, 0)"), draw("(0.5, 0.25, 0)"));
    assert_eq!((black[0].data[0], red[0].data[0]), (0.0, 0.5));
    assert_eq!(red[0].data[1], black[0].data[1], "nothing comes through an endless medium");
    assert!(red[3].data[0] > black[3].data[0]);
    for term in 1..3 {
        assert_eq!(metrics::differing_bits(&black[term], &red[term]).unwrap(), 0);
    }
}

#[test]
fn dump_writes_pictures_as_exr_and_the_rest_as_arrays_beside_the_outputs() {
    let desk = Desk::new();
    desk.ends(0, &fog(&["--dump", "deep/ports"]));
    let files = desk.files("deep/ports");
    let arrays: Vec<&String> = files.iter().filter(|file| !file.ends_with(".exr")).collect();
    assert_eq!(arrays, ["lobes.table.npy", "surfaces.material.npy"], "{files:?}");
    assert_eq!(read_array(&desk.path("deep/ports/surfaces.material.npy")).unwrap().shape, [2, 12, 16, 4]);
    assert_eq!(desk.files("out").len(), 4, "outputs are written without --output, whatever else is");
    let (port, output) = (image(&desk, "deep/ports/fogged.radiance.exr"), image(&desk, "out/fog.radiance.exr"));
    assert_eq!(metrics::differing_bits(&port, &output).unwrap(), 0);
    desk.ends(0, &fog(&["--dump", "frames", "--frames", "1..3", "--output", "radiance=r.####.npy"]));
    assert_eq!(desk.files("frames"), ["0001", "0002"]);
    assert_eq!(desk.files("frames/0002"), files);
}

#[test]
fn outputs_are_exr_but_the_image() {
    let desk = Desk::new();
    let graph = std::fs::read_to_string(desk.path("fog.graph.ron")).unwrap();
    let more = "\"image\": \"display.color\", \"preview\": \"display.color\", \"far\": \"surfaces.depth\", \"stuff\": \"surfaces.material\"";
    desk.put("more.graph.ron", &graph.replace("\"image\": \"display.color\"", more));
    desk.ends(0, &["render", "more.graph.ron", "--size", "8x8"]);
    let files = [
        "more.airlight.exr",
        "more.far.exr",
        "more.image.png",
        "more.preview.exr",
        "more.radiance.exr",
        "more.stuff.npy",
        "more.surface.exr",
    ];
    assert_eq!(desk.files("out"), files);
}

#[test]
fn nothing_is_drawn_where_an_output_cannot_be() {
    let desk = Desk::new();
    for wrong in ["surfaces.material=m.exr", "image=a.jpeg", "image=a", "nothing=a.exr", "radiance="] {
        desk.ends(2, &fog(&["--output", "radiance=first.exr", "--output", wrong]));
        assert!(!desk.path("first.exr").exists(), "{wrong}");
    }
    let ended = desk.ends(2, &fog(&["--output", "radience=a.exr"]));
    assert!(ended.err.contains("did you mean `radiance`"), "{}", ended.err);
    let ended = desk.ends(2, &fog(&["--output", "air.radianse=a.exr"]));
    assert!(ended.err.contains("air.radiance"), "{}", ended.err);
}

#[test]
fn what_was_there_stays_where_a_render_fails() {
    let desk = Desk::new();
    desk.put("a.exr", "old");
    desk.put("broken.scene.ron", "(lights: [Point(position: (0, NaN, 0))])");
    desk.ends(2, &fog(&["--scene", "broken.scene.ron", "--output", "radiance=a.exr"]));
    desk.ends(3, &["render", "fog.graph.ron", "--size", "100000x100000", "--output", "radiance=a.exr"]);
    desk.ends(3, &fog(&["--adapter", "no such adapter", "--output", "radiance=a.exr"]));
    assert_eq!(std::fs::read_to_string(desk.path("a.exr")).unwrap(), "old");
    assert_eq!(desk.files(""), ["a.exr", "broken.scene.ron", "fog.graph.ron", "test.scene.ron"], "and nothing else");
    desk.ends(0, &fog(&["--output", "radiance=a.exr"]));
    assert_eq!(image(&desk, "a.exr").width, 16, "a sound render replaces it");
    assert_eq!(desk.files("").len(), 4, "no temporary file is left");
}

#[cfg(target_os = "linux")]
#[test]
fn a_folder_that_takes_no_file_ends_with_2() {
    // Nobody may write there, not even root.
    let ended = Desk::new().ends(2, &fog(&["--output", "radiance=/proc/a.exr"]));
    assert!(ended.err.contains("/proc/a.exr"), "{}", ended.err);
}

#[test]
fn the_size_is_of_the_command_line_then_of_the_graph_then_640_by_480() {
    let desk = Desk::new();
    let graph = std::fs::read_to_string(desk.path("fog.graph.ron")).unwrap();
    desk.put("own.graph.ron", &graph.replace("(1280, 720)", "(20, 10)"));
    desk.put("none.graph.ron", &graph.replace("    size: (1280, 720),\n", ""));
    let size = |arguments: &[&str]| {
        let all: Vec<&str> = arguments.iter().chain(&["--output", "surfaces.depth=d.npy"]).copied().collect();
        desk.ends(0, &all);
        let image = image(&desk, "d.npy");
        (image.width, image.height)
    };
    assert_eq!(size(&["render", "own.graph.ron"]), (20, 10));
    assert_eq!(size(&["render", "own.graph.ron", "--size", "7x5"]), (7, 5));
    assert_eq!(size(&["render", "none.graph.ron"]), (640, 480));
    assert_eq!(size(&["render", "own.graph.ron", "--size", "1x1"]), (1, 1));
    for wrong in ["0x0", "0x5", "5x0", "5", "x", "5x", "-5x5", "5.5x5", "5x5x5", "4294967296x1", ""] {
        desk.ends(2, &["render", "own.graph.ron", "--size", wrong]);
        desk.ends(2, &["show", "own.graph.ron", "--size", wrong]);
    }
    desk.put("zero.graph.ron", &graph.replace("(1280, 720)", "(0, 720)"));
    desk.ends(2, &["check", "zero.graph.ron"]);
}

#[test]
fn paths_of_a_graph_are_relative_to_it_and_those_of_the_command_line_to_here() {
    let desk = Desk::new();
    let graph = std::fs::read_to_string(desk.path("fog.graph.ron")).unwrap();
    desk.put("graphs/deep.graph.ron", &graph.replace("test.scene.ron", "scenes/own.scene.ron"));
    desk.put("graphs/scenes/own.scene.ron", SCENE);
    desk.put("black.scene.ron", "(camera: (position: (0, 0, 5), look_at: (0, 0, 0)))");
    let draw = |more: &[&str]| {
        let arguments = ["render", "graphs/deep.graph.ron", "--size", "8x8", "--output", "airlight=here.npy"];
        desk.ends(0, &arguments.iter().chain(more).copied().collect::<Vec<_>>());
        image(&desk, "here.npy")
    };
    assert!(draw(&[]).data.iter().all(|value| *value > 0.0));
    assert!(draw(&["--scene", "black.scene.ron"]).data.iter().all(|value| *value == 0.0));
    desk.ends(2, &["render", "graphs/deep.graph.ron", "--scene", "own.scene.ron"]);
}

#[test]
fn frame_n_is_at_n_24ths_of_a_second() {
    let desk = Desk::new();
    let keys = "Keys([(0.0, (1.0, 2.5, 0.0)), (1.0, (3.0, 2.5, 2.0))])";
    let moving = SCENE.replace("position: (1.0, 2.5, 0.0)", &format!("position: {keys}"));
    assert_ne!(moving, SCENE);
    desk.put("moving.scene.ron", &moving);
    let output = ["--output", "airlight=a.####.npy"];
    desk.ends(0, &fog(&["--scene", "moving.scene.ron", "--frames", "11..14", output[0], output[1]]));
    let files = desk.files("").into_iter().filter(|name| name.ends_with(".npy")).collect::<Vec<_>>();
    assert_eq!(files, ["a.0011.npy", "a.0012.npy", "a.0013.npy"]);
    for (frame, place) in [("a.0012.npy", "(2, 2.5, 1)"), ("a.0011.npy", "(1.9166667, 2.5, 0.9166667)")] {
        let set = format!("scene.lights.0.position={place}");
        desk.ends(0, &fog(&["--set", &set, "--output", "airlight=still.npy"]));
        let errors = metrics::relative_errors(&image(&desk, frame), &image(&desk, "still.npy"), 1e-9, None).unwrap();
        assert!(errors.max < 1e-4, "{frame}: {errors:?}");
    }
    let apart = metrics::relative_errors(&image(&desk, "a.0011.npy"), &image(&desk, "a.0013.npy"), 1e-9, None).unwrap();
    assert!(apart.p50 > 1e-3, "the lamp moves: {apart:?}");
    // One frame needs no number; by itself it is the same as in a row.
    desk.ends(0, &fog(&["--scene", "moving.scene.ron", "--frames", "12..13", "--output", "airlight=one.npy"]));
    assert_eq!(metrics::differing_bits(&image(&desk, "one.npy"), &image(&desk, "a.0012.npy")).unwrap(), 0);
    desk.ends(2, &fog(&["--frames", "12..14", "--output", "airlight=one.npy"]));
}

/// Whatever the paths look like: nothing is drawn before that is known.
#[test]
fn two_outputs_do_not_go_to_one_file() {
    let desk = Desk::new();
    std::fs::create_dir(desk.path("sub")).unwrap();
    std::os::unix::fs::symlink("sub", desk.path("link")).unwrap();
    let absolute = desk.path("same.exr");
    let pair = |one: &str, other: &str, more: &[&str]| {
        let outputs = [format!("radiance={one}"), format!("surfaces.depth={other}")];
        let mut arguments = fog(more);
        outputs.iter().for_each(|output| arguments.extend(["--output", output]));
        let ended = desk.ends(2, &arguments);
        assert!(ended.err.contains("two outputs go to "), "{one} {other}: {}", ended.err);
        assert!(desk.files("sub").is_empty() && !absolute.exists());
    };
    for other in
        ["same.exr", "./same.exr", ".//same.exr", "sub/../same.exr", "new/../same.exr", absolute.to_str().unwrap()]
    {
        pair("same.exr", other, &[]);
    }
    pair("sub/a.exr", "link/a.exr", &[]);
    pair("q####.exr", "./q####.exr", &["--frames", "0..2"]);
    pair("q####.exr", "q#####.exr", &["--frames", "9999..10001"]);
    let dumped = fog(&["--dump", "sub", "--output", "radiance=sub/surfaces.depth.exr"]);
    assert!(desk.ends(2, &dumped).err.contains("two outputs go to "));
    let dumped = fog(&["--dump", "sub", "--frames", "0..2", "--output", "radiance=sub/####/surfaces.depth.exr"]);
    assert!(desk.ends(2, &dumped).err.contains("two outputs go to "));
    let shown = ["show", "fog.graph.ron", "--svg", "a", "--dot", "./a"];
    assert!(desk.ends(2, &shown).err.contains("two outputs go to "));
    assert!(desk.files("sub").is_empty());
}
