//! 0 done, 2 the input or the usage is wrong, 3 the machine cannot do it; and nothing is left half-written.

use tyndall_tests::Desk;

use crate::run::Program;

const VERBS: [&str; 10] =
    ["render", "check", "compare", "show", "explain", "passes", "bench", "probe", "adapters", "new"];

#[test]
fn every_verb_has_help() {
    let desk = Desk::new();
    let all = desk.ends(0, &["--help"]);
    for verb in VERBS {
        assert!(all.out.contains(verb), "{verb} is not listed");
        assert!(desk.ends(0, &[verb, "--help"]).out.contains("Usage"), "{verb}");
    }
}

#[test]
fn wrong_command_lines_end_with_2_and_name_what_is_wrong() {
    let desk = Desk::new();
    desk.put("there", "");
    let cases: [(&[&str], &str); 18] = [
        (&[], "Usage"),
        (&["paint"], "paint"),
        (&["render"], "GRAPH"),
        (&["render", "missing.graph.ron"], "missing.graph.ron"),
        (&["render", "."], "."),
        (&["render", "fog.graph.ron", "--scene", "missing.scene.ron"], "missing.scene.ron"),
        (&["render", "fog.graph.ron", "--size", "0x480"], "0"),
        (&["render", "fog.graph.ron", "--size", "640"], "640"),
        (&["render", "fog.graph.ron", "--size", "99999999999x1"], "99999999999"),
        (&["render", "fog.graph.ron", "--set", "nothing=1"], "nothing"),
        (&["render", "fog.graph.ron", "--set", "exposure"], "exposure"),
        (&["render", "fog.graph.ron", "--set", "exposure=\"bright\""], "exposure"),
        (&["render", "fog.graph.ron", "--set", "scene.lights.9.intensity=(1, 1, 1)"], "lights.9"),
        (&["render", "fog.graph.ron", "--output", "nothing=a.exr"], "nothing"),
        (&["render", "fog.graph.ron", "--output", "radiance=a.tiff"], "`.exr`"),
        (&["render", "fog.graph.ron", "--frames", "0..3", "--output", "radiance=a.exr"], "####"),
        (&["render", "fog.graph.ron", "--frames", "3..3"], "3..3"),
        (&["render", "fog.graph.ron", "--size", "8x8", "--output", "radiance=there/a.exr"], "there/a.exr"),
    ];
    for (arguments, part) in cases {
        let ended = desk.ends(2, arguments);
        assert!(ended.err.contains(part), "{arguments:?} does not say {part}: {}", ended.err);
    }
    assert!(desk.files("out").is_empty());
}

#[test]
fn a_folder_is_no_output() {
    let desk = Desk::new();
    std::fs::create_dir(desk.path("a.exr")).unwrap();
    let ended = desk.ends(2, &["render", "fog.graph.ron", "--size", "8x8", "--output", "radiance=a.exr"]);
    assert!(ended.err.contains("a.exr: cannot write: it is a folder"), "{}", ended.err);
}

#[test]
fn what_the_machine_cannot_do_ends_with_3_and_writes_nothing() {
    let desk = Desk::new();
    let ended = desk.ends(3, &["render", "fog.graph.ron", "--adapter", "no such adapter"]);
    let adapters = desk.ends(0, &["adapters"]);
    let first = adapters.out.lines().next().unwrap().split("  ").next().unwrap();
    assert!(ended.err.contains("no such adapter") && ended.err.contains(first), "{}", ended.err);
    desk.ends(3, &["render", "fog.graph.ron", "--size", "100000x100000"]);
    desk.ends(3, &["render", "fog.graph.ron", "--size", "16000x16000"]);
    assert!(desk.files("out").is_empty());
}

#[test]
fn an_adapter_is_found_by_a_part_of_its_name_in_any_case() {
    let desk = Desk::new();
    let adapters = desk.ends(0, &["adapters"]);
    let part: String = adapters.out.chars().take(4).collect::<String>().to_uppercase();
    desk.ends(0, &["render", "fog.graph.ron", "--size", "8x8", "--adapter", &part, "--output", "radiance=a.exr"]);
}

#[cfg(target_os = "linux")]
#[test]
fn a_full_disk_ends_with_3() {
    let ended = Desk::new().ends(3, &["show", "fog.graph.ron", "--svg", "/dev/full"]);
    assert!(ended.err.contains("/dev/full"), "{}", ended.err);
}

#[cfg(unix)]
#[test]
fn a_reader_that_goes_away_is_no_reason_to_panic() {
    use std::process::Stdio;
    let desk = Desk::new();
    desk.put("wrong.graph.ron", "(version: 1, passes: {})");
    let render = ["render", "fog.graph.ron", "--size", "8x8", "--output", "radiance=a.exr"];
    let check = ["check", "wrong.graph.ron", "--format", "json"];
    for arguments in [&["passes"][..], &["passes", "--json"], &["show", "fog.graph.ron"], &["--help"], &render, &check]
    {
        let mut command = desk.command(arguments);
        command.stdout(Stdio::piped()).stderr(Stdio::piped());
        let mut child = command.spawn().unwrap();
        drop(child.stdout.take());
        let output = child.wait_with_output().unwrap();
        let err = String::from_utf8_lossy(&output.stderr).into_owned();
        assert!(!err.contains("panicked"), "{arguments:?}: {err}");
    }
}

#[test]
fn with_several_causes_the_highest_code_counts() {
    let desk = Desk::new();
    let ended = desk.ends(3, &["render", "missing.graph.ron", "--adapter", "no such adapter"]);
    assert!(ended.err.contains("missing.graph.ron") && ended.err.contains("no such adapter"), "{}", ended.err);
    desk.ends(3, &["render", "fog.graph.ron", "--set", "nothing=1", "--adapter", "no such adapter"]);
    let adapters = desk.ends(0, &["adapters"]);
    let name: String = adapters.out.chars().take(4).collect();
    desk.ends(2, &["render", "fog.graph.ron", "--set", "nothing=1", "--adapter", &name]);
}
