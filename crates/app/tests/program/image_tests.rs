//! `test` and `diff`: what they say, and how they end.

use crate::run::{Desk, Ended, SCENE};

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
}

#[test]
fn each_reason_not_to_run_has_its_own_end() {
    let desk = Desk::new();
    assert!(desk.ends(2, &["test"]).err.contains("there is no test"));
    assert!(desk.ends(2, &["test", "nowhere"]).err.contains("there is no file or folder nowhere"));
    assert!(desk.ends(2, &["test", "fog.graph.ron"]).err.contains("is no test"));
    test(&desk, "\"aire.radiance\": (golden: Exact)");
    let wrong = desk.ends(2, &["test"]);
    assert!(wrong.out.contains("empty-pattern") && wrong.out.contains("did you mean `air.radiance`?"), "{}", wrong.out);
    assert_eq!(last_line(&wrong), "0 passed, 1 failed");
    test(&desk, "\"air.radiance\": (properties: [Finite])");
    assert!(desk.ends(2, &["test", "--filter", "nothing"]).err.contains("holds \"nothing\""));
    let no_adapter = desk.ends(3, &["test", "--adapter", "no such card"]);
    assert!(no_adapter.out.contains("no adapter's name holds"), "{}", no_adapter.out);
    assert_eq!(last_line(&no_adapter), "0 passed, 1 failed");
    assert_eq!(last_line(&desk.ends(0, &["test", "--filter", "fog"])), "1 passed, 0 failed");
}

#[test]
fn goldens_without_a_test_fail() {
    let desk = blessed();
    std::fs::rename(desk.path("fog.goldens"), desk.path("mist.goldens")).unwrap();
    test(&desk, "\"air.radiance\": (properties: [Finite])");
    let failed = desk.ends(1, &["test"]);
    assert!(failed.out.contains("no tap claims the golden `mist.goldens`"), "{}", failed.out);
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
    render("1.0", "a.exr");
    assert!(desk.ends(2, &["diff", "a.png", "test.scene.ron"]).err.contains("unknown suffix"));
}
