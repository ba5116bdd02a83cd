//! Input that nobody means: whatever it is, the program ends with 0, 2 or 3 and without a panic.

use crate::plugins::{GRAPH, MANIFEST, SHADER};
use crate::run::{Desk, SCENE, shipped};

/// Small, and the same on every machine.
struct Random(u64);

impl Random {
    fn below(&mut self, end: usize) -> usize {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        (self.0 % end.max(1) as u64) as usize
    }

    fn of<'a, T: ?Sized>(&mut self, choices: &[&'a T]) -> &'a T {
        choices[self.below(choices.len())]
    }
}

const BITS: [&[u8]; 24] = [
    b"(",
    b")",
    b"[",
    b"]",
    b"{",
    b"}",
    b"\"",
    b",",
    b":",
    b"NaN",
    b"-inf",
    b"1e400",
    b"99999999999999999999",
    b"-",
    b"$x",
    b"/*",
    b"//",
    b"r#\"",
    b"\\u{110000}",
    b"\xff\xfe",
    b"\0",
    b"Some(",
    b"Keys([(0.0, ",
    b"..",
];
const NUMBERS: [&str; 10] = ["0.0", "-1.0", "1e38", "1e-45", "1e308", "NaN", "inf", "4294967296", "()", "\"a\""];

fn mutate(random: &mut Random, bytes: &[u8]) -> Vec<u8> {
    let mut bytes = bytes.to_vec();
    for _ in 0..1 + random.below(3) {
        let at = random.below(bytes.len());
        match random.below(6) {
            0 if !bytes.is_empty() => bytes[at] = random.below(256) as u8,
            1 => drop(bytes.drain(at..(at + 1 + random.below(20)).min(bytes.len()))),
            2 => drop(bytes.splice(at..at, random.of(&BITS).iter().copied())),
            3 => {
                let from = random.below(bytes.len());
                let part = bytes[from..(from + random.below(60)).min(bytes.len())].to_vec();
                bytes.splice(at..at, part);
            }
            4 if random.below(4) == 0 => bytes.truncate(at),
            _ => replace_a_number(random, &mut bytes),
        }
    }
    bytes
}

/// A number for another: what is still sound in form, and so gets further.
fn replace_a_number(random: &mut Random, bytes: &mut Vec<u8>) {
    let is_digit = |byte: &u8| byte.is_ascii_digit() || *byte == b'.';
    let at = random.below(bytes.len());
    let Some(start) = bytes.iter().skip(at).position(is_digit).map(|found| at + found) else { return };
    let end = bytes.iter().skip(start).position(|byte| !is_digit(byte)).map_or(bytes.len(), |found| start + found);
    bytes.splice(start..end, random.of(&NUMBERS).bytes());
}

#[track_caller]
fn ends_well(desk: &Desk, what: &str, arguments: &[&str]) -> i32 {
    let ended = desk.run(arguments);
    assert!([0, 2, 3].contains(&ended.code), "{what}: {arguments:?} ended with {}: {}", ended.code, ended.err);
    ended.code
}

/// How often each kind of file is broken. Drawing needs a device, so it is only done where `check` finds nothing.
const ROUNDS: usize = 60;

fn check_and_draw(desk: &Desk, what: &str) {
    if ends_well(desk, what, &["check", "fog.graph.ron", "--format", "json"]) == 0 {
        ends_well(desk, what, &["render", "fog.graph.ron", "--size", "8x8", "--output", "radiance=a.npy"]);
    }
}

fn put(desk: &Desk, name: &str, bytes: &[u8], what: &str) {
    std::fs::write(desk.path(name), bytes).unwrap_or_else(|error| panic!("{what}: {error}"));
}

#[test]
fn broken_graphs() {
    let desk = Desk::new();
    let sound = std::fs::read(desk.path("fog.graph.ron")).unwrap();
    let mut random = Random(0x9e37_79b9_7f4a_7c15);
    for round in 0..ROUNDS {
        let bytes = mutate(&mut random, &sound);
        put(&desk, "fog.graph.ron", &bytes, "graph");
        check_and_draw(&desk, &format!("graph {round}: {}", String::from_utf8_lossy(&bytes)));
    }
}

#[test]
fn broken_scenes() {
    let desk = Desk::new();
    let mut random = Random(0x2545_f491_4f6c_dd1d);
    for round in 0..ROUNDS {
        let bytes = mutate(&mut random, SCENE.as_bytes());
        put(&desk, "test.scene.ron", &bytes, "scene");
        check_and_draw(&desk, &format!("scene {round}: {}", String::from_utf8_lossy(&bytes)));
    }
}

#[test]
fn broken_models() {
    let desk = Desk::new();
    let pavilion = shipped("fog").parent().unwrap().join("scenes/models/pavilion.glb");
    let sound = std::fs::read(pavilion).unwrap();
    let length = u32::from_le_bytes(*sound[12..].first_chunk().unwrap()) as usize;
    let (head, json, rest) = (&sound[..20], &sound[20..20 + length], &sound[20 + length..]);
    desk.put(
        "test.scene.ron",
        "(camera: (position: (0, 2, 9), look_at: (0, 1, 0)), objects: [(mesh: File(\"a.glb\"))])",
    );
    let mut random = Random(0xd1b5_4a32_d192_ed03);
    for round in 0..ROUNDS {
        let bytes = if random.below(3) == 0 {
            mutate(&mut random, &sound)
        } else {
            // Of the same length, so that what is wrong is not only that.
            let mut broken = mutate(&mut random, json);
            broken.resize(length, b' ');
            [head, &broken, rest].concat()
        };
        put(&desk, "a.glb", &bytes, "model");
        check_and_draw(&desk, &format!("model {round}"));
    }
}

#[test]
fn broken_plugins() {
    let desk = Desk::new();
    desk.put("fog.graph.ron", GRAPH);
    let mut random = Random(0x0bad_5eed_cafe_f00d);
    for round in 0..2 * ROUNDS {
        let manifest = round % 2 == 0;
        let bytes = mutate(&mut random, if manifest { MANIFEST } else { SHADER }.as_bytes());
        desk.put("plugins/tint/plugin.ron", MANIFEST);
        desk.put("plugins/tint/invert.wgsl", SHADER);
        let name = if manifest { "plugins/tint/plugin.ron" } else { "plugins/tint/invert.wgsl" };
        put(&desk, name, &bytes, "plugin");
        check_and_draw(&desk, &format!("plugin {round}: {}", String::from_utf8_lossy(&bytes)));
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
    // Small, as the graph's size is often all that is left to go by.
    let graph = std::fs::read_to_string(desk.path("fog.graph.ron")).unwrap();
    desk.put("fog.graph.ron", &graph.replace("(1280, 720)", "(12, 8)"));
    let mut random = Random(0x1234_5678_9abc_def1);
    for _ in 0..2 * ROUNDS {
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
