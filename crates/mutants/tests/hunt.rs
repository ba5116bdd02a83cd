//! Mutants of a plugin of two passes: each is made, judged and laid at its own door.

#![allow(clippy::unwrap_used, reason = "a test may panic")]

use std::path::PathBuf;

use tempfile::TempDir;
use tyndall_mutants::{Figures, Hunt, Mutant, PassFindings, REASONS, Trouble, Verdict, hunt, json, missed, table};
use tyndall_plugin::SearchPath;
use tyndall_testing::{Options, Session};

const FIRST: &str = "override extra: bool = false;
var result: texture_storage_2d<rgba32float, write>;
fn never(at: vec2<f32>) -> f32 {
    return at.x * 7.0 - min(at.x, at.y);
}
@compute @workgroup_size(8, 8)
fn main(@builtin(global_invocation_id) id: vec3<u32>) {
    let at = vec2<f32>(id.xy);
    var more = 0.0;
    if extra { more = never(at); }
    var sum = 0.0;
    for (var i = 0u; i < 3u; i++) { sum += 0.125 * max(at.x, at.y) + f32(i); }
    if all(id.xy < textureDimensions(result)) {
        textureStore(result, id.xy, vec4<f32>(at.x / 20.0, sum + more, atan2(at.y - 4.0, at.x + 2.0), 1.0));
    }
}
";

const SECOND: &str = "var input: texture_2d<f32>;
var result: texture_storage_2d<rgba32float, write>;
fn curve(value: vec3<f32>) -> vec3<f32> {
    return value * vec3<f32>(0.9, 0.8, 0.7) + 0.05 * cross(value, vec3<f32>(0.3, 0.5, 1.7));
}
@compute @workgroup_size(8, 8)
fn main(@builtin(global_invocation_id) id: vec3<u32>) {
    if all(id.xy < textureDimensions(result)) {
        textureStore(result, id.xy, vec4<f32>(curve(textureLoad(input, id.xy, 0).xyz), 1.0));
    }
}
";

/// A folder with a plugin, a graph and a blessed test.
struct Folder(TempDir);

impl Folder {
    fn new() -> Self {
        let folder = Self(tempfile::tempdir().unwrap());
        folder.put("plugins/pair/first.wgsl", FIRST);
        folder.put("plugins/pair/second.wgsl", SECOND);
        folder.put(
            "plugins/pair/plugin.ron",
            r#"(name: "pair", version: "0.1.0", about: "two passes", passes: {
                "first": (about: "a pattern", shader: "first.wgsl",
                    ports: { "result": (about: "it", size: Frame(1.0), disabled: Constant(0.0, 0.0, 0.0, 1.0)) },
                    params: { "extra": (about: "more", default: false) }),
                "second": (about: "a curve", shader: "second.wgsl", ports: {
                    "input": (about: "what comes in"),
                    "result": (about: "what goes out", size: Same("input"), disabled: Input("input")) }),
            })"#,
        );
        folder.put(
            "pair.graph.ron",
            r#"(version: 1, size: (16, 8), passes: {
                "start": (use: "pair.first"), "end": (use: "pair.second", inputs: { "input": "start.result" }),
            }, outputs: { "end": "end.result" })"#,
        );
        folder.put(
            "pair.test.ron",
            r#"(version: 1, graph: "pair.graph.ron", size: (16, 8), taps: {
                "*": (golden: RelativeRmse(1e-5), properties: [Finite, AlphaOne, Varies]),
                "start.result": (properties: [Range(-2.0, 9.0)]),
            })"#,
        );
        let outcome = folder.session().run(&folder.test(), &Options { bless: true, ..Options::default() });
        assert!(outcome.passed(), "{}", outcome.text());
        folder
    }

    fn put(&self, name: &str, text: &str) {
        let path = self.0.path().join(name);
        std::fs::create_dir_all(path.parent().unwrap()).unwrap();
        std::fs::write(path, text).unwrap();
    }

    fn test(&self) -> PathBuf {
        self.0.path().join("pair.test.ron")
    }

    fn session(&self) -> Session {
        let search = vec![SearchPath { path: self.0.path().join("plugins"), required: true }];
        Session::new(Vec::new(), search, None).unwrap_or_else(|error| panic!("{error}"))
    }

    fn hunt(&self, per_pass: usize, seed: u64) -> Result<Vec<PassFindings>, Trouble> {
        let request = self.request(per_pass, seed, vec![self.test()]);
        hunt(&mut self.session(), &request, &mut |_| {})
    }

    fn request(&self, per_pass: usize, seed: u64, tests: Vec<PathBuf>) -> Hunt {
        Hunt { tests, filter: String::new(), per_pass, seed, goldens: true, every_test: false, untested: true }
    }
}

fn all(findings: &[PassFindings]) -> Vec<(String, String, String)> {
    let of_pass = |of_pass: &PassFindings| {
        let pass = of_pass.pass.clone();
        let mutant =
            move |mutant: &Mutant| (pass.clone(), mutant.mutation.function.clone(), mutant.mutation.change.clone());
        of_pass.mutants.iter().map(mutant).collect::<Vec<_>>()
    };
    findings.iter().flat_map(of_pass).collect()
}

/// Every mistake that can be made at all. Only what no test reaches survives; no mutant of one pass is laid at the other.
#[test]
fn mutants_are_killed_and_laid_at_their_own_pass() {
    let findings = Folder::new().hunt(1000, 1).unwrap_or_else(|_| panic!("it can be hunted"));
    assert_eq!(findings.iter().map(|of_pass| of_pass.pass.as_str()).collect::<Vec<_>>(), ["pair.first", "pair.second"]);
    let figures = Figures::of(&findings);
    assert_eq!(figures.misnamed, 0);
    for of_pass in &findings {
        assert_eq!(of_pass.mutants.len() + of_pass.invalid, of_pass.sites, "{}", of_pass.pass);
        for mutant in of_pass.mutants.iter().filter(|mutant| !mutant.verdict.is_killed()) {
            let mutation = &mutant.mutation;
            // `more` is 0 as long as `extra` is off.
            assert!(mutation.function == "never" || mutation.change.contains("more"), "{}", mutation.change);
            assert!(matches!(mutant.verdict, Verdict::Unreached | Verdict::SameBits), "{:?}", mutant.verdict);
        }
    }
    assert!(figures.survived >= 4 && figures.killed > 20, "{figures:?}");
    assert!(figures.without_goldens < figures.killed, "goldens notice what these properties do not");
    let text = findings.iter().flat_map(missed).collect::<Vec<_>>().join("\n");
    assert!(text.contains("first.wgsl:4:") && text.contains("no test reaches it"), "{text}");
    assert_eq!(table(&findings).len(), 3);
    assert_eq!(json(1, &findings)["figures"]["killed"], figures.killed);
}

#[test]
fn a_seed_gives_the_same_mutants_again() {
    let folder = Folder::new();
    let drawn = |seed| all(&folder.hunt(5, seed).unwrap_or_else(|_| panic!("it can be hunted")));
    assert_eq!(drawn(7), drawn(7));
    assert_ne!(drawn(7), drawn(8));
    assert_eq!(drawn(7).len(), 10);
}

fn mistakes(result: Result<Vec<PassFindings>, Trouble>) -> String {
    match result {
        Err(Trouble::Error(error)) => error.to_string(),
        Ok(_) => "no mistake".to_owned(),
        Err(other) => format!("{other:?}"),
    }
}

#[test]
fn a_reason_is_told_and_kills_nothing_and_a_stale_one_is_a_mistake() {
    let folder = Folder::new();
    let reason = |function: &str, change: &str| {
        let text = format!(
            r#"{{ "pair.first": [(function: "{function}", change: "{change}", reason: "it is switched off")] }}"#
        );
        folder.put(&format!("plugins/pair/{REASONS}"), &text);
    };
    reason("never", "at.x * 7.0 -> at.x");
    let findings = folder.hunt(1000, 1).unwrap_or_else(|_| panic!("the reason is one of a survivor"));
    let figures = Figures::of(&findings);
    assert_eq!(figures.explained, 1);
    assert!(figures.survived >= 4);
    assert!(findings.iter().flat_map(missed).any(|line| line.contains("reason: it is switched off")));

    reason("never", "at.x * 8.0 -> at.x");
    assert!(mistakes(folder.hunt(1, 1)).contains("no such mutant can be made"));
    reason("curve", "value * vec3 -> value");
    assert!(mistakes(folder.hunt(1, 1)).contains("no such mutant can be made"));
    reason("main", "at.y - 4.0 -> at.y + 4.0");
    let Err(Trouble::Needless(findings, needless)) = folder.hunt(1000, 1) else { panic!("it is needless") };
    assert!(needless.iter().any(|mistake| mistake.message.contains("this mutant does not survive")));
    assert_eq!(findings.len(), 2, "and what was found is there all the same");
}

/// A second test looks at the end alone, and lays mistakes of the first pass at the second: whoever asks for the first test
/// that notices may hear of the other, and whoever asks every test hears of this one. (Alpha does not get so far.)
#[test]
fn every_test_is_asked_whom_it_blames() {
    let folder = Folder::new();
    folder.put(
        "end.test.ron",
        r#"(version: 1, graph: "pair.graph.ron", size: (16, 8), taps: { "end.result": (golden: RelativeRmse(1e-5)) })"#,
    );
    let end = folder.0.path().join("end.test.ron");
    assert!(folder.session().run(&end, &Options { bless: true, ..Options::default() }).passed());
    let request = folder.request(1000, 1, vec![folder.test(), end]);
    let every = Hunt { every_test: true, filter: "first".to_owned(), ..request };
    let findings = hunt(&mut folder.session(), &every, &mut |_| {}).unwrap_or_else(|_| panic!("it can be hunted"));
    let figures = Figures::of(&findings);
    assert!(figures.misnamed > 10 && figures.killed < 5, "{figures:?}");
    assert!(findings.iter().flat_map(missed).any(|line| line.contains("end fails, and names `pair.second`")));
}

#[test]
fn a_test_that_fails_by_itself_says_nothing_about_mutants() {
    let folder = Folder::new();
    folder.put("plugins/pair/second.wgsl", &SECOND.replace("0.05 *", "0.5 *"));
    assert!(matches!(folder.hunt(1, 1), Err(Trouble::Failing(_))));
    // It does not run for the mutants of passes that it has nothing to do with.
    let request = Hunt { filter: "third".to_owned(), ..folder.request(1, 1, vec![folder.test()]) };
    assert!(hunt(&mut folder.session(), &request, &mut |_| {}).is_ok_and(|findings| findings.is_empty()));
}
