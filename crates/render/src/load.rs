//! A graph and its scene, read and checked, and planned.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::Instant;

use tyndall_document::{Diagnostic, Diagnostics, Place, Source};
use tyndall_graph::descriptor::ParamValue;
use tyndall_graph::{Graph, Keep, Override, Overrides, ParamSetting, Plan, PlanOptions, Roots};
use tyndall_plugin::{Registry, RegistryPass};
use tyndall_scene::{Refusal, Scene};

use crate::codes::{INPUT_NEEDED, LIMIT, NO_SCENE, REFUSED};
use crate::error::Error;

/// What is to be rendered.
#[derive(Debug, Clone, Default)]
pub struct Request {
    /// The graph file.
    pub graph: PathBuf,
    /// Another scene than the graph names.
    pub scene: Option<PathBuf>,
    /// Another size than the graph names, in pixels.
    pub size: Option<(u32, u32)>,
    /// Values for parameters and the scene; of several for one name the last wins.
    pub set: Vec<Setting>,
}

/// A value for a parameter of the graph, for `pass.parameter`, or for `scene.<path>`.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Setting {
    /// `NAME=VALUE`, VALUE in RON.
    pub text: String,
    /// What messages name: how the user wrote it.
    pub argument: String,
}

/// A graph and its scene, checked.
pub struct Loaded {
    /// The graph.
    pub graph: Arc<Graph>,
    /// Its scene, where it has one.
    pub scene: Option<Scene>,
    /// Text to tree, µs.
    pub load_us: f64,
    /// Tree to typed graph, with the registry loaded, µs.
    pub validate_us: f64,
}

impl Loaded {
    /// Warns where a switch is on whose work needs an optional input that nothing feeds.
    pub fn warn_of_needs(&self, registry: &Registry, out: &mut Diagnostics) {
        for (index, pass) in self.graph.passes.entries().filter(|(_, pass)| pass.enabled) {
            let descriptor = pass.descriptor();
            let Some(registered) = registry.pass(&descriptor.name) else { continue };
            for (param, setting) in descriptor.params.iter().zip(&pass.params) {
                let need = registered.needs.iter().find(|need| need.param == param.name);
                if let (Some(need), ParamSetting::Value(ParamValue::Bool(true))) = (need, setting)
                    && !self.graph.is_fed(index, &need.port)
                {
                    let message = format!(
                        "`{}` of pass `{}` does nothing: nothing feeds its input `{}`",
                        param.name, pass.name, need.port
                    );
                    let suggestion = format!("connect `{}`, or set `{}: false`", need.port, param.name);
                    let warning = Diagnostic::warning(INPUT_NEEDED, self.graph.place(pass.span), message);
                    out.push(warning.suggest(suggestion));
                }
            }
        }
    }

    /// Warns where a pass says that it does not do justice to something that the scene has.
    pub fn warn_of_limits(&self, registry: &Registry, out: &mut Diagnostics) {
        let Some(scene) = &self.scene else { return };
        for pass in self.graph.passes.iter().filter(|pass| pass.enabled) {
            let Some(registered) = registry.pass(&pass.descriptor().name) else { continue };
            for limit in registered.limits.iter().filter(|limit| (limit.feature.is_in)(scene)) {
                let message = format!("pass `{}`: {}", pass.name, limit.text);
                out.push(Diagnostic::warning(LIMIT, self.graph.place(pass.span), message));
            }
        }
    }
}

/// Reads and checks a graph and its scene; every mistake and every warning goes to `out`.
pub fn load(request: &Request, registry: &Registry, out: &mut Diagnostics) -> Option<Loaded> {
    let (overrides, scene_overrides) = overrides(request, out);
    let start = Instant::now();
    let source = match Source::read(&request.graph) {
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
    let scene = load_scene(request, &graph, (&scene_overrides, registry), out)?;
    if let Some(scene) = &scene {
        refuse(&graph, scene, registry, out);
    }
    Some(Loaded { graph, scene, load_us, validate_us })
}

/// Splits the settings into those of the graph and those of the scene.
fn overrides(request: &Request, out: &mut Diagnostics) -> (Overrides, tyndall_scene::Overrides) {
    let scene_file = request.scene.as_ref().map(|path| path.display().to_string());
    let mut graph = Overrides { size: request.size, scene: scene_file, ..Overrides::default() };
    let mut scene = tyndall_scene::Overrides::new();
    for Setting { text, argument } in &request.set {
        match text.strip_prefix("scene.").and_then(|rest| rest.split_once('=')) {
            Some((path, value)) => scene.extend(tyndall_scene::Override::read(path.trim(), value, argument, out)),
            None => match Override::parse(text, argument) {
                Ok(found) => graph.params.push(found),
                Err(mistakes) => out.extend(mistakes),
            },
        }
    }
    (graph, scene)
}

/// Refuses passes that would be silently wrong in this scene: those whose manifest says so, and those that read scene
/// data without others that would tell them.
fn refuse(graph: &Graph, scene: &Scene, registry: &Registry, out: &mut Diagnostics) {
    for pass in graph.passes.iter().filter(|pass| pass.enabled) {
        let descriptor = pass.descriptor();
        let refused = |because: &str| {
            let message = format!("pass `{}` ({}) {because}", pass.name, descriptor.name);
            Diagnostic::error(REFUSED, graph.place(pass.span), message)
        };
        let reads = |name: &str| descriptor.scene.iter().any(|read| read == name);
        let registered = registry.pass(&descriptor.name);
        let declared = registered.iter().flat_map(|pass| &pass.refuses);
        out.extend(declared.filter(|limit| (limit.feature.is_in)(scene)).map(|limit| refused(&limit.text)));
        for refusal in registry.extensions().refusals().filter(|refusal| (refusal.feature.is_in)(scene)) {
            if reads(refusal.reads) && !reads(refusal.without) {
                out.push(refused(refusal.because).suggest(way_out(refusal, registry)));
            }
        }
    }
}

/// The passes that would be right, and how else to go on.
fn way_out(refusal: &Refusal, registry: &Registry) -> String {
    let reads = |pass: &RegistryPass, name: &str| pass.descriptor.scene.iter().any(|read| read == name);
    let right = registry.passes().filter(|pass| reads(pass, refusal.reads) && reads(pass, refusal.without));
    let right: Vec<String> = right.map(|pass| format!("`{}`", pass.descriptor.name)).collect();
    match right.as_slice() {
        [] => refusal.remedy.to_owned(),
        names => {
            format!("use passes that read `{}` as well ({}), or {}", refusal.without, names.join(", "), refusal.remedy)
        }
    }
}

/// `None` where the scene has mistakes; `Some(None)` where the graph needs no scene and none is given.
fn load_scene(
    request: &Request,
    graph: &Graph,
    (overrides, registry): (&tyndall_scene::Overrides, &Registry),
    out: &mut Diagnostics,
) -> Option<Option<Scene>> {
    let Some(path) = &graph.scene else {
        let reader = graph.passes.iter().find(|pass| pass.enabled && !pass.descriptor().scene.is_empty());
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
    let path = request.scene.as_deref().unwrap_or(Path::new(path));
    match Scene::load(path, overrides, registry.extensions()) {
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

/// What a plan is made for.
pub struct Wanted<'a> {
    /// Ports that must exist at the end of a frame.
    pub roots: Roots,
    /// Several frames will be rendered, so what does not change is kept.
    pub keep: bool,
    /// Parameters that will change while the plan runs.
    pub live: &'a [String],
}

/// Plans a loaded graph.
///
/// # Errors
/// Mistakes that show only at the frame's size.
pub fn plan(loaded: &Loaded, wanted: Wanted<'_>) -> Result<Plan, Error> {
    let mut options = PlanOptions::new(loaded.graph.size);
    options.roots = wanted.roots;
    if wanted.keep {
        let animated = loaded.scene.iter().flat_map(Scene::animated).map(str::to_owned).collect::<BTreeSet<_>>();
        options.keep = Keep::Edges { live: wanted.live.iter().cloned().collect(), animated };
    }
    Ok(tyndall_graph::plan(&loaded.graph, &options)?)
}
