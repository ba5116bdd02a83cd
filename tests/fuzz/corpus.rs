//! What files are broken: those of the repository that are small.

use std::path::{Path, PathBuf};

use tyndall_tests::broken::Random;
use tyndall_tests::root;

/// Larger files are left out: breaking them seldom meets what matters.
const MOST_BYTES: u64 = 12_000;

/// A kind of file that the program reads.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Kind {
    /// `.graph.ron`.
    Graph,
    /// `.scene.ron`.
    Scene,
    /// `.gltf` and `.glb`.
    Model,
    /// `.exr`, `.png`, `.hdr`, `.npy`.
    Picture,
    /// `plugin.ron`.
    Manifest,
    /// `.wgsl` of a plugin.
    Shader,
    /// `.test.ron`.
    Test,
}

/// All of them.
pub const KINDS: [Kind; 7] =
    [Kind::Graph, Kind::Scene, Kind::Model, Kind::Picture, Kind::Manifest, Kind::Shader, Kind::Test];

impl Kind {
    /// As the command line has it.
    pub fn name(self) -> &'static str {
        match self {
            Kind::Graph => "graph",
            Kind::Scene => "scene",
            Kind::Model => "model",
            Kind::Picture => "picture",
            Kind::Manifest => "manifest",
            Kind::Shader => "shader",
            Kind::Test => "test",
        }
    }

    /// Mistakes of fixtures are in files that are named after them, so these count by their folder's crate.
    fn of(path: &Path) -> Option<Self> {
        let name = path.file_name()?.to_str()?;
        let ends = |suffixes: &[&str]| suffixes.iter().any(|suffix| name.ends_with(suffix));
        let within = |part: &str| path.to_str().is_some_and(|path| path.contains(part));
        match () {
            () if ends(&[".graph.ron"]) || within("graph/tests/fixtures") && ends(&[".ron"]) => Some(Kind::Graph),
            () if ends(&[".scene.ron"]) || within("scene/tests/fixtures") && ends(&[".ron"]) => Some(Kind::Scene),
            () if ends(&[".gltf", ".glb"]) => Some(Kind::Model),
            () if ends(&[".exr", ".png", ".hdr", ".npy"]) => Some(Kind::Picture),
            () if name == "plugin.ron" || within("plugin/tests/fixtures") && ends(&[".ron"]) => Some(Kind::Manifest),
            () if ends(&[".wgsl"]) => Some(Kind::Shader),
            () if ends(&[".test.ron"]) || within("testing/tests/fixtures") && ends(&[".ron"]) => Some(Kind::Test),
            () => None,
        }
    }
}

/// A file that is broken.
pub struct Sample {
    pub kind: Kind,
    /// It is wrong as it stands in the repository.
    pub wrong: bool,
    /// `png`, say.
    pub suffix: String,
    pub bytes: Vec<u8>,
}

/// The files to start from.
pub struct Corpus(Vec<Sample>);

impl Corpus {
    /// The small files of `graphs`, `plugins`, `shaders` and `crates`, in the order of their names.
    pub fn of_repository() -> Self {
        let mut samples = Vec::new();
        for folder in ["graphs", "plugins", "shaders", "crates"] {
            read_folder(&root().join(folder), &mut samples);
        }
        assert!(samples.len() >= 200, "only {} files to start from", samples.len());
        Self(samples)
    }

    /// How many there are.
    pub fn len(&self) -> usize {
        self.0.len()
    }

    /// One of a kind; seldom one that is wrong already, as one mistake hides others.
    pub fn pick(&self, kind: Kind, random: &mut Random) -> &Sample {
        let wrong = random.below(5) == 0;
        let of_kind = self.0.iter().filter(|sample| sample.kind == kind);
        let mut found: Vec<&Sample> = of_kind.clone().filter(|sample| sample.wrong == wrong).collect();
        if found.is_empty() {
            found = of_kind.collect();
        }
        assert!(!found.is_empty(), "there is no {} to start from", kind.name());
        found[random.below(found.len())]
    }
}

fn read_folder(folder: &Path, samples: &mut Vec<Sample>) {
    let mut entries: Vec<PathBuf> = std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()).collect();
    entries.sort();
    for path in entries {
        if path.is_dir() {
            read_folder(&path, samples);
        } else if let Some(kind) = Kind::of(&path).filter(|_| path.metadata().unwrap().len() <= MOST_BYTES) {
            let suffix = path.extension().unwrap_or_default().to_string_lossy().into_owned();
            let bytes = std::fs::read(&path).unwrap();
            let wrong = path.iter().any(|part| part == "fixtures");
            samples.push(Sample { kind, wrong, suffix, bytes: with_whole_paths(&bytes, folder) });
        }
    }
}

/// Files that a graph, a scene or a test names are found from another folder, too.
fn with_whole_paths(bytes: &[u8], folder: &Path) -> Vec<u8> {
    let Ok(text) = std::str::from_utf8(bytes) else { return bytes.to_vec() };
    let mut text = text.to_owned();
    for before in ["scene: \"", "graph: \"", "File(\""] {
        text = text.replace(before, &format!("{before}{}/", folder.display()));
    }
    text.into_bytes()
}
