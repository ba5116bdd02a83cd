//! The passes of the plugin in a graph, and one that shows each light to surfaces at all angles to it.

use std::f64::consts::PI;
use std::path::Path;
use std::sync::Arc;

use glam::DVec3;
use tempfile::TempDir;
use tyndall_document::{Diagnostics, Source, render_text};
use tyndall_gpu::{Executor, FrameOptions, Gpu, PipelineCache, SceneBuffers};
use tyndall_graph::{Overrides, PlanOptions, plan, read, validate};
use tyndall_plugin::{Registry, SearchPath, find_folders, shader_modules};
use tyndall_scene::Scene;

pub const LIGHTS: usize = 8;
pub const ANGLES: usize = 20;

/// Between the way to the light and the axis of a lobe: from 0 to π, most of them near the light.
pub fn angle(index: usize) -> f64 {
    PI * (index as f64 / (ANGLES - 1) as f64).powi(2)
}

/// The axis at this angle.
pub fn turned(to_light: DVec3, angle: f64) -> DVec3 {
    let across = to_light.cross(DVec3::new(0.36, 0.48, 0.8)).normalize();
    to_light * angle.cos() + across * angle.sin()
}

const MANIFEST: &str = r#"(
    name: "mirror", version: "0.1.0", about: "For tests.",
    passes: {
        "turn": (about: "A surface with one lobe, turned from each light by all angles.", shader: "turn.wgsl",
            ports: {
                "table": (about: "Of `surface_radiance.lobes`", class: Data),
                "radiance": (about: "x: the light; y: the angle", size: Fixed(8, 20)),
            },
            params: {
                "layer": (about: "Of the table; 0 is Lambert", default: 0, range: (0, 32)),
                "shininess": (about: "n", default: 1.0, range: (0.0, 1e9)),
            }),
    },
)"#;

const SHADER: &str = "
#import scene
#import reflection

struct Params {
    layer: u32,
    shininess: f32,
}

struct Layers {
    count: u32,
    pad0: u32,
    pad1: u32,
    pad2: u32,
    items: array<u32>,
}

var<uniform> params: Params;
var<uniform> medium: Medium;
var<storage, read> lights: Lights;
var<storage, read> spot_layers: Layers;
var table: texture_2d_array<f32>;
var radiance: texture_storage_2d<rgba32float, write>;

@compute @workgroup_size(8, 8)
fn main(@builtin(global_invocation_id) id: vec3<u32>) {
    let size = textureDimensions(radiance);
    if any(id.xy >= size) {
        return;
    }
    let light = lights.items[id.x];
    let to_light = incident_light(light, vec3<f32>(0.0)).to_light;
    let across = normalize(cross(to_light, vec3<f32>(0.36, 0.48, 0.8)));
    let share = f32(id.y) / f32(size.y - 1u);
    let axis = to_light * cos(PI * share * share) + across * sin(PI * share * share);
    let one = vec3<f32>(1.0);
    let zero = vec3<f32>(0.0);
    let is_lambert = params.layer == 0u;
    let surface = Surface(zero, select(zero, one, is_lambert), select(one, zero, is_lambert), params.shininess,
        lookup_of(axis, 0u, 1.0, table), lookup_of(axis, params.layer, params.shininess, table));
    textureStore(radiance, id.xy, vec4<f32>(reflected(light, spot_layers.items[id.x], medium, surface, false, true, table), 1.0));
}
";

/// Of each lobe, light and angle: radiance without the reflectance.
pub type Pictures = Vec<Vec<Vec<[f64; 3]>>>;

pub struct Desk {
    gpu: Arc<Gpu>,
    registry: Registry,
    graph: String,
    lobes: usize,
}

impl Desk {
    /// For Lambert, and Phong lobes of all but the first of these shininesses.
    pub fn new(shininesses: &[f64]) -> Self {
        let plugins = TempDir::new().unwrap();
        let folder = plugins.path().join("mirror");
        std::fs::create_dir_all(&folder).unwrap();
        std::fs::write(folder.join("plugin.ron"), MANIFEST).unwrap();
        std::fs::write(folder.join("turn.wgsl"), SHADER).unwrap();
        let folders = find_folders(&[SearchPath { path: plugins.path().to_path_buf(), required: true }]).unwrap();
        let shared = shader_modules(tyndall_shaders::MODULES, &[]).unwrap();
        let registry = Registry::new(vec![tyndall_surface_radiance::plugin()], folders, &shared);
        let turns: String = shininesses
            .iter()
            .enumerate()
            .map(|(i, n)| format!("\"turn_{i}\": (use: \"mirror.turn\", inputs: {{ \"table\": \"lobes.table\" }}, params: {{ \"layer\": {i}, \"shininess\": {n:?} }}),\n"))
            .collect();
        let outputs: String = (0..shininesses.len()).map(|i| format!("\"out_{i}\": \"turn_{i}.radiance\",")).collect();
        let graph = format!(
            r#"(version: 1, size: (8, 8), passes: {{
                "around": (use: "surface_radiance.zonal"),
                "lobes": (use: "surface_radiance.lobes", inputs: {{ "glow": "around.glow", "coefficients": "around.coefficients" }}),
                {turns}
            }}, outputs: {{ {outputs} }})"#
        );
        let gpu = Gpu::open(None).unwrap_or_else(|error| panic!("{error}"));
        Self { gpu, registry, graph, lobes: shininesses.len() }
    }

    pub fn draw(&self, lights: &str, objects: &str, medium: &str) -> Pictures {
        let text = format!(
            "(camera: (position: (0.0, 0.0, 1.0), look_at: (0.0, 0.0, 0.0)), medium: ({medium}), lights: [{lights}], objects: [{objects}])"
        );
        let source = Source::new("test.scene.ron", text);
        let overrides = tyndall_scene::Overrides::new();
        let (scene, _) = Scene::from_source(&source, Path::new("."), &overrides, self.registry.extensions())
            .unwrap_or_else(|mistakes| panic!("{}", render_text(&mistakes, false)));
        let mut out = Diagnostics::default();
        let file = read(&Source::new("test.graph.ron", self.graph.as_str()), &mut out);
        let graph = file.and_then(|file| validate(&file, self.registry.catalogue(), &Overrides::default(), &mut out));
        assert!(out.is_empty(), "{}", render_text(&out, false));
        let graph = graph.unwrap();
        let plan = plan(&graph, &PlanOptions::new(graph.size)).unwrap_or_else(|m| panic!("{}", render_text(&m, false)));
        let cache = &mut PipelineCache::default();
        let mut executor = Executor::new(&self.gpu, Arc::new(plan), &self.registry, cache, SceneBuffers::default())
            .unwrap_or_else(|error| panic!("{error}"));
        for (name, bytes) in &scene.encode(0.0, 1.0).items {
            executor.scene.set(&self.gpu, name, bytes).unwrap();
        }
        executor.frame(FrameOptions { everything: true, ..FrameOptions::default() }).unwrap();
        (0..self.lobes).map(|lobe| picture(&executor, &format!("out_{lobe}"))).collect()
    }
}

fn picture(executor: &Executor, name: &str) -> Vec<Vec<[f64; 3]>> {
    let data = executor.read(executor.plan().find(name).unwrap()).unwrap().floats();
    assert_eq!(data.len() % (LIGHTS * ANGLES), 0);
    let channels = data.len() / (LIGHTS * ANGLES);
    let texel = |light: usize, angle: usize| {
        let at = channels * (angle * LIGHTS + light);
        [0, 1, 2].map(|channel| f64::from(data[at + channel]))
    };
    (0..LIGHTS).map(|light| (0..ANGLES).map(|angle| texel(light, angle)).collect()).collect()
}
