//! The pass that CONTRIBUTING.md builds, built as it says.

use tyndall_image::read;
use tyndall_tests::{Desk, root};

use crate::run::Program;

/// The fenced blocks of a language, in order.
fn blocks(text: &str, language: &str) -> Vec<String> {
    let fence = format!("```{language}\n");
    text.split(&fence).skip(1).map(|rest| rest.split("```").next().unwrap().to_owned()).collect()
}

#[test]
fn the_pass_in_ten_minutes_works() {
    let guide = std::fs::read_to_string(root().join("CONTRIBUTING.md")).unwrap();
    let desk = Desk::new();
    let ([manifest, test], [shader]) = (&blocks(&guide, "ron")[..], &blocks(&guide, "wgsl")[..]) else {
        panic!("one manifest, one test and one shader are expected")
    };
    desk.put("plugins/lens/plugin.ron", manifest);
    desk.put("plugins/lens/falloff.wgsl", shader);
    desk.put("my.test.ron", test);
    let line = guide.split("writes `my.graph.ron`): `").nth(1).unwrap().split('`').next().unwrap();
    let graph = std::fs::read_to_string(desk.path("fog.graph.ron")).unwrap();
    let graph = graph.replace("        \"display\"", &format!("        {line},\n        \"display\""));
    let graph =
        graph.replace("\"radiance\": \"fogged.radiance\" }, params", "\"radiance\": \"lens.darkened\" }, params");
    desk.put("my.graph.ron", &graph.replace("size: (1280, 720)", "size: (640, 480)"));
    let commands = blocks(&guide, "sh").concat();
    assert!(commands.contains("tyndall render") && commands.contains("tyndall test"));
    for command in commands.lines() {
        let command = command.split('#').next().unwrap();
        let arguments: Vec<&str> = command.split_whitespace().skip(1).collect();
        desk.ends(0, &arguments);
    }
    let darkened = read(&desk.path("out/darkened.exr")).unwrap();
    let fogged = read(&desk.path("out/ports/fogged.radiance.exr")).unwrap();
    let through = |x: u32, y: u32| darkened.pixel(x, y).unwrap()[0] / fogged.pixel(x, y).unwrap()[0];
    let (right, bottom) = (darkened.width - 1, darkened.height - 1);
    assert!((through(right / 2, bottom / 2) - 1.0).abs() < 1e-4);
    // The corner of a view of 50 degrees by 4:3.
    let half = 25f64.to_radians().tan();
    let corner = (1.0 + half * half * (1.0 + (4.0f64 / 3.0).powi(2))).powi(-2);
    assert!((f64::from(through(right, bottom)) - corner).abs() < 0.01, "{} {corner}", through(right, bottom));
}
