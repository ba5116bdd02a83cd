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
