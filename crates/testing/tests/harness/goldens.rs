//! Goldens that are missing, stale, torn, orphaned, of another adapter; and blessing.

use std::fs;

use tyndall_testing::{Options, Outcome, Robustness, Saved, State, summary};

use crate::chain::{Chain, LINE};

const HALF: &str = "    let value = 0.5 * texel(id.xy);";

fn bless() -> Options {
    Options { bless: true, ..Options::default() }
}

fn says(outcome: &Outcome, what: &str) {
    assert!(!outcome.passed());
    assert!(outcome.text().contains(what), "{what}: {}", outcome.text());
}

#[test]
fn a_missing_golden_fails() {
    let chain = Chain::new();
    fs::remove_file(chain.path("chain.goldens/three.result.exr")).unwrap();
    let outcome = chain.plain();
    assert!(outcome.guilty().is_empty(), "a golden that is missing says nothing of the pass");
    assert_eq!(outcome.ports.iter().filter(|port| port.state == State::Unjudged).count(), 1);
    says(&outcome, "there is no golden");
    assert!(chain.isolated().text().contains("`three.result` has no golden"));
}

#[test]
fn a_golden_that_nobody_claims_fails_until_it_is_dropped() {
    let chain = Chain::new();
    fs::copy(chain.path("chain.goldens/one.result.exr"), chain.path("chain.goldens/gone.result.exr")).unwrap();
    says(&chain.plain(), "no tap claims the golden");
    let blessed = chain.run(&bless());
    assert!(blessed.blessed.iter().any(|line| line.contains("deleted")), "{:?}", blessed.blessed);
    assert!(chain.plain().passed());
}

/// A record outlives its golden and the pass that it was of: a failure of its own until it is dropped.
#[test]
fn a_record_of_what_is_gone_fails_until_it_is_dropped() {
    let chain = Chain::new();
    fs::remove_file(chain.path("chain.goldens/three.result.exr")).unwrap();
    says(&chain.plain(), "and its record is still there");
    let taps = ["start", "one", "two", "four", "five", "aside"];
    let taps = taps.map(|pass| format!("\"{pass}.result\": (golden: RelativeRmse(1e-5))")).join(", ");
    chain.test(&taps, "");
    let outcome = chain.plain();
    says(&outcome, "the record of the golden `three.result` has no file, and no tap claims it");
    assert!(outcome.guilty().is_empty(), "{}", outcome.text());
    assert!(chain.run(&bless()).passed());
    assert!(chain.plain().passed());
    assert!(!fs::read_to_string(chain.path("chain.goldens/goldens.ron")).unwrap().contains("three.result"));
}

/// Of a test that looks at several frames the command blesses the one that it is told beside, and no other.
#[test]
fn one_frame_is_blessed_by_itself() {
    let chain = Chain::new();
    chain.test("\"five.result\": (golden: RelativeRmse(1e-5))", "frames: [0, 3]");
    fs::remove_dir_all(chain.path("chain.goldens")).unwrap();
    let missing = chain.plain();
    assert!(missing.text().contains("--tap five.result --frame 3 --bless"), "{}", missing.text());
    let one = Options { tap: Some("five.result".to_owned()), frame: Some(3), ..bless() };
    assert!(chain.run(&one).passed());
    assert!(chain.path("chain.goldens/five.result.0003.exr").exists());
    assert!(!chain.path("chain.goldens/five.result.0000.exr").exists());
    let outcome = chain.plain();
    let failing: Vec<u32> = outcome.ports.iter().filter(|port| !port.passed()).map(|port| port.frame).collect();
    assert_eq!(failing, [0]);
}

/// Without goldens there is nothing that it could fail by: that is no success.
#[test]
fn a_test_of_goldens_alone_checks_nothing_without_them() {
    let chain = Chain::new();
    let without = Options { without_goldens: true, ..Options::default() };
    let sized = Options { size: Some((8, 8)), ..Options::default() };
    assert!(chain.run(&without).checked_nothing() && chain.run(&sized).checked_nothing());
    assert!(!chain.plain().checked_nothing());
    let again = Options { robustness: Robustness { repeat: 1, ..Robustness::default() }, ..without.clone() };
    assert!(!chain.run(&again).checked_nothing(), "it was held against itself, bit by bit");
    let found = [chain.run(&without), chain.plain()];
    assert_eq!(summary::counts(&found), [1, 0, 1]);
    let junit = summary::junit(&found);
    assert!(
        junit.contains("failures=\"0\" errors=\"0\" skipped=\"1\"") && junit.contains("<skipped message=\"nothing")
    );
    let json = summary::json("an adapter", &found, Saved::default());
    assert_eq!((&json["checked_nothing"], &json["tests"][0]["passed"]), (&1.into(), &false.into()));
    chain.test("\"*\": (golden: RelativeRmse(1e-5), properties: [Finite])", "");
    assert!(!chain.run(&without).checked_nothing());
}

#[test]
fn a_golden_whose_record_is_another_s_fails() {
    let chain = Chain::new();
    fs::copy(chain.path("chain.goldens/two.result.exr"), chain.path("chain.goldens/three.result.exr")).unwrap();
    says(&chain.plain(), "do not belong together");
    fs::remove_file(chain.path("chain.goldens/goldens.ron")).unwrap();
    says(&chain.plain(), "nothing says what the golden");
}

/// Stale and right passes; stale and different says what has changed; different and not stale says nothing of that.
#[test]
fn stale_is_told_apart_from_different() {
    let chain = Chain::new();
    chain.set_line("three", &format!("{LINE} // as before"));
    assert!(chain.plain().ports.iter().all(|port| port.stale.is_empty()), "a comment does nothing");
    chain.set_line("three", &format!("{LINE} let idle = 0.0;"));
    let outcome = chain.plain();
    assert!(outcome.passed());
    let stale: Vec<_> = outcome.ports.iter().filter(|port| !port.stale.is_empty()).collect();
    assert_eq!(stale.iter().map(|port| port.pass.as_str()).collect::<Vec<_>>(), ["three", "four", "five"]);
    assert!(stale.iter().all(|port| port.stale == ["shaders"]));

    let written = || fs::metadata(chain.path("chain.goldens/three.result.exr")).unwrap().modified().unwrap();
    let before = written();
    let renewed = chain.run(&bless());
    assert_eq!(renewed.blessed.len(), 3, "{:?}", renewed.blessed);
    let line = &renewed.blessed[0];
    assert!(line.starts_with("recorded anew") && line.contains("shaders had changed"), "{line}");
    assert_eq!(before, written(), "a picture that is still right stays");
    assert!(chain.plain().ports.iter().all(|port| port.stale.is_empty()));

    // The golden itself is another: nothing that it was made from has changed.
    chain.set_line("three", HALF);
    chain.run(&bless());
    let halved = fs::read(chain.path("chain.goldens/three.result.exr")).unwrap();
    let records = fs::read_to_string(chain.path("chain.goldens/goldens.ron")).unwrap();
    let content = |text: &str| {
        let line = text.lines().find(|line| line.contains("\"three.result\"")).unwrap();
        line.split("content: \"").nth(1).unwrap()[..16].to_owned()
    };
    chain.set_line("three", LINE);
    chain.run(&bless());
    let now = fs::read_to_string(chain.path("chain.goldens/goldens.ron")).unwrap();
    fs::write(chain.path("chain.goldens/three.result.exr"), halved).unwrap();
    fs::write(chain.path("chain.goldens/goldens.ron"), now.replace(&content(&now), &content(&records))).unwrap();
    let outcome = chain.plain();
    assert_eq!(outcome.guilty(), ["three"]);
    assert!(!outcome.text().contains("stale"), "{}", outcome.text());
}

#[test]
fn a_changed_parameter_and_a_changed_size_are_named() {
    let chain = Chain::new();
    let graph = fs::read_to_string(chain.path("chain.graph.ron")).unwrap();
    // `aside` now reads what comes after the second link.
    chain.put(
        "chain.graph.ron",
        &graph.replace(
            "\"aside\": (use: \"chain.five\", inputs: { \"input\": \"one.result\" })",
            "\"aside\": (use: \"chain.five\", inputs: { \"input\": \"two.result\" })",
        ),
    );
    let outcome = chain.plain();
    assert_eq!(outcome.guilty(), ["aside"]);
    assert!(outcome.text().contains("stale: graph"), "{}", outcome.text());
}

#[test]
fn blessing_prints_figures_and_can_be_of_one_image() {
    let chain = Chain::new();
    chain.set_line("three", HALF);
    let one = chain.run(&Options { tap: Some("three.result".to_owned()), ..bless() });
    assert_eq!(one.blessed.len(), 1);
    assert!(one.blessed[0].contains("relative RMSE"), "{:?}", one.blessed);
    let mean = |what: &str| -> f64 {
        let (_, after) = one.blessed[0].split_once(&format!("{what} mean ")).unwrap();
        after.split_once(',').unwrap().0.parse().unwrap()
    };
    let ratio = mean("after: ") / mean("before:");
    assert!(ratio > 0.5 && ratio < 0.6, "{:?}", one.blessed);
    // What follows still has its old goldens, and now it is the first that diverges.
    assert_eq!(chain.plain().guilty(), ["four"]);
    assert!(chain.run(&bless()).passed());
    assert!(chain.plain().passed());
}

#[test]
fn nothing_is_blessed_of_which_something_else_does_not_hold() {
    let chain = Chain::new();
    chain.test("\"*\": (golden: RelativeRmse(1e-5), properties: [Finite])", "");
    chain.set_line("three", "    let value = texel(id.xy) + bitcast<f32>(id.x | 0x7fc00000u);");
    let outcome = chain.run(&bless());
    says(&outcome, "something else does not hold");
    assert!(outcome.blessed.is_empty(), "{:?}", outcome.blessed);
    // Neither is what is made from it, though nothing else is wrong with that.
    chain.test("\"*\": (golden: RelativeRmse(1e-5)), \"three.*\": (properties: [Range(0.0, 1.2)])", "");
    chain.set_line("three", "    let value = texel(id.xy) + vec3(5.0);");
    let outcome = chain.run(&bless());
    says(&outcome, "not blessed: four.result: it is made from what `three` writes");
    assert!(outcome.blessed.is_empty(), "{:?}", outcome.blessed);
    let before = fs::read(chain.path("chain.goldens/five.result.exr")).unwrap();
    let one = chain.run(&Options { tap: Some("five.*".to_owned()), ..bless() });
    assert!(one.blessed.is_empty(), "{:?}", one.blessed);
    assert_eq!(fs::read(chain.path("chain.goldens/five.result.exr")).unwrap(), before);
}

#[test]
fn goldens_of_another_class_of_adapters_are_blessed_only_when_told() {
    let chain = Chain::new();
    let path = chain.path("chain.goldens/goldens.ron");
    let records = fs::read_to_string(&path).unwrap();
    let here = records.split("adapter: \"").nth(1).unwrap().split('"').next().unwrap().to_owned();
    let other = if here == "discrete" { "software" } else { "discrete" };
    fs::write(&path, records.replace(&format!("adapter: {here:?}"), &format!("adapter: {other:?}"))).unwrap();
    chain.set_line("five", HALF);
    says(&chain.run(&bless()), "--any-adapter");
    let messages = chain.run(&Options { bless_any_adapter: true, ..bless() });
    assert!(messages.passed() && messages.blessed.len() == 2, "{} {:?}", messages.text(), messages.blessed);
}

/// A relation says how a port changes; broken, the pass that it looks at is named.
#[test]
fn relations_between_runs() {
    let chain = Chain::new();
    let graph = fs::read_to_string(chain.path("chain.graph.ron")).unwrap();
    let scaled = graph.replace(
        "\"aside\": (use",
        "\"twice\": (use: \"core.scale\", inputs: { \"input\": \"one.result\" }), \"aside\": (use",
    );
    chain.put("chain.graph.ron", &scaled.replace("outputs: {", "outputs: { \"twice\": \"twice.scaled\","));
    let relation = |factor: f64| {
        format!(
            "relations: [(about: \"twice the factor\", runs: [{{ \"twice.factor\": (2.0, 2.0, 2.0) }}], expect: {{ \"twice.scaled\": Scaled(factor: {factor:?}, by: RelativeRmse(1e-6)), \"five.result\": Same(by: Exact) }})]"
        )
    };
    let run = |factor, tap: Option<&str>| {
        chain.test("\"start.*\": (properties: [Finite])", &relation(factor));
        let search = vec![tyndall_plugin::SearchPath { path: chain.path("plugins"), required: true }];
        let mut session = tyndall_testing::Session::new(vec![tyndall_core::plugin], search, None).unwrap();
        let options = Options { without_goldens: true, tap: tap.map(str::to_owned), ..Options::default() };
        session.run(&chain.path("chain.test.ron"), &options)
    };
    let right = run(2.0, None);
    assert!(right.passed() && right.relations.len() == 2, "{}", right.text());
    let wrong = run(3.0, None);
    assert!(!wrong.passed() && wrong.text().contains("twice the factor"), "{}", wrong.text());
    assert!(wrong.text().contains("first diverging pass: `twice` (core.scale)"), "{}", wrong.text());
    // Of a relation only what is about the chosen ports is asked.
    let other = run(3.0, Some("five.*"));
    assert!(other.passed() && other.relations.len() == 1, "{}", other.text());
    let none = run(3.0, Some("start.*"));
    assert!(none.passed() && none.relations.is_empty(), "{}", none.text());
}

#[test]
fn what_would_not_pass_against_itself_is_not_blessed_and_nothing_goes_without_a_replacement() {
    let chain = Chain::new();
    let before = fs::read(chain.path("chain.goldens/three.result.exr")).unwrap();
    chain.put("chain.goldens/NOTES.md", "mine");
    chain.put("chain.goldens/gone.result.exr", "an orphan");
    chain.set_line("three", "    let value = texel(id.xy) + bitcast<f32>(id.x | 0x7fc00000u);");
    let outcome = chain.run(&bless());
    says(&outcome, "three.result: it would not pass against itself");
    assert_eq!(fs::read(chain.path("chain.goldens/three.result.exr")).unwrap(), before);
    assert!(chain.path("chain.goldens/gone.result.exr").exists(), "not everything was blessed");
    chain.set_line("three", LINE);
    chain.run(&bless());
    assert!(!chain.path("chain.goldens/gone.result.exr").exists() && chain.path("chain.goldens/NOTES.md").exists());
}

/// What comes before has its old golden still: it is not right, and so neither is what was made from it.
#[test]
fn nothing_is_blessed_that_was_made_from_what_is_not() {
    let chain = Chain::new();
    chain.set_line("two", HALF);
    let outcome = chain.run(&Options { tap: Some("four.result".to_owned()), ..bless() });
    says(&outcome, "not blessed: four.result: it is made from what `two` writes");
    assert!(outcome.blessed.is_empty(), "{:?}", outcome.blessed);
}

/// A first golden can be blessed by itself: that those before it are missing says nothing against them.
#[test]
fn the_first_goldens_can_be_blessed_one_by_one() {
    let chain = Chain::new();
    fs::remove_dir_all(chain.path("chain.goldens")).unwrap();
    let three = chain.run(&Options { tap: Some("three.result".to_owned()), ..bless() });
    assert_eq!(three.blessed.len(), 1, "{}", three.text());
    assert!(chain.path("chain.goldens/three.result.exr").exists());
}

/// A blessing that was cut off leaves a temporary file, which the next one drops; what is somebody's own stays, and the
/// message does not say that blessing would drop it.
#[test]
fn what_an_interrupted_blessing_leaves_is_dropped_by_the_next() {
    let chain = Chain::new();
    chain.put("chain.goldens/.tyndall-Kx3q.part", "half a picture");
    says(&chain.plain(), "or bless to drop it");
    assert!(chain.run(&bless()).passed());
    chain.put("chain.goldens/NOTES.md", "mine");
    let text = chain.plain().text();
    assert!(text.contains("NOTES.md` lies among goldens") && !text.contains("bless to drop it"), "{text}");
}

#[test]
fn a_golden_that_may_not_be_written_is_not_blessed_and_nobody_elses_fault() {
    let chain = Chain::new();
    let path = chain.path("chain.goldens/three.result.exr");
    let mut permissions = fs::metadata(&path).unwrap().permissions();
    permissions.set_readonly(true);
    fs::set_permissions(&path, permissions).unwrap();
    chain.set_line("three", HALF);
    let outcome = chain.run(&Options { tap: Some("three.result".to_owned()), ..bless() });
    says(&outcome, "not blessed: three.result");
    assert!(outcome.text().contains("read-only") && outcome.exit_code() == 1, "{}", outcome.text());
}

/// In another size than its own, what a test states for its size is left out, and told; in its own size it is asked.
#[test]
fn what_is_not_asked_in_another_size_is_told() {
    let chain = Chain::new();
    chain.test("\"start.*\": (golden: Exact, properties: [Finite, Mean(value: 0.001, within: 0.0)])", "");
    let run = |size| chain.run(&Options { size, tap: Some("start.result".to_owned()), ..Options::default() });
    let small = run(Some((9, 7)));
    assert!(small.passed(), "{}", small.text());
    assert_eq!(small.left_out, ["in another size than its own: goldens, means"]);
    let own = run(Some((24, 16)));
    assert!(!own.passed() && own.left_out.is_empty(), "{}", own.text());
    says(&own, "the mean is");
}
