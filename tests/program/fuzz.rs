//! Input that nobody means, and that might end a process at once: whatever it is, the program ends with 0, 2 or 3, without a
//! panic, a stack that overflows or memory that runs out. `cargo xtask fuzz` has many more rounds, within one process.

use tyndall_tests::broken::{Random, mutate};
use tyndall_tests::{Desk, SCENE};

use crate::run::Program;

#[track_caller]
fn ends_well(desk: &Desk, what: &str, arguments: &[&str]) -> i32 {
    let ended = desk.run(arguments);
    assert!([0, 2, 3].contains(&ended.code), "{what}: {arguments:?} ended with {}: {}", ended.code, ended.err);
    ended.code
}

fn check_and_draw(desk: &Desk, what: &str) {
    if ends_well(desk, what, &["check", "fog.graph.ron", "--format", "json"]) == 0 {
        ends_well(desk, what, &["render", "fog.graph.ron", "--size", "8x8", "--output", "radiance=a.npy"]);
    }
}

/// How often each kind of file is broken.
const ROUNDS: usize = 6;

#[test]
fn broken_files() {
    let desk = Desk::new();
    let graph = std::fs::read(desk.path("fog.graph.ron")).unwrap();
    for (name, sound) in [("fog.graph.ron", graph.as_slice()), ("test.scene.ron", SCENE.as_bytes())] {
        let mut random = Random(0x9e37_79b9_7f4a_7c15);
        for round in 0..ROUNDS {
            let bytes = mutate(&mut random, sound);
            desk.put(name, &bytes);
            check_and_draw(&desk, &format!("{name} {round}: {}", String::from_utf8_lossy(&bytes)));
        }
        desk.put(name, sound);
    }
}

/// Values within values, so deep that a reader which calls itself runs out of stack.
#[test]
fn deep_files() {
    let desk = Desk::new();
    const DEEP: usize = 200_000;
    for (open, close) in [("(", ")"), ("[", "]"), ("{\"a\": ", "}"), ("Some(", ")"), ("/*", "*/"), ("-", "")] {
        let deep = open.repeat(DEEP) + &close.repeat(DEEP);
        desk.put("deep.graph.ron", &deep);
        desk.ends(2, &["check", "deep.graph.ron"]);
        desk.put("deep.scene.ron", &format!("(camera: {deep})"));
        desk.ends(2, &["check", "deep.scene.ron"]);
    }
}

/// More than any memory holds.
#[test]
fn huge_requests() {
    let desk = Desk::new();
    let render = ["render", "fog.graph.ron", "--size"];
    for size in ["4294967295x4294967295", "1000000x1000000", "4294967295x1"] {
        ends_well(&desk, size, &[&render[..], &[size]].concat());
    }
    for set in ["scene.objects.0.mesh=Sphere(radius: 1e38)", "scene.objects.1.mesh=Plane(size: (1e308, 1e308))"] {
        ends_well(&desk, set, &[&render[..], &["8x8", "--set", set, "--output", "radiance=a.npy"]].concat());
    }
}

#[test]
fn odd_command_lines() {
    const WORDS: [&str; 44] = [
        "render",
        "check",
        "show",
        "explain",
        "passes",
        "bench",
        "probe",
        "adapters",
        "new",
        "graph",
        "scene",
        "fog.graph.ron",
        "test.scene.ron",
        "missing",
        ".",
        "",
        "--size",
        "8x8",
        "0x8",
        "999999999x1",
        "--set",
        "exposure=2",
        "exposure=\u{fffd}",
        "scene.lights.0=()",
        "scene..=1",
        "--output",
        "radiance=a.exr",
        "=",
        "--dump",
        "ports",
        "--frames",
        "0..2",
        "5..1",
        "--adapter",
        "llvm",
        "--format",
        "json",
        "--json",
        "a.json",
        "--keep",
        "--vary",
        "exposure=0..1",
        "--plugin-path",
        "--help",
    ];
    let desk = Desk::new();
    // Small and without tables, as the graph's own values are often all that is left to go by.
    let graph = std::fs::read_to_string(desk.path("fog.graph.ron")).unwrap();
    assert!(graph.contains("\"scattered\": true") && graph.contains("(1280, 720)"));
    desk.put(
        "fog.graph.ron",
        &graph.replace("\"scattered\": true", "\"scattered\": false").replace("(1280, 720)", "(12, 8)"),
    );
    let mut random = Random(0x1234_5678_9abc_def1);
    for _ in 0..120 {
        let count = random.below(7);
        let mut words: Vec<&str> = (0..count).map(|_| random.of(&WORDS)).collect();
        if random.below(3) > 0 {
            words.insert(0, random.of(&WORDS[..9]));
            words.insert(1, "fog.graph.ron");
        }
        ends_well(&desk, "command line", &words);
    }
}

#[cfg(unix)]
#[test]
fn arguments_that_are_no_text() {
    use std::ffi::OsStr;
    use std::os::unix::ffi::OsStrExt;
    let desk = Desk::new();
    let odd = OsStr::from_bytes(b"\xff\xfe.graph.ron");
    for arguments in [
        &["render"][..],
        &["check"],
        &["render", "fog.graph.ron", "--set"],
        &["render", "fog.graph.ron", "--scene"],
        &["new", "graph"],
    ] {
        let output = desk.command(arguments).arg(odd).output().unwrap();
        let err = String::from_utf8_lossy(&output.stderr).into_owned();
        assert!(
            [Some(0), Some(2)].contains(&output.status.code()) && !err.contains("panicked"),
            "{arguments:?}: {err}"
        );
    }
}
