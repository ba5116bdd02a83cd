//! Graphs of the shipped passes and of plugin folders, run on the machine's device.

use std::path::Path;
use std::sync::{Arc, OnceLock};

use tempfile::TempDir;
use tyndall_document::{Diagnostics, Source, render_text};
use tyndall_gpu::{Executor, FrameOptions, Gpu, PipelineCache, PortData, SceneBuffers};
use tyndall_graph::{Graph, Overrides, Plan, PlanOptions, plan, read, validate};
use tyndall_plugin::{Plugin, Registry, SearchPath, find_folders, shader_modules};
use tyndall_scene::{Extensions, Scene};

/// The plugins that are compiled into the program.
pub fn shipped() -> Vec<Plugin> {
    tyndall::shipped().iter().map(|plugin| plugin()).collect()
}

/// The shipped plugins, and those of these folders of plugins; nothing is linked.
pub fn unchecked_registry(paths: &[&Path]) -> Registry {
    let paths: Vec<SearchPath> =
        paths.iter().map(|path| SearchPath { path: path.to_path_buf(), required: true }).collect();
    let folders = find_folders(&paths).unwrap();
    let shared = shader_modules(tyndall_shaders::MODULES, &[]).unwrap();
    let registry = Registry::new(shipped(), folders, &shared);
    registry.with_picture_size(|path| tyndall_image::read(path).ok().map(|image| (image.width, image.height)))
}

/// The same, with every pass linked and checked.
pub fn try_registry(paths: &[&Path]) -> Result<Registry, Diagnostics> {
    let registry = unchecked_registry(paths);
    let mistakes = registry.mistakes();
    if mistakes.is_empty() { Ok(registry) } else { Err(mistakes) }
}

pub fn registry(paths: &[&Path]) -> Registry {
    try_registry(paths).unwrap_or_else(|mistakes| panic!("{}", render_text(&mistakes, false)))
}

/// A plugin's folder within a folder of plugins.
pub fn put(plugins: &Path, name: &str, files: &[(&str, &str)]) {
    let folder = plugins.join(name);
    std::fs::create_dir_all(&folder).unwrap();
    for (file, text) in files {
        std::fs::write(folder.join(file), text).unwrap();
    }
}

/// A registry with a plugin from a folder outside the repository, which is gone afterwards: nothing is read later.
pub fn with_plugin(name: &str, files: &[(&str, &str)]) -> Registry {
    let plugins = TempDir::new().unwrap();
    put(plugins.path(), name, files);
    registry(&[plugins.path()])
}

pub fn gpu() -> Arc<Gpu> {
    Gpu::open(None).unwrap_or_else(|error| panic!("{error}"))
}

pub fn graph(registry: &Registry, text: &str) -> Arc<Graph> {
    let mut out = Diagnostics::default();
    let file = read(&Source::new("test.graph.ron", text), &mut out);
    let graph = file.and_then(|file| validate(&file, registry.catalogue(), &Overrides::default(), &mut out));
    assert!(out.is_empty(), "{}\n{text}", render_text(&out, false));
    graph.unwrap()
}

/// A plan of a graph file's text, in the size that it names, with other options.
pub fn planned(registry: &Registry, text: &str, change: impl FnOnce(&Graph, &mut PlanOptions)) -> Plan {
    let graph = graph(registry, text);
    let mut options = PlanOptions::new(graph.size);
    change(&graph, &mut options);
    plan(&graph, &options).unwrap_or_else(|mistakes| panic!("{}", render_text(&mistakes, false)))
}

pub fn executor(gpu: &Arc<Gpu>, registry: &Registry, plan: Plan) -> Executor {
    let cache = &mut PipelineCache::default();
    Executor::new(gpu, Arc::new(plan), registry, cache, SceneBuffers::default()).unwrap_or_else(|e| panic!("{e}"))
}

/// A point light and a sun over a floor with a sphere; `lights` may move.
pub fn scene(lights: &str) -> Scene {
    scene_of(&scene_text(lights))
}

/// The file of [`scene`].
pub fn scene_text(lights: &str) -> String {
    format!(
        "(
            camera: (position: (0.0, 1.5, 6.0), look_at: (0.0, 1.0, 0.0), vertical_fov: 50.0),
            medium: (extinction: (0.05, 0.06, 0.08), albedo: (0.9, 0.8, 0.7), phase: HenyeyGreenstein(g: 0.7)),
            background: (0.01, 0.02, 0.03),
            lights: [{lights}],
            objects: [
                (mesh: Sphere(radius: 1.0), translation: (0.0, 1.0, 0.0), material: (specular: (0.2, 0.2, 0.2), shininess: 20.0)),
                (mesh: Plane(size: (20.0, 20.0))),
            ],
        )"
    )
}

/// What the shipped plugins add to scenes.
fn extensions() -> &'static Arc<Extensions> {
    static EXTENSIONS: OnceLock<Arc<Extensions>> = OnceLock::new();
    EXTENSIONS.get_or_init(|| unchecked_registry(&[]).extensions().clone())
}

/// A scene of a file's text.
pub fn scene_of(text: &str) -> Scene {
    let source = Source::new("test.scene.ron", text);
    match Scene::from_source(&source, Path::new("."), &tyndall_scene::Overrides::new(), extensions()) {
        Ok((scene, _)) => scene,
        Err(mistakes) => panic!("{}", render_text(&mistakes, false)),
    }
}

pub const LIGHTS: &str = "
    Point(position: (1.0, 2.5, 0.0), intensity: (20.0, 18.0, 15.0)),
    Spot(position: (-2.0, 3.0, 1.0), direction: (0.5, -1.0, 0.0), intensity: (30.0, 30.0, 30.0), exponent: 4.0, cutoff: 30.0),
    Directional(direction: (0.3, -1.0, 0.2), irradiance: (0.5, 0.5, 0.6)),";

/// Brings a scene to a time; what has not changed costs a hash.
pub fn set_scene(executor: &mut Executor, scene: &Scene, time: f64) {
    let gpu = executor.gpu().clone();
    for (name, bytes) in &scene.encode(time, 4.0 / 3.0).items {
        executor.scene.set(&gpu, name, bytes).unwrap();
    }
}

/// Runs every pass once.
pub fn run_all(executor: &mut Executor) {
    executor.frame(FrameOptions { everything: true, ..FrameOptions::default() }).unwrap();
}

/// The content of `pass.port`, or of an output.
pub fn content(executor: &Executor, name: &str) -> PortData {
    let port = executor.plan().find(name).unwrap_or_else(|| panic!("no port `{name}`"));
    executor.read(port).unwrap()
}

/// The bits of every number, so that NaN equals itself and 0 is not -0.
pub fn bits(data: &PortData) -> Vec<u32> {
    data.floats().iter().map(|number| number.to_bits()).collect()
}

/// The plan, the values and the scene of the shipped fog graph, without its file.
pub const FOG: &str = r#"(
    version: 1,
    size: (40, 30),
    passes: {
        "surfaces": (use: "core.gbuffer"),
        "lit": (use: "surface_radiance.phong", inputs: { "depth": "surfaces.depth", "normal": "surfaces.normal", "material": "surfaces.material" }, params: { "scattered": false }),
        "air": (use: "airlight.homogeneous", inputs: { "depth": "surfaces.depth" }),
        "fogged": (use: "core.compose", inputs: { "surface": "lit.radiance", "airlight": "air.radiance", "depth": "surfaces.depth" }),
        "display": (use: "core.tonemap", inputs: { "radiance": "fogged.radiance" }),
    },
    outputs: { "radiance": "fogged.radiance", "airlight": "air.radiance", "surface": "lit.radiance", "image": "display.color" },
)"#;

/// Numbers that look random, the same in every run.
pub struct Random(pub u64);

impl Random {
    /// Below `end`.
    pub fn below(&mut self, end: usize) -> usize {
        // Marsaglia 2003, xorshift64.
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        (self.0 >> 11) as usize % end
    }
}
