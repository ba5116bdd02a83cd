//! Failures on purpose, and whose fault they are.

use tyndall_testing::{Options, State};

use crate::chain::{Chain, LINE};

/// What a link does wrong, in ways that a person would want to be told of.
const BROKEN: [(&str, &str); 7] = [
    (
        "shifted by a pixel",
        "    let value = texel(id.xy + vec2(1u, 0u)) * vec3(0.9, 0.8, 0.7) + vec3(0.01, 0.02, 0.03);",
    ),
    ("half as much", "    let value = 0.5 * (texel(id.xy) * vec3(0.9, 0.8, 0.7) + vec3(0.01, 0.02, 0.03));"),
    ("channels swapped", "    let value = (texel(id.xy) * vec3(0.9, 0.8, 0.7) + vec3(0.01, 0.02, 0.03)).grb;"),
    ("blank", "    let value = 0.0 * texel(id.xy);"),
    (
        "one pixel wrong",
        "    let value = texel(id.xy) * vec3(0.9, 0.8, 0.7) + vec3(0.01, 0.02, 0.03) + select(0.0, 0.1, all(id.xy == vec2(7u, 5u)));",
    ),
    ("not a number", "    let value = texel(id.xy) + bitcast<f32>(id.x | 0x7fc00000u);"),
    ("a little too much", "    let value = 1.0001 * (texel(id.xy) * vec3(0.9, 0.8, 0.7) + vec3(0.01, 0.02, 0.03));"),
];

#[test]
fn what_is_not_broken_passes() {
    let chain = Chain::new();
    assert!(chain.plain().passed());
    assert!(chain.isolated().passed());
    assert_eq!(chain.plain().exit_code(), 0);
}

#[test]
fn a_pass_broken_in_the_middle_of_a_chain_is_named_and_the_rest_inherits() {
    let chain = Chain::new();
    for (how, line) in BROKEN {
        chain.set_line("three", line);
        let outcome = chain.plain();
        assert_eq!(outcome.guilty(), ["three"], "{how}");
        assert_eq!(outcome.inherited(), ["four", "five"], "{how}");
        assert_eq!(outcome.exit_code(), 1);
        let text = outcome.text();
        assert!(text.contains("first diverging pass: `three` (chain.three)"), "{how}: {text}");
        assert!(text.contains("shaders changed") && text.contains("--tap three.result --bless"), "{how}: {text}");
        let passing: Vec<&str> =
            outcome.ports.iter().filter(|port| port.state == State::Passed).map(|port| port.name.as_str()).collect();
        assert_eq!(passing, ["start.result", "one.result", "two.result", "aside.result"], "{how}");
    }
    chain.set_line("three", LINE);
    assert!(chain.plain().passed());
}

#[test]
fn alone_a_broken_pass_is_the_only_failure() {
    let chain = Chain::new();
    for (how, line) in BROKEN {
        chain.set_line("three", line);
        let outcome = chain.isolated();
        assert_eq!(outcome.guilty(), ["three"], "{how}");
        assert!(outcome.inherited().is_empty(), "{how}");
        assert_eq!(outcome.ports.iter().filter(|port| !port.passed()).count(), 1, "{how}");
        assert_eq!(outcome.ports.len(), 7, "every pass is run");
    }
}

/// `five` is used twice: at the end, and aside. Broken, it fails in both places, and neither inherits from the other.
#[test]
fn a_kind_that_is_used_twice_is_guilty_twice() {
    let chain = Chain::new();
    chain.set_line("five", BROKEN[1].1);
    let outcome = chain.plain();
    assert_eq!(outcome.guilty(), ["five", "aside"]);
    assert!(outcome.inherited().is_empty());
}

#[test]
fn two_broken_passes_in_a_row_are_told_apart_only_alone() {
    let chain = Chain::new();
    chain.set_line("two", BROKEN[1].1);
    chain.set_line("four", BROKEN[2].1);
    assert_eq!(chain.plain().guilty(), ["two"]);
    assert_eq!(chain.isolated().guilty(), ["two", "four"]);
}

#[test]
fn properties_name_the_pass_without_any_golden() {
    let chain = Chain::new();
    chain.test("\"*\": (properties: [Finite, NonNegative, Range(0.0, 1.2), AlphaOne, Varies])", "");
    for orphan in std::fs::read_dir(chain.path("chain.goldens")).unwrap() {
        std::fs::remove_file(orphan.unwrap().path()).unwrap();
    }
    assert!(chain.plain().passed(), "{}", chain.plain().text());
    for (how, line) in [BROKEN[3], BROKEN[5]] {
        chain.set_line("three", line);
        assert_eq!(chain.plain().guilty(), ["three"], "{how}");
    }
}

/// The property of `two` is about `aside`, which is broken: that is not the fault of `two`.
#[test]
fn a_property_about_another_port_falls_with_that_port() {
    let chain = Chain::new();
    let equal =
        "\"*\": (golden: RelativeRmse(1e-5)), \"two.result\": (properties: [Equal(port: \"aside.result\", by: Exact)])";
    chain.test(equal, "");
    assert!(chain.plain().passed(), "{}", chain.plain().text());
    chain.set_line("five", "    let value = 0.0 * texel(id.xy);");
    let outcome = chain.plain();
    assert_eq!(outcome.guilty(), ["five", "aside"]);
    assert_eq!(outcome.inherited(), ["two"]);
}

#[test]
fn a_filter_looks_only_at_what_it_matches() {
    let chain = Chain::new();
    chain.set_line("three", BROKEN[1].1);
    let outcome = chain.run(&Options { tap: Some("two.*".to_owned()), ..Options::default() });
    assert!(outcome.passed() && outcome.ports.len() == 1, "{}", outcome.text());
}

/// `three` and `four` fail, and only `three` is at fault: `two`, which has no golden, says nothing of the passes after it.
#[test]
fn a_missing_golden_hides_no_failure_after_it() {
    let chain = Chain::new();
    std::fs::remove_file(chain.path("chain.goldens/two.result.exr")).unwrap();
    let unjudged = chain.plain();
    assert!(unjudged.guilty().is_empty() && !unjudged.passed(), "{}", unjudged.text());
    chain.set_line("three", BROKEN[1].1);
    let outcome = chain.plain();
    assert_eq!((outcome.guilty(), outcome.inherited()), (vec!["three"], vec!["four", "five"]));
    let text = outcome.text();
    assert!(text.contains("there is no golden") && text.contains("`two.result` may be wrong"), "{text}");
}

/// What nothing holds may be wrong without a word: the pass after it is named, and the doubt is said.
#[test]
fn a_pass_that_nothing_looks_at_is_suspected() {
    let chain = Chain::new();
    chain.test(
        "\"start.*\": (golden: Exact), \"three.*\": (golden: RelativeRmse(1e-5)), \"two.*\": (properties: [Finite])",
        "",
    );
    let of_chain = ["one.result", "two.result", "four.result", "five.result", "aside.result"];
    of_chain.iter().for_each(|port| std::fs::remove_file(chain.path(&format!("chain.goldens/{port}.exr"))).unwrap());
    chain.run(&Options { bless: true, ..Options::default() });
    assert!(chain.plain().passed() && chain.plain().suspicions.is_empty(), "{}", chain.plain().text());
    chain.set_line("one", BROKEN[1].1);
    let outcome = chain.plain();
    assert_eq!(outcome.guilty(), ["three"]);
    assert_eq!(outcome.suspicions[0].unheld, ["one.result", "two.result"]);
    assert!(outcome.text().contains("`one.result`, `two.result` may be wrong"), "{}", outcome.text());
}

/// Asked for one port, a test still says which pass went wrong, though it stands before that port; and blesses neither.
#[test]
fn a_filter_finds_the_pass_before_what_it_matches() {
    let chain = Chain::new();
    chain.set_line("two", BROKEN[1].1);
    let of_four = Options { tap: Some("four.*".to_owned()), ..Options::default() };
    let outcome = chain.run(&of_four);
    assert_eq!((outcome.guilty(), outcome.inherited()), (vec!["two"], vec!["three", "four"]), "{}", outcome.text());
    assert!(outcome.ports.iter().all(|port| port.name != "five.result"));
}

/// An input that has no golden is rendered, and what is wrong with it is the fault of what rendered it.
#[test]
fn alone_what_had_to_run_along_is_to_blame() {
    let chain = Chain::new();
    let equal = "\"*\": (golden: RelativeRmse(1e-5))";
    let whole = chain.path("chain.goldens/goldens.ron");
    assert!(whole.is_file());
    // `two` has a check of its own and no golden, so `three` cannot be fed.
    chain.test(&format!("\"start.*\": (golden: Exact), \"one.*\": (golden: Exact), \"two.*\": (properties: [Equal(port: \"twin.result\", by: RelativeRmse(1e-5))]), {}", equal.replace("*", "three.*")), "");
    let graph = std::fs::read_to_string(chain.path("chain.graph.ron")).unwrap();
    let twin = "\"twin\": (use: \"chain.four\", inputs: { \"input\": \"one.result\" }), \"aside\": (use";
    chain.put(
        "chain.graph.ron",
        &graph.replace("\"aside\": (use", twin).replace("outputs: {", "outputs: { \"twin\": \"twin.result\","),
    );
    chain.run(&Options { bless: true, ..Options::default() });
    assert!(chain.isolated().passed(), "{}", chain.isolated().text());
    chain.set_line("two", BROKEN[1].1);
    let plain = chain.plain();
    assert_eq!(plain.guilty(), ["two"], "{}", plain.text());
    let alone = chain.isolated();
    // `twin` is not an input of `two`, so its check is left out, and said to be: now `two` is the one in doubt.
    assert_eq!(alone.guilty(), ["three"], "{}", alone.text());
    assert_eq!(alone.suspicions[0].unheld, ["two.result"]);
    assert!(
        alone.left_out.iter().any(|line| line.contains("two.result equal to `twin.result`")),
        "{:?}",
        alone.left_out
    );
    // With a check that can be asked, it is the only failure.
    chain.test("\"start.*\": (golden: Exact), \"one.*\": (golden: Exact), \"two.*\": (properties: [Equal(port: \"one.result\", by: RelativeRmse(1e-5))]), \"three.*\": (golden: RelativeRmse(1e-5))", "");
    let same = "    let value = texel(id.xy);";
    chain.set_line("two", same);
    chain.run(&Options { bless: true, ..Options::default() });
    assert!(chain.isolated().passed(), "{}", chain.isolated().text());
    chain.set_line("two", BROKEN[1].1);
    let alone = chain.isolated();
    assert_eq!((alone.guilty(), alone.inherited()), (vec!["two"], vec!["three"]), "{}", alone.text());
}

/// What a port is held against may be what is wrong: the doubt is said.
#[test]
fn a_port_that_another_is_held_against_is_suspected() {
    let chain = Chain::new();
    let equal = "\"*\": (golden: RelativeRmse(0.01), reason: \"loose\"), \"two.result\": (properties: [Equal(port: \"twin.result\", by: RelativeRmse(1e-5))])";
    let graph = std::fs::read_to_string(chain.path("chain.graph.ron")).unwrap();
    let twin = "\"twin\": (use: \"chain.four\", inputs: { \"input\": \"one.result\" }), \"aside\": (use";
    let graph = graph.replace("\"aside\": (use", twin).replace("outputs: {", "outputs: { \"twin\": \"twin.result\",");
    chain.put("chain.graph.ron", &graph);
    chain.test(equal, "");
    chain.run(&Options { bless: true, ..Options::default() });
    assert!(chain.plain().passed(), "{}", chain.plain().text());
    // Within what its own golden allows.
    chain.set_line("four", &LINE.replace("vec3(0.9, 0.8, 0.7)", "vec3(0.901, 0.8, 0.7)"));
    let outcome = chain.plain();
    assert_eq!(outcome.guilty(), ["two"], "{}", outcome.text());
    assert_eq!(outcome.suspicions[0].unheld, ["twin.result"], "{}", outcome.text());
}

/// The mistake shows in another run alone, where nothing holds what the port was made from.
#[test]
fn a_relation_says_what_nothing_holds_in_its_runs() {
    let chain = Chain::new();
    let more = "relations: [(about: \"as large again\", runs: [{ \"start.amount\": 2.0 }], expect: { \"two.result\": Same(by: Exact) })]";
    chain.put(
        "plugins/chain/plugin.ron",
        &std::fs::read_to_string(chain.path("plugins/chain/plugin.ron")).unwrap().replace(
            "disabled: Constant(0.0, 0.0, 0.0, 1.0)) })",
            "disabled: Constant(0.0, 0.0, 0.0, 1.0)) }, params: { \"amount\": (about: \"of it\", default: 1.0) })",
        ),
    );
    let source = std::fs::read_to_string(chain.path("plugins/chain/source.wgsl")).unwrap();
    let source = source
        .replace("@compute", "override amount: f32 = 1.0;\n@compute")
        .replace("0.5 + 0.5 * sin", "amount * 0.5 + 0.5 * sin");
    chain.put("plugins/chain/source.wgsl", &source);
    chain.test("\"*\": (golden: RelativeRmse(1e-5))", more);
    let outcome = chain.plain();
    assert_eq!(outcome.guilty(), ["two"], "{}", outcome.text());
    assert_eq!(outcome.suspicions[0].unheld, ["start.result", "one.result"], "{}", outcome.text());
}

/// One port of a pass is wrong, and who reads the other is not excused by it.
#[test]
fn excuses_go_by_port() {
    let chain = Chain::new();
    let manifest = std::fs::read_to_string(chain.path("plugins/chain/plugin.ron")).unwrap();
    let port =
        |name: &str| format!("\"{name}\": (about: \"it\", size: Frame(1.0), disabled: Constant(0.0, 0.0, 0.0, 1.0))");
    let pair = format!("\"pair\": (about: \"two\", shader: \"pair.wgsl\", ports: {{ {}, {} }}),", port("a"), port("b"));
    chain.put("plugins/chain/plugin.ron", &manifest.replace("passes: {", &format!("passes: {{ {pair}")));
    let shader = |b: &str| {
        format!(
            "var a: texture_storage_2d<rgba32float, write>;
var b: texture_storage_2d<rgba32float, write>;
@compute @workgroup_size(8, 8)
fn main(@builtin(global_invocation_id) id: vec3<u32>) {{
    textureStore(a, id.xy, vec4(vec2<f32>(id.xy) / 30.0, 0.5, 1.0));
    textureStore(b, id.xy, vec4(vec2<f32>(id.yx) / 30.0, {b}, 1.0));
}}
"
        )
    };
    chain.put("plugins/chain/pair.wgsl", &shader("0.5"));
    chain.put(
        "chain.graph.ron",
        "(version: 1, size: (24, 16), passes: { \"pair\": (use: \"chain.pair\"), \"one\": (use: \"chain.one\", inputs: { \"input\": \"pair.a\" }), \"other\": (use: \"chain.two\", inputs: { \"input\": \"pair.b\" }) }, outputs: { \"one\": \"one.result\", \"other\": \"other.result\" })",
    );
    let blessed = chain.run(&Options { bless: true, ..Options::default() });
    assert!(blessed.passed(), "{}", blessed.text());
    chain.put("plugins/chain/pair.wgsl", &shader("0.25"));
    let outcome = chain.plain();
    assert_eq!((outcome.guilty(), outcome.inherited()), (vec!["pair"], vec!["other"]), "{}", outcome.text());
    chain.set_line("one", BROKEN[1].1);
    let outcome = chain.plain();
    assert_eq!((outcome.guilty(), outcome.inherited()), (vec!["pair", "one"], vec!["other"]), "{}", outcome.text());
}

/// What a port is held against is under suspicion only where it may be so far off: not where a check of its own is stricter
/// than what was found.
#[test]
fn what_is_held_strictly_is_not_suspected() {
    let chain = Chain::new();
    let suspects = |held: &str| {
        let taps = format!("{held}, \"five.*\": (properties: [Equal(port: \"aside.result\", by: RelativeRmse(1e-5))])");
        chain.test(&taps, "");
        let outcome = chain.plain();
        assert_eq!(outcome.guilty().last(), Some(&"five"), "{}", outcome.text());
        let of_five = outcome.suspicions.iter().find(|suspicion| suspicion.pass == "five");
        of_five.is_some_and(|suspicion| suspicion.unheld.contains(&"aside.result".to_owned()))
    };
    assert!(suspects("\"aside.*\": (properties: [Finite])"));
    assert!(!suspects("\"aside.*\": (golden: RelativeRmse(1e-4))"));
}
