//! `test` and `diff`: what they say, and how they end.

use tyndall_image::{Image, Meaning};
use tyndall_tests::{Desk, SCENE};

use crate::run::{Ended, Program};

/// A desk with the fog graph and a test of it that has been blessed.
fn blessed() -> Desk {
    let desk = Desk::new();
    test(&desk, "\"*.radiance\": (golden: RelativeRmse(1e-5)), \"display.*\": (golden: Flip(mean: 0.005))");
    desk.ends(0, &["test", "--bless"]);
    desk
}

fn test(desk: &Desk, taps: &str) {
    let text = format!(
        "(version: 1, graph: \"fog.graph.ron\", size: (24, 16), set: {{ \"scattered\": false }}, taps: {{ {taps} }})"
    );
    desk.put("fog.test.ron", &text);
}

fn last_line(ended: &Ended) -> &str {
    ended.out.lines().last().unwrap_or_default()
}

#[test]
fn a_missing_golden_fails_and_the_command_that_blesses_it_works() {
    let desk = Desk::new();
    test(&desk, "\"air.radiance\": (golden: RelativeRmse(1e-5))");
    let failed = desk.ends(1, &["test"]);
    assert_eq!(last_line(&failed), "0 passed, 1 failed");
    assert!(failed.out.contains("there is no golden"), "{}", failed.out);
    let command = failed.out.split("bless just this: tyndall ").nth(1).unwrap().lines().next().unwrap();
    desk.ends(0, &command.split(' ').collect::<Vec<_>>());
    assert_eq!(desk.files("fog.goldens"), ["air.radiance.exr", "goldens.ron"]);
    assert_eq!(last_line(&desk.ends(0, &["test"])), "1 passed, 0 failed");
}

/// Half the density: light on surfaces and airlight both change, whatever follows only inherits, and the scene is named.
#[test]
fn half_the_density_is_noticed() {
    let desk = blessed();
    desk.put("test.scene.ron", &SCENE.replace("(0.05, 0.06, 0.08)", "(0.025, 0.03, 0.04)"));
    let failed = desk.ends(1, &["test", "--json", "figures.json"]);
    assert!(failed.out.contains("first diverging pass: `lit` (surface_radiance.phong)"), "{}", failed.out);
    assert!(failed.out.contains("air.radiance  golden") && failed.out.contains("inherited: `fogged`, `display`"));
    assert!(failed.out.contains("the golden is stale: scene changed"), "{}", failed.out);
    let figures: serde_json::Value =
        serde_json::from_slice(&std::fs::read(desk.path("figures.json")).unwrap()).unwrap();
    assert_eq!(figures["failed"], 1);
    assert_eq!(figures["tests"][0]["first_diverging_pass"], "lit");
    assert_eq!(figures["tests"][0]["diverging"], serde_json::json!(["lit", "air"]));
    let junit = std::fs::read_to_string(desk.path("figures.xml")).unwrap();
    assert!(junit.contains("failures=\"1\"") && junit.contains("first diverging pass: lit"), "{junit}");
    let over = desk.ends(2, &["test", "--json", "figures.xml"]);
    assert!(over.err.contains("call them .json") && over.out.is_empty(), "{}", over.err);
    assert_eq!(std::fs::read_to_string(desk.path("figures.xml")).unwrap(), junit);
}

/// For whatever is wrong continuous integration has a message of its own.
#[test]
fn every_kind_of_failure_has_its_own_message() {
    let desk = blessed();
    let junit = |desk: &Desk| {
        desk.run(&["test", "--json", "figures.json"]);
        std::fs::read_to_string(desk.path("figures.xml")).unwrap()
    };
    desk.put("fog.goldens/unknown.exr", "");
    let orphan = junit(&desk);
    assert!(orphan.contains("<failure message=\"no tap claims the golden `fog.goldens/unknown.exr`"), "{orphan}");
    std::fs::remove_file(desk.path("fog.goldens/unknown.exr")).unwrap();
    std::fs::remove_file(desk.path("fog.goldens/air.radiance.exr")).unwrap();
    let missing = junit(&desk);
    assert!(missing.contains("<failure message=\"air.radiance: there is no golden"), "{missing}");
    test(&desk, "\"aire.radiance\": (golden: Exact)");
    let wrong = junit(&desk);
    assert!(wrong.contains("errors=\"1\"") && wrong.contains("<error message=\"empty-pattern: "), "{wrong}");
    desk.put("plugins/half/plugin.ron", "(name: \"half\", version: \"0.1.0\", about: \"half\", passes: { \"half\": (about: \"writes half of it\", shader: \"half.wgsl\", ports: { \"result\": (about: \"it\", size: Frame(1.0), disabled: Constant(0.0, 0.0, 0.0, 1.0)) }) })");
    desk.put("plugins/half/half.wgsl", "var result: texture_storage_2d<rgba32float, write>;\n@compute @workgroup_size(8, 8) fn main(@builtin(global_invocation_id) id: vec3<u32>) { if id.x < 8u { textureStore(result, id.xy, vec4<f32>(1.0)); } }");
    desk.put("half.graph.ron", "(version: 1, size: (24, 16), passes: { \"start\": (use: \"half.half\") }, outputs: { \"end\": \"start.result\" })");
    desk.put(
        "fog.test.ron",
        "(version: 1, graph: \"half.graph.ron\", size: (24, 16), taps: { \"*\": (properties: [NonNegative]) })",
    );
    std::fs::remove_dir_all(desk.path("fog.goldens")).unwrap();
    desk.run(&["test", "--poison", "--json", "figures.json"]);
    let poisoned = std::fs::read_to_string(desk.path("figures.xml")).unwrap();
    assert!(
        poisoned.contains("<failure message=\"`start.result` came out different again from poisoned"),
        "{poisoned}"
    );
}

/// A test that has nothing but goldens has not passed where these are left out, and a run of such tests alone fails.
#[test]
fn what_checks_nothing_has_not_passed() {
    let desk = blessed();
    let nothing = desk.ends(2, &["test", "--no-goldens", "--json", "figures.json"]);
    assert!(nothing.out.contains("NONE   fog") && nothing.out.contains("nothing was checked"), "{}", nothing.out);
    assert!(nothing.err.contains("no test has checked anything"), "{}", nothing.err);
    assert_eq!(last_line(&nothing), "0 passed, 0 failed");
    assert!(std::fs::read_to_string(desk.path("figures.xml")).unwrap().contains("skipped=\"1\""));
    let more =
        "(version: 1, graph: \"fog.graph.ron\", size: (24, 16), taps: { \"air.radiance\": (properties: [Finite]) })";
    desk.put("more.test.ron", more);
    let some = desk.ends(0, &["test", "--no-goldens"]);
    assert!(some.out.contains("1 of 2 tests checked nothing"), "{}", some.out);
    assert_eq!(last_line(&some), "1 passed, 0 failed");
    assert_eq!(last_line(&desk.ends(0, &["test"])), "2 passed, 0 failed");
}

/// The command that blesses one image is one that a shell takes, for a path with blanks too, and blesses one frame.
#[test]
fn one_image_is_blessed_by_the_command_that_is_told() {
    let desk = Desk::new();
    let text = "(version: 1, graph: \"../fog.graph.ron\", size: (24, 16), frames: [0, 3], set: { \"scattered\": false }, taps: { \"air.radiance\": (golden: RelativeRmse(1e-5)), \"lit.radiance\": (golden: RelativeRmse(1e-5)) })";
    desk.put("my tests/fog.test.ron", text);
    let failed = desk.ends(1, &["test"]);
    let command = failed.out.lines().find_map(|line| line.trim().strip_prefix("bless just this: tyndall ")).unwrap();
    assert_eq!(command.split_once("--tap").unwrap().0, "test 'my tests/fog.test.ron' ");
    let (before, after) = command.split_once("'my tests/fog.test.ron'").unwrap();
    let words: Vec<&str> =
        before.split_whitespace().chain(["my tests/fog.test.ron"]).chain(after.split_whitespace()).collect();
    desk.ends(0, &words);
    assert_eq!(desk.files("my tests/fog.goldens").len(), 2, "{:?}", desk.files("my tests/fog.goldens"));
    assert!(desk.ends(2, &["test", "--frame", "5"]).err.contains("no test looks in frame 5 at a port"));
}

#[test]
fn each_reason_not_to_run_has_its_own_end() {
    let desk = Desk::new();
    assert!(desk.ends(2, &["test"]).err.contains("no tests found"));
    assert!(desk.ends(2, &["test", "nowhere"]).err.contains("there is no file or folder nowhere"));
    assert!(desk.ends(2, &["test", "fog.graph.ron"]).err.contains("is not a test"));
    test(&desk, "\"aire.radiance\": (golden: Exact)");
    let wrong = desk.ends(2, &["test"]);
    assert!(wrong.out.contains("empty-pattern") && wrong.out.contains("did you mean `air.radiance`?"), "{}", wrong.out);
    assert_eq!(last_line(&wrong), "0 passed, 1 failed");
    test(&desk, "\"air.radiance\": (properties: [Finite])");
    assert!(desk.ends(2, &["test", "--filter", "nothing"]).err.contains("contains \"nothing\""));
    let no_adapter = desk.ends(3, &["test", "--adapter", "no such card"]);
    assert!(no_adapter.out.contains("no adapter's name holds"), "{}", no_adapter.out);
    assert_eq!(last_line(&no_adapter), "0 passed, 1 failed");
    assert_eq!(last_line(&desk.ends(0, &["test", "--filter", "fog"])), "1 passed, 0 failed");
}

/// Whatever a user may get wrong about files, in words that say what.
#[test]
fn files_that_are_wrong_are_told_by_their_names() {
    let desk = Desk::new();
    test(&desk, "\"air.radiance\": (golden: RelativeRmse(1e-5))");
    desk.ends(0, &["test", "--bless"]);
    // The same file by two names is one test.
    assert_eq!(last_line(&desk.ends(0, &["test", "fog.test.ron", "./fog.test.ron", "."])), "1 passed, 0 failed");
    // It is not a success if no test looks at the port.
    let nothing = desk.ends(2, &["test", "--tap", "aire.*"]);
    assert!(nothing.err.contains("no test looks at a port that matches `aire.*`"), "{}", nothing.err);
    assert_eq!(last_line(&nothing), "0 passed, 0 failed");
    desk.put("lost.test.ron", "(version: 1, graph: \"lost.graph.ron\", taps: { \"*\": (properties: [Finite]) })");
    let lost = desk.ends(2, &["test", "lost.test.ron"]);
    assert!(
        lost.out.contains("there is no file `lost.graph.ron`") && lost.out.contains("lost.test.ron:1:21"),
        "{}",
        lost.out
    );

    let golden = desk.path("fog.goldens/air.radiance.exr");
    let content = std::fs::read(&golden).unwrap();
    std::fs::write(&golden, &content[..content.len() / 2]).unwrap();
    assert!(desk.ends(1, &["test", "fog.test.ron"]).out.contains("do not belong together"));
    std::fs::remove_file(&golden).unwrap();
    std::fs::create_dir(&golden).unwrap();
    let folder = desk.ends(1, &["test", "fog.test.ron"]);
    assert!(folder.out.contains("air.radiance.exr` cannot be read"), "{}", folder.out);
    std::fs::remove_dir(&golden).unwrap();
    std::fs::write(&golden, content).unwrap();
    desk.put("fog.goldens/goldens.ron", "{ torn");
    let torn = desk.ends(2, &["test", "fog.test.ron"]);
    assert!(torn.out.contains("delete it and bless again"), "{}", torn.out);
    std::fs::create_dir(desk.path("folder.test.ron")).unwrap();
    for arguments in [&["test"][..], &["test", "folder.test.ron"]] {
        assert!(desk.ends(2, arguments).err.contains("folder.test.ron is called like a test, and is a folder"));
    }
}

/// Where the report cannot stand, nothing is rendered for it; where it can, it is there as a whole.
#[test]
fn reports_go_into_folders_of_their_own() {
    let desk = Desk::new();
    test(&desk, "\"air.radiance\": (properties: [Finite])");
    desk.put("mine/notes.txt", "mine");
    desk.put("file", "");
    for (folder, why) in [
        ("mine", "holds other files"),
        ("file", "it is a file"),
        ("file/report", "it is a file"),
        (".", "it is not the name of a folder"),
    ] {
        let refused = desk.ends(2, &["test", "--report", folder]);
        assert!(refused.err.contains(why) && refused.out.is_empty(), "{folder}: {}{}", refused.err, refused.out);
    }
    for _ in 0..2 {
        let written = desk.ends(0, &["test", "--report", "out/report"]);
        assert!(written.out.contains("wrote out/report/index.html") && last_line(&written) == "1 passed, 0 failed");
    }
    assert_eq!(desk.files("out"), ["report"]);
    assert_eq!(desk.files("out/report"), ["index.html", "report.css", "report.js", "test-fog", "test-fog.html"]);
    let unwritten = desk.ends(2, &["test", "--json", "file/figures.json"]);
    assert!(unwritten.out.contains("1 passed, 0 failed") && unwritten.err.contains("file/figures.json"));
}

/// A shader that does not compile stops every test of a graph that uses it, and is told once.
#[test]
fn a_broken_shader_is_told_once() {
    let desk = Desk::new();
    desk.put("plugins/lens/plugin.ron", "(name: \"lens\", version: \"0.1.0\", about: \"a lens\", passes: { \"blur\": (about: \"blur\", shader: \"blur.wgsl\", ports: {}) })");
    desk.put("plugins/lens/blur.wgsl", "fn main() { let a = nonsense; }");
    let graph = std::fs::read_to_string(desk.path("fog.graph.ron")).unwrap();
    desk.put("blurred.graph.ron", &graph.replace("passes: {", "passes: { \"blurred\": (use: \"lens.blur\"),"));
    for name in ["a", "b", "c"] {
        let text = "(version: 1, graph: \"blurred.graph.ron\", size: (24, 16), taps: { \"air.radiance\": (properties: [Finite]) })";
        desk.put(&format!("{name}.test.ron"), text);
    }
    for jobs in ["1", "3"] {
        let failed = desk.run(&["test", "--jobs", jobs]);
        assert_eq!(last_line(&failed), "0 passed, 3 failed");
        assert_eq!(failed.out.matches("nonsense").count(), 2, "once, with the line of the file: {}", failed.out);
        assert_eq!(failed.out.matches("told above").count(), 2, "{}", failed.out);
    }
}

#[test]
fn goldens_without_a_test_fail() {
    let desk = blessed();
    std::fs::rename(desk.path("fog.goldens"), desk.path("mist.goldens")).unwrap();
    test(&desk, "\"air.radiance\": (properties: [Finite])");
    let failed = desk.ends(1, &["test"]);
    assert!(failed.out.contains("no test claims the goldens `mist.goldens`"), "{}", failed.out);
    assert_eq!(last_line(&failed), "1 passed, 1 failed");
}

#[test]
fn every_other_way_to_run_passes_too() {
    let desk = blessed();
    desk.ends(0, &["test", "--shuffle", "5", "--poison", "--no-sharing", "--repeat", "2", "--size", "32x32"]);
    desk.ends(0, &["test", "--shuffle", "5", "--poison", "--jobs", "2"]);
    desk.ends(0, &["test", "--isolate"]);
    std::fs::remove_file(desk.path("fog.goldens/air.radiance.exr")).unwrap();
    let alone = desk.ends(1, &["test", "--isolate"]);
    assert!(alone.out.contains("`fogged`: its input `air.radiance` has no golden"), "{}", alone.out);
}

#[test]
fn diff_compares_two_files() {
    let desk = Desk::new();
    let render = |exposure: &str, file: &str| {
        let (exposure, output) = (format!("exposure={exposure}"), format!("image={file}"));
        let arguments = ["render", "fog.graph.ron", "--size", "32x24", "--set", "scattered=false", "--set", &exposure];
        desk.ends(0, &[&arguments[..], &["--output", &output]].concat());
    };
    render("1.0", "a.png");
    render("1.0", "same.png");
    render("1.5", "b.png");
    assert!(desk.ends(0, &["diff", "a.png", "same.png"]).out.contains("FLIP mean 0.0000"));
    let differ = desk.ends(1, &["diff", "a.png", "b.png"]);
    assert_eq!(differ.out.lines().filter(|line| line.starts_with("beyond")).count(), 3, "{}", differ.out);
    desk.ends(1, &["diff", "a.png", "b.png", "--by", "RelativeRmse(0.01)"]);
    desk.ends(2, &["diff", "a.png", "b.png", "--by", "RelativeRmse(7)"]);
    desk.ends(2, &["diff", "a.png", "b.png", "--by", "Psnr(30)"]);
    desk.ends(2, &["diff", "a.png", "none.png"]);
    // Alpha is compared where both have it.
    let write = |name: &str, image: &Image, meaning| tyndall_image::write(&desk.path(name), image, meaning).unwrap();
    let colour = |channels: usize| Image::filled(16, 16, &[0.5, 0.25, 0.125, 1.0][..channels]);
    write("rgb.npy", &colour(3), Meaning::Color);
    write("rgba.npy", &colour(4), Meaning::Color);
    assert!(desk.ends(0, &["diff", "rgb.npy", "rgba.npy"]).out.contains("only one of them has alpha"));
    // FLIP sees every layer, refuses what is not a colour, and NaN passes on neither side.
    let flip = |code, a: &str, b: &str| desk.ends(code, &["diff", a, b, "--by", "Flip(mean: 0.01)"]).out;
    write("two.npy", &colour(2), Meaning::Data);
    assert!(flip(1, "two.npy", "two.npy").contains("2 channels are not a colour"));
    let layers = |second: f32| Image {
        layers: 2,
        height: 8,
        ..Image::new(16, 16, 3, [vec![0.5; 384], vec![second; 384]].concat())
    };
    write("same.npy", &layers(0.5), Meaning::Data);
    write("other.npy", &layers(0.9), Meaning::Data);
    assert!(flip(0, "same.npy", "same.npy").contains("FLIP mean 0.0000"));
    assert!(flip(1, "same.npy", "other.npy").contains("beyond"));
    write("nan.npy", &layers(f32::NAN), Meaning::Data);
    assert!(flip(1, "same.npy", "nan.npy").contains("NaN") && flip(1, "nan.npy", "same.npy").contains("NaN"));
    render("1.0", "a.exr");
    assert!(desk.ends(2, &["diff", "a.png", "test.scene.ron"]).err.contains("unknown suffix"));
}
