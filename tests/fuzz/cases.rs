//! One broken file, and what the program does with it.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use tyndall_document::{Diagnostics, render_json, render_text};
use tyndall_graph::Roots;
use tyndall_plugin::{Registry, SearchPath};
use tyndall_render::{Error, Loaded, Wanted, load, plan, registry};
use tyndall_testing::file;
use tyndall_tests::broken::{Random, mutate};
use tyndall_tests::tint::{GRAPH, MANIFEST, SHADER};
use tyndall_tests::{Desk, sessions};

use crate::corpus::{Corpus, Kind};
use crate::structure::{broken, broken_bytes};

const MODEL_SCENE: &str = "(camera: (position: (0, 2, 9), look_at: (0, 1, 0)), lights: [Point(position: (1, 2, 3), intensity: (9, 9, 9))], objects: [(mesh: File(\"MODEL\"))])";
const PICTURE_GRAPH: &str = "(version: 1, passes: { \"image\": (use: \"core.image\", params: { \"file\": \"PICTURE\" }) }, outputs: { \"radiance\": \"image.color\" })";

/// What became of a case.
pub enum End {
    Refused,
    Sound,
    Drawn,
}

/// A broken file.
pub struct Case {
    pub kind: Kind,
    /// Its name in the folder of the case.
    pub file: &'static str,
    pub bytes: Vec<u8>,
    suffix: String,
}

impl Case {
    /// Breaks a file of a kind.
    pub fn new(kind: Kind, corpus: &Corpus, random: &mut Random) -> Self {
        let (sample, donor) = (corpus.pick(kind, random), corpus.pick(kind, random));
        let is_text = std::str::from_utf8(&sample.bytes).is_ok();
        let bytes = match kind {
            // what others are called does not matter here
            Kind::Manifest if random.below(5) > 0 => broken(random, MANIFEST.as_bytes(), &donor.bytes),
            Kind::Shader if random.below(5) > 0 => broken(random, SHADER.as_bytes(), &donor.bytes),
            Kind::Model if !is_text && random.below(2) == 0 => broken_container(random, &sample.bytes),
            _ if is_text => broken(random, &sample.bytes, &donor.bytes),
            _ => broken_bytes(random, &sample.bytes),
        };
        let file = match kind {
            Kind::Graph => "case.graph.ron",
            Kind::Scene => "case.scene.ron",
            Kind::Model if sample.suffix == "glb" => "case.glb",
            Kind::Model => "case.gltf",
            Kind::Picture => "case.picture",
            Kind::Manifest => "plugins/tint/plugin.ron",
            Kind::Shader => "plugins/tint/invert.wgsl",
            Kind::Test => "case.test.ron",
        };
        Self { kind, file, bytes, suffix: sample.suffix.clone() }
    }
}

/// The JSON of a GLB is broken as text, and its length is told rightly.
fn broken_container(random: &mut Random, bytes: &[u8]) -> Vec<u8> {
    let length = bytes.get(12..16).and_then(|field| field.try_into().ok()).map_or(0, u32::from_le_bytes) as usize;
    let Some(json) = bytes.get(20..20 + length) else { return mutate(random, bytes) };
    let mut json = broken(random, json, json);
    json.resize(json.len().next_multiple_of(4), b' ');
    let rest = &bytes[20 + length..];
    let field = |number: usize| (number as u32).to_le_bytes();
    let whole = 20 + json.len() + rest.len();
    [&bytes[..8], &field(whole), &field(json.len()), &bytes[16..20], &json, rest].concat()
}

/// Where cases are run: a folder, and a registry that is kept.
pub struct Bench {
    desk: Desk,
    at_work: PathBuf,
    registry: Arc<Registry>,
}

impl Bench {
    /// `at_work` is the folder in which the case that runs is found.
    pub fn new(at_work: &Path) -> Self {
        let desk = Desk::new();
        desk.put("tint.graph.ron", GRAPH);
        let fog = desk.path("fog.graph.ron");
        let registry = sessions().with(|session| session.registry(&fog)).unwrap().unwrap();
        Self { desk, at_work: at_work.to_owned(), registry }
    }

    /// Writes a case, first to where it can be found if it ends the process.
    pub fn put(&self, case: Case) -> Case {
        let name = Path::new(case.file).file_name().unwrap();
        std::fs::create_dir_all(&self.at_work).unwrap();
        std::fs::write(self.at_work.join(name), &case.bytes).unwrap();
        if let Kind::Manifest | Kind::Shader = case.kind {
            self.desk.put("plugins/tint/plugin.ron", MANIFEST);
            self.desk.put("plugins/tint/invert.wgsl", SHADER);
        }
        self.desk.put(case.file, &case.bytes);
        case
    }

    /// Reads and checks a case, and draws it where that is asked for.
    pub fn run(&self, case: &Case, draws: bool) -> End {
        match case.kind {
            Kind::Graph => self.render("case.graph.ron", None, draws),
            Kind::Scene => self.render("fog.graph.ron", Some("case.scene.ron"), draws),
            Kind::Model => {
                self.desk.put("model.scene.ron", &MODEL_SCENE.replace("MODEL", case.file));
                self.render("fog.graph.ron", Some("model.scene.ron"), draws)
            }
            Kind::Picture => self.picture(case, draws),
            Kind::Manifest | Kind::Shader => self.plugin(),
            Kind::Test => self.test(),
        }
    }

    fn render(&self, graph: &str, scene: Option<&str>, draws: bool) -> End {
        let scene = scene.map(Path::new);
        let request = self.desk.request(Path::new(graph), scene, Some((8, 8)), &[]);
        let mut out = Diagnostics::default();
        let loaded = load(&request, &self.registry, &mut out);
        let output = loaded.as_ref().and_then(|loaded| loaded.graph.outputs.first().map(|output| output.0.clone()));
        match (checked(loaded, out), output) {
            (End::Sound, Some(output)) if draws => {
                // what a machine cannot do is refused
                let drawn = sessions().with(|session| session.draw(&request, &[&output], 0..1).is_ok()).unwrap();
                if drawn { End::Drawn } else { End::Refused }
            }
            (end, _) => end,
        }
    }

    /// By itself, and as a graph reads it.
    fn picture(&self, case: &Case, draws: bool) -> End {
        let name = format!("case.{}", case.suffix);
        self.desk.put(&name, &case.bytes);
        if tyndall_image::read(&self.desk.path(&name)).is_err() && !draws {
            return End::Refused;
        }
        self.desk.put("case.graph.ron", &PICTURE_GRAPH.replace("PICTURE", &name));
        self.render("case.graph.ron", None, draws)
    }

    fn plugin(&self) -> End {
        let search = [SearchPath { path: self.desk.path("plugins"), required: true }];
        match registry(vec![tyndall_core::plugin()], &search) {
            Ok(registry) => {
                let request = self.desk.request(Path::new("tint.graph.ron"), None, Some((8, 8)), &[]);
                let mut out = Diagnostics::default();
                checked(load(&request, &registry, &mut out), out)
            }
            Err(mistakes) => checked(None, mistakes),
        }
    }

    fn test(&self) -> End {
        let mut out = Diagnostics::default();
        let loaded = file::read(&self.desk.path("case.test.ron"), &mut out).and_then(|test| {
            let loaded = load(&test.request, &self.registry, &mut out)?;
            let has_reference = |pass: &str| self.registry.pass(pass).is_some_and(|pass| pass.reference.is_some());
            file::check(&test, &loaded.graph, &has_reference, &mut out);
            Some(loaded)
        });
        checked(loaded, out)
    }
}

/// As `tyndall check`, in both forms.
fn checked(loaded: Option<Loaded>, mut out: Diagnostics) -> End {
    if let Some(loaded) = loaded.filter(|_| !out.has_errors())
        && let Err(Error::Mistakes(mistakes)) = plan(&loaded, Wanted { roots: Roots::Outputs, keep: false, live: &[] })
    {
        out.extend(mistakes);
    }
    out.sort();
    out.dedup();
    let (text, json) = (render_text(&out, true), render_json(&out));
    assert!(out.is_empty() || !text.is_empty() && json.starts_with('['), "mistakes without a text");
    if out.has_errors() { End::Refused } else { End::Sound }
}
