//! Passes that read the frame before: what is wrong there is laid at the pass that was wrong then.

use tempfile::TempDir;
use tyndall_plugin::SearchPath;
use tyndall_testing::{Options, Outcome, Session, State};

const MANIFEST: &str = r#"(name: "trail", version: "0.1.0", about: "what remembers", passes: {
    "source": (about: "a pattern that changes with the frame", shader: "source.wgsl",
        ports: { "result": (about: "a pattern", size: Frame(1.0)) },
        params: { "frame": (about: "number of the frame", default: 0.0) }),
    "mix": (about: "this frame and the one before", shader: "mix.wgsl",
        ports: {
            "input": (about: "this frame"),
            "before": (about: "the frame before", history: (0.25, 0.5, 0.75, 1.0)),
            "result": (about: "both", size: Same("input")),
        },
        params: { "frame": (about: "number of the frame", default: 0.0) }),
    "grade": (about: "brighter", shader: "grade.wgsl",
        ports: { "input": (about: "what comes in"), "result": (about: "what goes out", size: Same("input")) },
        params: { "frame": (about: "number of the frame", default: 0.0) }),
})"#;

const GRAPH: &str = r#"(version: 1, size: (12, 8), passes: {
    "source": (use: "trail.source", params: { "frame": "$frame" }),
    "mix": (use: "trail.mix", inputs: { "input": "source.result", "before": "grade.result" }, params: { "frame": "$frame" }),
    "grade": (use: "trail.grade", inputs: { "input": "mix.result" }, params: { "frame": "$frame" }),
}, outputs: { "end": "grade.result" })"#;

const TEST: &str = r#"(version: 1, graph: "trail.graph.ron", size: (12, 8), frames: [0, 1, 2, 3],
    taps: { "*": (golden: RelativeRmse(1e-5)) })"#;

/// The value of a texel of each pass where nothing is broken.
const RIGHT: [(&str, &str); 3] = [
    ("source", "fract(vec3(0.31, 0.17, 0.07) * vec3(vec2<f32>(id.xy), params.frame + 1.0))"),
    ("mix", "0.5 * textureLoad(input, id.xy, 0).rgb + 0.5 * textureLoad(before, id.xy, 0).rgb"),
    ("grade", "1.1 * textureLoad(input, id.xy, 0).rgb"),
];

/// A folder with the plugin, a graph in which `mix` reads what `grade` wrote in the frame before, and a test of it.
struct Trail {
    folder: TempDir,
}

impl Trail {
    /// Unbroken, and blessed.
    fn new() -> Self {
        let trail = Self { folder: tempfile::tempdir().unwrap() };
        std::fs::create_dir_all(trail.folder.path().join("plugins/trail")).unwrap();
        trail.put("plugins/trail/plugin.ron", MANIFEST);
        trail.put("trail.graph.ron", GRAPH);
        trail.put("trail.test.ron", TEST);
        RIGHT.iter().for_each(|(pass, value)| trail.set(pass, value));
        let blessed = trail.run(&Options { bless: true, ..Options::default() });
        assert!(blessed.passed() && blessed.blessed.len() == 12, "{}", blessed.text());
        trail
    }

    fn put(&self, name: &str, text: &str) {
        std::fs::write(self.folder.path().join(name), text).unwrap();
    }

    /// Replaces what a pass writes.
    fn set(&self, pass: &str, value: &str) {
        let inputs = match pass {
            "source" => "",
            "mix" => "var input: texture_2d<f32>;\nvar before: texture_2d<f32>;\n",
            _ => "var input: texture_2d<f32>;\n",
        };
        let shader = format!(
            "struct Params {{ frame: f32 }}
var<uniform> params: Params;
{inputs}var result: texture_storage_2d<rgba32float, write>;
@compute @workgroup_size(8, 8)
fn main(@builtin(global_invocation_id) id: vec3<u32>) {{
    if any(id.xy >= textureDimensions(result)) {{ return; }}
    let now = params.frame;
    textureStore(result, id.xy, vec4({value} + 0.0 * now, 1.0));
}}
"
        );
        self.put(&format!("plugins/trail/{pass}.wgsl"), &shader);
    }

    /// With this much more in one pass, from a WGSL expression of the number of the frame, `now`.
    fn broken(&self, pass: &str, more: &str) -> Outcome {
        let right = RIGHT.iter().find(|(name, _)| *name == pass).map_or("", |(_, value)| *value);
        self.set(pass, &format!("{right} + {more}"));
        let outcome = self.run(&Options::default());
        self.set(pass, right);
        outcome
    }

    fn run(&self, options: &Options) -> Outcome {
        let search = vec![SearchPath { path: self.folder.path().join("plugins"), required: true }];
        let mut session =
            Session::new(vec![tyndall_core::plugin], search, None).unwrap_or_else(|error| panic!("{error}"));
        session.run(&self.folder.path().join("trail.test.ron"), options)
    }
}

/// The states of a pass's ports, frame by frame.
fn states(outcome: &Outcome, pass: &str) -> Vec<State> {
    outcome.ports.iter().filter(|port| port.pass == pass).map(|port| port.state).collect()
}

use State::{Guilty, Inherited, Passed};

/// `mix` comes before `grade` in every frame, and differs in all but the first because of it.
#[test]
fn what_the_frame_before_brings_is_inherited() {
    let trail = Trail::new();
    let outcome = trail.broken("grade", "0.1");
    assert_eq!(outcome.guilty(), ["grade"], "{}", outcome.text());
    assert_eq!(outcome.inherited(), ["mix"]);
    assert_eq!(states(&outcome, "source"), [Passed; 4]);
    assert_eq!(states(&outcome, "mix"), [Passed, Inherited, Inherited, Inherited]);
    assert_eq!(states(&outcome, "grade"), [Guilty, Inherited, Inherited, Inherited]);
    // And each golden knows of the shader that changed, before it or in frames before.
    assert!(outcome.ports.iter().all(|port| port.stale.is_empty() == (port.pass == "source")), "{}", outcome.text());
    assert!(trail.run(&Options::default()).ports.iter().all(|port| port.stale.is_empty()));
}

/// Alone a pass is fed from goldens, and what follows in the graph and in time changes nothing of that.
#[test]
fn alone_a_pass_reads_goldens_and_not_the_frame_before() {
    let trail = Trail::new();
    let isolate = Options { isolate: true, ..Options::default() };
    let right = trail.run(&isolate);
    assert!(right.passed(), "{}", right.text());
    assert_eq!(right.left_out.len(), 3, "`mix` in frames 1 to 3: {:?}", right.left_out);
    trail.set("source", "vec3(0.5)");
    let outcome = trail.run(&isolate);
    assert_eq!((outcome.guilty(), outcome.inherited().len()), (vec!["source"], 0), "{}", outcome.text());
}

/// A mistake that begins in a later frame is laid at the pass that makes it, and what follows it in time inherits.
#[test]
fn a_mistake_of_one_frame_is_followed_through_those_after_it() {
    let trail = Trail::new();
    for (pass, mix, grade) in [
        ("mix", [Passed, Guilty, Inherited, Inherited], [Passed, Inherited, Inherited, Inherited]),
        ("grade", [Passed, Passed, Inherited, Inherited], [Passed, Guilty, Inherited, Inherited]),
    ] {
        let outcome = trail.broken(pass, "select(0.0, 0.1, now == 1.0)");
        assert_eq!(outcome.guilty(), [pass], "{}", outcome.text());
        assert_eq!((states(&outcome, "mix"), states(&outcome, "grade")), (mix.to_vec(), grade.to_vec()), "{pass}");
    }
    let outcome = trail.broken("source", "select(0.0, 0.1, now == 2.0)");
    assert_eq!(outcome.guilty(), ["source"], "{}", outcome.text());
    assert_eq!(states(&outcome, "source"), [Passed, Passed, Guilty, Passed]);
    assert_eq!(states(&outcome, "mix"), [Passed, Passed, Inherited, Inherited]);
}

/// Nothing wrong is left over from a frame that was right.
#[test]
fn the_last_frame_alone_names_its_own_pass() {
    let trail = Trail::new();
    let outcome = trail.broken("mix", "select(0.0, 0.1, now == 3.0)");
    assert_eq!(states(&outcome, "mix"), [Passed, Passed, Passed, Guilty], "{}", outcome.text());
    assert_eq!(states(&outcome, "grade"), [Passed, Passed, Passed, Inherited]);
}

/// Two graphs that differ in nothing but whether a parameter is the number of the frame or its time share no result.
#[test]
fn a_frame_and_its_time_are_told_apart() {
    let trail = Trail::new();
    let graph = |name: &str| {
        GRAPH.replace("\"before\": \"grade.result\"", "\"before\": \"source.result\"").replace("$frame", name)
    };
    for name in ["frame", "time"] {
        trail.put(&format!("{name}.graph.ron"), &graph(&format!("${name}")));
        let test = format!(
            "(version: 1, graph: \"{name}.graph.ron\", size: (12, 8), frames: [12], taps: {{ \"source.*\": (golden: Exact) }})"
        );
        trail.put(&format!("{name}.test.ron"), &test);
    }
    let search = vec![SearchPath { path: trail.folder.path().join("plugins"), required: true }];
    let mut session = Session::new(vec![tyndall_core::plugin], search, None).unwrap();
    let mut run = |name: &str, bless| {
        let path = trail.folder.path().join(format!("{name}.test.ron"));
        assert!(session.run(&path, &Options { bless, ..Options::default() }).passed());
        std::fs::read(trail.folder.path().join(format!("{name}.goldens/source.result.exr"))).unwrap()
    };
    let [frame, time] = ["frame", "time"].map(|name| run(name, true));
    assert!(frame != time, "frame 12 is half a second");
    assert_eq!(["frame", "time"].map(|name| run(name, false)), [frame, time]);
}

/// Two manifests that list the ports of one shader in another order: neither gets what the other rendered.
#[test]
fn manifests_that_list_ports_otherwise_share_no_result() {
    let desk = tempfile::tempdir().unwrap();
    let put = |name: &str, text: &str| {
        let path = desk.path().join(name);
        std::fs::create_dir_all(path.parent().unwrap()).unwrap();
        std::fs::write(path, text).unwrap();
    };
    let shader = "var left: texture_storage_2d<rgba32float, write>;
var right: texture_storage_2d<rgba32float, write>;
@compute @workgroup_size(8, 8)
fn main(@builtin(global_invocation_id) id: vec3<u32>) {
    textureStore(left, id.xy, vec4(0.25, f32(id.x), 0.0, 1.0));
    textureStore(right, id.xy, vec4(0.75, f32(id.y), 0.0, 1.0));
}
";
    let port = |name: &str| format!("\"{name}\": (about: \"a picture\", size: Frame(1.0))");
    for (folder, ports) in [("one", ["left", "right"]), ("two", ["right", "left"])] {
        put(&format!("{folder}/plugins/pair/pair.wgsl"), shader);
        let ports = ports.map(port).join(", ");
        let manifest = format!(
            "(name: \"pair\", version: \"0.1.0\", about: \"two pictures\", passes: {{ \"both\": (about: \"both\", shader: \"pair.wgsl\", ports: {{ {ports} }}) }})"
        );
        put(&format!("{folder}/plugins/pair/plugin.ron"), &manifest);
        put(
            &format!("{folder}/pair.graph.ron"),
            "(version: 1, size: (8, 8), passes: { \"p\": (use: \"pair.both\") }, outputs: { \"left\": \"p.left\" })",
        );
        put(
            &format!("{folder}/pair.test.ron"),
            "(version: 1, graph: \"pair.graph.ron\", size: (8, 8), taps: { \"*\": (golden: Exact) })",
        );
    }
    let session = || Session::new(vec![tyndall_core::plugin], Vec::new(), None).unwrap();
    let run = |session: &mut Session, folder: &str, bless| {
        session.run(&desk.path().join(folder).join("pair.test.ron"), &Options { bless, ..Options::default() })
    };
    for folder in ["one", "two"] {
        let blessed = run(&mut session(), folder, true);
        assert!(blessed.passed() && blessed.blessed.len() == 2, "{}", blessed.text());
    }
    let mut together = session();
    for folder in ["one", "two"] {
        let outcome = run(&mut together, folder, false);
        assert!(outcome.passed(), "{folder}: {}", outcome.text());
    }
}
