//! A chain of five passes in a folder of its own, each a WGSL file that a test can break.

use std::path::PathBuf;

use tempfile::TempDir;
use tyndall_plugin::SearchPath;
use tyndall_testing::{Options, Outcome, Session};

/// The passes, in order.
pub const PASSES: [&str; 5] = ["one", "two", "three", "four", "five"];

/// The line that a test replaces: what becomes of a texel.
pub const LINE: &str = "    let value = texel(id.xy) * vec3(0.9, 0.8, 0.7) + vec3(0.01, 0.02, 0.03);";

/// A folder with the plugin `chain`, a graph and a test.
pub struct Chain {
    folder: TempDir,
}

fn shader(line: &str) -> String {
    format!(
        "var input: texture_2d<f32>;
var result: texture_storage_2d<rgba32float, write>;
fn texel(at: vec2<u32>) -> vec3<f32> {{
    return textureLoad(input, min(at, textureDimensions(result) - 1u), 0).rgb;
}}
@compute @workgroup_size(8, 8)
fn main(@builtin(global_invocation_id) id: vec3<u32>) {{
    if any(id.xy >= textureDimensions(result)) {{
        return;
    }}
{line}
    textureStore(result, id.xy, vec4(value, 1.0));
}}
"
    )
}

const SOURCE: &str = "var result: texture_storage_2d<rgba32float, write>;
@compute @workgroup_size(8, 8)
fn main(@builtin(global_invocation_id) id: vec3<u32>) {
    let at = vec2<f32>(id.xy);
    textureStore(result, id.xy, vec4(0.5 + 0.5 * sin(at.x * 0.7), fract(at.y * 0.13), at.x * at.y / 300.0, 1.0));
}
";

impl Chain {
    /// The whole chain, unbroken, with every port blessed.
    pub fn new() -> Self {
        let chain = Self { folder: tempfile::tempdir().unwrap() };
        let port = "\"input\": (about: \"what comes in\"), \"result\": (about: \"what goes out\", size: Same(\"input\"), disabled: Input(\"input\"))";
        let pass =
            |name: &&str| format!("\"{name}\": (about: \"a link\", shader: \"{name}.wgsl\", ports: {{ {port} }}),");
        let passes: String = PASSES.iter().map(pass).collect();
        let source = "\"source\": (about: \"the start\", shader: \"source.wgsl\", ports: { \"result\": (about: \"a pattern\", size: Frame(1.0), disabled: Constant(0.0, 0.0, 0.0, 1.0)) }),";
        let manifest =
            format!("(name: \"chain\", version: \"0.1.0\", about: \"five links\", passes: {{ {source} {passes} }})");
        chain.put("plugins/chain/plugin.ron", &manifest);
        chain.put("plugins/chain/source.wgsl", SOURCE);
        PASSES.iter().for_each(|name| chain.put(&format!("plugins/chain/{name}.wgsl"), &shader(LINE)));
        let mut before = "start".to_owned();
        let mut graph = "\"start\": (use: \"chain.source\"),".to_owned();
        for name in PASSES {
            graph += &format!("\"{name}\": (use: \"chain.{name}\", inputs: {{ \"input\": \"{before}.result\" }}),");
            before = name.to_owned();
        }
        // A side branch, which has nothing to do with what comes after the first link.
        graph += "\"aside\": (use: \"chain.five\", inputs: { \"input\": \"one.result\" }),";
        chain.put(
            "chain.graph.ron",
            &format!("(version: 1, size: (24, 16), passes: {{ {graph} }}, outputs: {{ \"end\": \"five.result\", \"aside\": \"aside.result\" }})"),
        );
        chain.test("\"*\": (golden: RelativeRmse(1e-5))", "");
        let blessed = chain.run(&Options { bless: true, ..Options::default() });
        assert!(blessed.passed(), "{}", blessed.text());
        assert_eq!(blessed.blessed.len(), 7, "{:?}", blessed.blessed);
        chain
    }

    /// Writes the test file anew; the goldens stay.
    pub fn test(&self, taps: &str, more: &str) {
        let text = format!("(version: 1, graph: \"chain.graph.ron\", size: (24, 16), taps: {{ {taps} }}, {more})");
        self.put("chain.test.ron", &text);
    }

    /// Replaces what a link does.
    pub fn set_line(&self, link: &str, line: &str) {
        self.put(&format!("plugins/chain/{link}.wgsl"), &shader(line));
    }

    /// A path in the folder.
    pub fn path(&self, name: &str) -> PathBuf {
        self.folder.path().join(name)
    }

    /// Writes a file.
    pub fn put(&self, name: &str, text: &str) {
        let path = self.path(name);
        std::fs::create_dir_all(path.parent().unwrap()).unwrap();
        std::fs::write(path, text).unwrap();
    }

    /// Runs the test in a session of its own.
    pub fn run(&self, options: &Options) -> Outcome {
        let search = vec![SearchPath { path: self.path("plugins"), required: true }];
        let mut session =
            Session::new(vec![tyndall_core::plugin], search, None).unwrap_or_else(|error| panic!("{error}"));
        session.run(&self.path("chain.test.ron"), options)
    }

    /// Runs the test as a user does.
    pub fn plain(&self) -> Outcome {
        self.run(&Options::default())
    }

    /// Runs every pass alone.
    pub fn isolated(&self) -> Outcome {
        self.run(&Options { isolate: true, ..Options::default() })
    }
}
