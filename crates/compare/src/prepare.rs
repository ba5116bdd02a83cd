//! From a comparison file to checked scenes and planned graphs, without a GPU.

use std::collections::BTreeSet;
use std::sync::Arc;

use tyndall_document::{Diagnostic, Diagnostics, Place, Source};
use tyndall_graph::descriptor::Dimension;
use tyndall_graph::{Keep, Plan, PlanOptions, Resource, Roots};
use tyndall_plugin::Registry;
use tyndall_render::{Loaded, Request};
use tyndall_scene::{Extensions, Override, Part, Scene, SceneData};

use crate::codes::{NO_TRUTH, SCENE_OF_METHOD, WRONG_PICTURE};
use crate::file::{CompareFile, Entry, Setting};

/// A graph that renders the geometry for the truth: the outputs are what `Geometry` takes.
const GEOMETRY: &str = r#"(
    version: 1,
    passes: { "surfaces": (use: "core.gbuffer") },
    outputs: { "depth": "surfaces.depth", "normal": "surfaces.normal", "material": "surfaces.material", "triangle": "surfaces.triangle" },
)"#;

/// A scene, and every method ready to draw it.
pub struct PreparedScene<'f> {
    pub(crate) entry: &'f Entry,
    pub(crate) scene: Scene,
    /// The graph of what each pixel's ray meets.
    pub(crate) geometry: Plan,
    pub(crate) methods: Vec<PreparedMethod<'f>>,
}

/// A method, ready to draw one scene.
pub(crate) struct PreparedMethod<'f> {
    pub(crate) entry: &'f Entry,
    /// With the scene as this method's settings change it.
    pub(crate) scene: Option<Scene>,
    pub(crate) plan: Plan,
}

/// Reads, checks and plans everything that a file names; all mistakes go to `out`.
pub fn prepare<'f>(file: &'f CompareFile, registry: &Registry, out: &mut Diagnostics) -> Vec<PreparedScene<'f>> {
    let mut scenes = Vec::new();
    for entry in &file.scenes {
        let mut found = Diagnostics::default();
        let own = own_scene(entry, registry.extensions(), &mut found);
        if own.as_ref().is_some_and(Scene::has_height_fog) {
            let place = file.source.place(entry.name_span);
            let mistake = Diagnostic::error(NO_TRUTH, place, "no truth can be computed for height fog");
            found.push(mistake.suggest("leave `scale_height` out of the scene's medium"));
        }
        let geometry = own.as_ref().and_then(|scene| geometry(file, scene, registry, &mut found));
        out.extend(placed(file, &[entry], found));
        let methods = file.methods.iter().filter_map(|of| method(file, entry, of, registry, out)).collect();
        if let (Some(scene), Some(geometry)) = (own, geometry) {
            scenes.push(PreparedScene { entry, scene, geometry, methods });
        }
    }
    out.dedup();
    scenes
}

/// The scene as its entry changes it, for the truth.
fn own_scene(entry: &Entry, extensions: &Arc<Extensions>, out: &mut Diagnostics) -> Option<Scene> {
    let mut overrides = tyndall_scene::Overrides::new();
    for Setting { text, .. } in &entry.settings {
        if let Some((path, value)) = text.strip_prefix("scene.").and_then(|rest| rest.split_once('=')) {
            overrides.extend(Override::read(path.trim(), value, &argument(text), out));
        }
    }
    match Scene::load(&entry.path, &overrides, extensions) {
        Ok((scene, warnings)) => {
            out.extend(warnings);
            Some(scene)
        }
        Err(mistakes) => {
            out.extend(mistakes);
            None
        }
    }
}

fn geometry(file: &CompareFile, scene: &Scene, registry: &Registry, out: &mut Diagnostics) -> Option<Plan> {
    let source = Source::new("the graph of the geometry", GEOMETRY);
    let overrides = tyndall_graph::Overrides { size: Some(file.size), ..Default::default() };
    let graph = tyndall_graph::read(&source, out)?;
    let graph = tyndall_graph::validate(&graph, registry.catalogue(), &overrides, out)?;
    let loaded = Loaded { graph, scene: Some(scene.clone()), load_us: 0.0, validate_us: 0.0 };
    plan(file, &loaded, Roots::Outputs, out)
}

/// The method's graph with the scene, planned for the port that is compared.
fn method<'f>(
    file: &'f CompareFile,
    scene: &Entry,
    entry: &'f Entry,
    registry: &Registry,
    out: &mut Diagnostics,
) -> Option<PreparedMethod<'f>> {
    let mut found = Diagnostics::default();
    let settings = scene.settings.iter().chain(&entry.settings);
    let set =
        settings.map(|Setting { text, .. }| tyndall_render::Setting { text: text.clone(), argument: argument(text) });
    let request = Request {
        graph: entry.path.clone(),
        scene: Some(scene.path.clone()),
        size: Some(file.size),
        set: set.collect(),
    };
    for setting in entry.settings.iter().filter(|setting| setting.text.starts_with("scene.")) {
        let message =
            format!("`{}` changes the scene for one method, but all methods are compared with one truth", setting.text);
        let mistake = Diagnostic::error(SCENE_OF_METHOD, file.source.place(setting.span), message);
        out.push(mistake.suggest("change it in a scene's `set`; several scenes may use one scene file"));
    }
    let plan = tyndall_render::load(&request, registry, &mut found).and_then(|loaded| {
        let place = file.source.place(file.output_span);
        let port = loaded.graph.find(file.output.name(), place).map_err(|mistake| found.push(mistake)).ok()?;
        let plan = plan(file, &loaded, Roots::Ports(vec![port]), &mut found)?;
        is_picture(file, entry, &plan, &mut found).then_some((plan, loaded.scene))
    });
    out.extend(placed(file, &[entry, scene], found));
    plan.map(|(plan, scene)| PreparedMethod { entry, scene, plan })
}

/// Camera and lights change from frame to frame, so what depends on neither is kept. If shadows are compared, lights and
/// casters do not move: what is made once for a light, such as its shadow map, is kept by all methods.
fn plan(file: &CompareFile, loaded: &Loaded, roots: Roots, out: &mut Diagnostics) -> Option<Plan> {
    let mut options = PlanOptions::new(loaded.graph.size);
    options.roots = roots;
    let moves =
        |data: &&SceneData| data.is_made_from(Part::Camera) || (!file.shadows && data.is_made_from(Part::Lights));
    let moving = loaded.scene.iter().flat_map(|scene| scene.extensions().data()).filter(moves);
    let animated = moving.flat_map(SceneData::names).map(str::to_owned).collect();
    options.keep = Keep::Edges { live: BTreeSet::new(), animated };
    tyndall_graph::plan(&loaded.graph, &options).map_err(|mistakes| out.extend(mistakes)).ok()
}

/// Whether the compared port is a picture of the compared size.
fn is_picture(file: &CompareFile, entry: &Entry, plan: &Plan, out: &mut Diagnostics) -> bool {
    let [root] = plan.roots[..] else { return false };
    let resource = *plan.resource(root);
    let (width, height) = file.size;
    let fits = matches!(resource, Resource::Texture { dimension: Dimension::D2, width: w, height: h, .. } if (w, h) == file.size);
    if !fits {
        let message =
            format!("`{}` of this graph is {resource}, not a picture of {width}×{height}", file.output.name());
        let place = file.source.place(entry.name_span);
        let mistake = Diagnostic::error(WRONG_PICTURE, place, message);
        out.push(mistake.suggest("the compared port must have the frame's size"));
    }
    fits
}

/// The name of a setting in messages.
fn argument(text: &str) -> String {
    format!("--set {text}")
}

/// Moves the places of settings from the command line to the comparison file; a mistake elsewhere gets the entry that led
/// there, the first of `entries`, as a related place.
fn placed(file: &CompareFile, entries: &[&Entry], found: Diagnostics) -> Diagnostics {
    let settings: Vec<&Setting> = entries.iter().flat_map(|entry| &entry.settings).collect();
    let in_file = |mut mistake: Diagnostic| {
        let named = match &mistake.place {
            Place::Argument(name) => Some(name.clone()),
            Place::Text { source, .. } if source.is_argument() => Some(source.name().to_owned()),
            _ => None,
        };
        let setting = named.and_then(|named| settings.iter().find(|setting| argument(&setting.text) == named));
        match setting {
            Some(setting) => mistake.place = file.source.place(setting.span),
            None => {
                let entry = file.source.place(entries[0].name_span);
                if mistake.place != entry {
                    mistake = mistake.relate(entry, format!("`{}` uses it", entries[0].name));
                }
            }
        }
        mistake
    };
    found.into_iter().map(in_file).collect()
}
