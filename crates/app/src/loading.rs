//! From the command line to a checked graph and scene, and to a plan.

use std::collections::BTreeSet;
use std::path::Path;
use std::sync::Arc;
use std::time::Instant;

use tyndall_document::{Code, Diagnostic, Diagnostics, Place, Source, render_text};
use tyndall_graph::descriptor::ParamValue;
use tyndall_graph::{Graph, Keep, Override, Overrides, ParamSetting, Plan, PlanOptions, Roots};
use tyndall_plugin::Registry;
use tyndall_scene::Scene;

use crate::cli::GraphArguments;
use crate::failure::Failure;
use crate::terminal;

/// The graph reads a scene, and none is given.
pub(crate) const NO_SCENE: Code = Code("no-scene");
/// A parameter asks for something that is not built.
pub(crate) const NOT_BUILT: Code = Code("not-built");

/// A pass is right in a homogeneous medium only, and the scene has height fog.
pub(crate) const NOT_HOMOGENEOUS: Code = Code("not-homogeneous");

/// A graph and its scene, checked.
pub(crate) struct Loaded {
    pub graph: Arc<Graph>,
    pub scene: Option<Scene>,
    /// Text to tree, µs.
    pub load_us: f64,
    /// Tree to typed graph, with the registry loaded, µs.
    pub validate_us: f64,
}

/// Reads and checks a graph and its scene; warnings go to standard error.
pub(crate) fn load(arguments: &GraphArguments, registry: &Registry) -> Result<Loaded, Failure> {
    let mut out = Diagnostics::default();
    let loaded = try_load(arguments, registry, &mut out);
    if let Some(loaded) = &loaded {
        warn_of_unbuilt(&loaded.graph, registry, &mut out);
    }
    out.sort();
    out.dedup();
    if out.has_errors() {
        return Err(Failure::Mistakes(out));
    }
    if !out.is_empty() {
        terminal::error(&render_text(&out, terminal::color()));
    }
    loaded.ok_or(Failure::Mistakes(out))
}

/// The same; every mistake and every warning goes to `out`.
pub(crate) fn try_load(arguments: &GraphArguments, registry: &Registry, out: &mut Diagnostics) -> Option<Loaded> {
    let (overrides, scene_overrides) = overrides(arguments, out);
    let start = Instant::now();
    let source = match Source::read(&arguments.graph) {
        Ok(source) => source,
        Err(mistake) => {
            out.push(mistake);
            return None;
        }
    };
    let file = tyndall_graph::read(&source, out);
    let load_us = start.elapsed().as_secs_f64() * 1e6;
    let start = Instant::now();
    let graph = file.and_then(|file| tyndall_graph::validate(&file, registry.catalogue(), &overrides, out));
    let validate_us = start.elapsed().as_secs_f64() * 1e6;
    let graph = graph?;
    let scene = load_scene(arguments, &graph, &scene_overrides, out)?;
    if scene.as_ref().is_some_and(Scene::has_height_fog) {
        refuse_homogeneous(&graph, out);
    }
    Some(Loaded { graph, scene, load_us, validate_us })
}

/// Splits `--set` into those of the graph and those of the scene.
fn overrides(arguments: &GraphArguments, out: &mut Diagnostics) -> (Overrides, tyndall_scene::Overrides) {
    let scene_file = arguments.scene.as_ref().map(|path| path.display().to_string());
    let mut graph = Overrides { size: arguments.size, scene: scene_file, ..Overrides::default() };
    let mut scene = tyndall_scene::Overrides::new();
    for text in &arguments.set {
        let argument = format!("--set {text}");
        match text.strip_prefix("scene.").and_then(|rest| rest.split_once('=')) {
            Some((path, value)) => scene.extend(tyndall_scene::Override::read(path.trim(), value, &argument, out)),
            None => match Override::parse(text, &argument) {
                Ok(found) => graph.params.push(found),
                Err(mistakes) => out.extend(mistakes),
            },
        }
    }
    (graph, scene)
}

/// `None` where the scene has mistakes; `Some(None)` where the graph needs no scene and none is given.
fn load_scene(
    arguments: &GraphArguments,
    graph: &Graph,
    overrides: &tyndall_scene::Overrides,
    out: &mut Diagnostics,
) -> Option<Option<Scene>> {
    let Some(path) = &graph.scene else {
        let reader = graph.passes.node_weights().find(|pass| pass.enabled && !pass.descriptor().scene.is_empty());
        if let Some(pass) = reader {
            let message = format!("pass `{}` reads a scene, and neither the graph nor --scene names one", pass.name);
            let mistake = Diagnostic::error(NO_SCENE, graph.place(pass.span), message);
            out.push(mistake.suggest("add `scene: \"NAME.scene.ron\"` to the graph, or give --scene FILE"));
            return None;
        }
        if let Some(first) = overrides.first() {
            let place = Place::Argument(first.source.name().to_owned());
            out.push(Diagnostic::error(NO_SCENE, place, "there is no scene that this could change"));
            return None;
        }
        return Some(None);
    };
    let path = arguments.scene.as_deref().unwrap_or(Path::new(path));
    match Scene::load(path, overrides) {
        Ok((scene, warnings)) => {
            out.extend(warnings);
            Some(Some(scene))
        }
        Err(mistakes) => {
            out.extend(mistakes);
            None
        }
    }
}

/// A pass that reads the medium and not how its density falls with the height would be silently wrong.
fn refuse_homogeneous(graph: &Graph, out: &mut Diagnostics) {
    for pass in graph.passes.node_weights().filter(|pass| pass.enabled) {
        let descriptor = pass.descriptor();
        let reads = |name: &str| descriptor.scene.iter().any(|read| read == name);
        if reads("medium") && !reads("height_fog") {
            let message = format!(
                "pass `{}` ({}) is right in a homogeneous medium only, and the scene's medium has a `scale_height`",
                pass.name, descriptor.name
            );
            let hint = "use passes for height fog (`airlight.height_fog`, as in height-fog.graph.ron), or leave \
                        `scale_height` out of the scene";
            out.push(Diagnostic::error(NOT_HOMOGENEOUS, graph.place(pass.span), message).suggest(hint));
        }
    }
}

/// Warns where a parameter that is on asks for something that its pass does not do yet.
fn warn_of_unbuilt(graph: &Graph, registry: &Registry, out: &mut Diagnostics) {
    for pass in graph.passes.node_weights().filter(|pass| pass.enabled) {
        let descriptor = pass.descriptor();
        let Some(registered) = registry.pass(&descriptor.name) else { continue };
        for (param, setting) in descriptor.params.iter().zip(&pass.params) {
            let notice = registered.notices.iter().find(|notice| notice.param == param.name);
            if let (Some(notice), ParamSetting::Value(ParamValue::Bool(true))) = (notice, setting) {
                let message = format!("`{}` of pass `{}`: {}", param.name, pass.name, notice.text);
                out.push(Diagnostic::warning(NOT_BUILT, graph.place(pass.span), message));
            }
        }
    }
}

/// What a plan is made for.
pub(crate) struct Wanted<'a> {
    pub roots: Roots,
    /// Several frames will be rendered, so what does not change is kept.
    pub keep: bool,
    /// Parameters that will change while the plan runs.
    pub live: &'a [String],
}

/// Plans a loaded graph.
pub(crate) fn plan(loaded: &Loaded, wanted: Wanted<'_>) -> Result<Plan, Failure> {
    let mut options = PlanOptions::new(loaded.graph.size);
    options.roots = wanted.roots;
    if wanted.keep {
        let animated = loaded.scene.iter().flat_map(Scene::animated).map(str::to_owned).collect::<BTreeSet<_>>();
        options.keep = Keep::Edges { live: wanted.live.iter().cloned().collect(), animated };
    }
    Ok(tyndall_graph::plan(&loaded.graph, &options)?)
}
