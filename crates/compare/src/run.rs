//! Running a comparison.

use std::path::Path;
use std::sync::Arc;

use tyndall_gpu::{FrameOptions, Gpu, PipelineCache};
use tyndall_page::false_color::of_error;
use tyndall_plugin::Registry;
use tyndall_render::Running;
use tyndall_scene::Scene;
use tyndall_scene::model::Instance;

use crate::casters::Casters;
use crate::color;
use crate::errors::Errors;
use crate::figures::{Figures, Method, Row, SceneFigures};
use crate::file::{CompareFile, Entry};
use crate::measure::Measured;
use crate::page::{Names, Pixels};
use crate::prepare::PreparedScene;
use crate::report::Comparison;
use crate::truth::{Geometry, Seen, Truth};

/// Called with what is being done, and the number of steps done since the last call, of [`steps`] in all.
pub type Progress<'a> = &'a (dyn Fn(Option<&str>, u64) + Sync);

/// Why a comparison ended early.
#[derive(Debug, Clone, thiserror::Error)]
pub enum Error {
    /// The machine could not run one of the methods.
    #[error("method `{method}` cannot draw scene `{scene}`: {error}")]
    Method {
        /// Its name in the file.
        method: String,
        /// The scene's name in the file.
        scene: String,
        /// The reason.
        error: tyndall_render::Error,
    },
    /// The machine could not render the geometry of a scene.
    #[error("the geometry of scene `{scene}` cannot be rendered: {error}")]
    Geometry {
        /// The scene's name in the file.
        scene: String,
        /// The reason.
        error: tyndall_render::Error,
    },
}

impl Error {
    /// The underlying error.
    pub fn cause(&self) -> &tyndall_render::Error {
        match self {
            Self::Method { error, .. } | Self::Geometry { error, .. } => error,
        }
    }
}

/// Steps of a whole comparison, for [`Progress`].
pub fn steps(file: &CompareFile, rounds: u32) -> u64 {
    let turns = file.methods.len() as u64 * (1 + u64::from(rounds));
    file.scenes.len() as u64 * (u64::from(file.size.1) + turns)
}

/// Draws every scene by every method, compares each picture with double precision, and times the methods in `rounds`
/// rounds.
///
/// # Errors
/// If the machine cannot run a method; the error names it.
pub fn compare(
    gpu: &Arc<Gpu>,
    registry: &Registry,
    file: &CompareFile,
    scenes: &[PreparedScene<'_>],
    rounds: u32,
    progress: Progress<'_>,
) -> Result<Comparison, Error> {
    let mut work =
        Work { gpu, registry, file, rounds, cache: PipelineCache::default(), progress, pictures: Vec::new() };
    let scenes = scenes.iter().enumerate().map(|scene| work.scene(scene)).collect::<Result<Vec<_>, _>>()?;
    let figures = Figures {
        about: file.about.clone(),
        output: file.output.name(),
        shadows: file.shadows,
        adapter: gpu.info.name.clone(),
        size: file.size,
        rounds,
        methods: methods(file),
        scenes,
    };
    Ok(Comparison { figures, pictures: work.pictures })
}

/// The object of each triangle, in the order in which passes number them.
fn objects(scene: &Scene) -> Vec<usize> {
    let of = |instance: &Instance| std::iter::repeat_n(instance.object, instance.mesh.triangles.len());
    scene.instances.iter().flat_map(of).collect()
}

/// Methods of one graph are a family: they differ by their settings.
fn methods(file: &CompareFile) -> Vec<Method> {
    let mut graphs: Vec<&Path> = Vec::new();
    let mut methods = Vec::new();
    for Entry { name, about, path, .. } in &file.methods {
        let family = graphs.iter().position(|graph| graph == path).unwrap_or_else(|| {
            graphs.push(path);
            graphs.len() - 1
        });
        let graph = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
        methods.push(Method { name: name.clone(), about: about.clone(), family, graph });
    }
    methods
}

/// The state that all scenes share.
struct Work<'a> {
    gpu: &'a Arc<Gpu>,
    registry: &'a Registry,
    file: &'a CompareFile,
    rounds: u32,
    cache: PipelineCache,
    progress: Progress<'a>,
    pictures: Vec<Pixels>,
}

impl Work<'_> {
    /// One scene by every method.
    fn scene(&mut self, (index, scene): (usize, &PreparedScene<'_>)) -> Result<SceneFigures, Error> {
        let name = scene.entry.name.as_str();
        let named = |method: &str| {
            let (method, scene) = (method.to_owned(), name.to_owned());
            move |error| Error::Method { method, scene, error }
        };
        (self.progress)(Some(&format!("{name}: truth")), 0);
        let truth = self.truth(scene).map_err(|error| Error::Geometry { scene: name.to_owned(), error })?;
        let names = Names::new(index, name);
        self.pictures.push(Pixels { path: names.truth(), pixels: color::of_truth(&truth) });
        let mut ready = Vec::new();
        let mut errors = Vec::new();
        for (place, method) in scene.methods.iter().enumerate() {
            let of = method.entry.name.as_str();
            (self.progress)(Some(&format!("{name}: {of}")), 0);
            let measured = Measured::new(self.gpu, method, self.registry, &mut self.cache).map_err(named(of))?;
            let picture = measured.picture().map_err(named(of))?;
            let found = Errors::new(&picture, &truth);
            self.draw(&names, (place, of), &picture, &found, truth.mean());
            errors.extend(found.percentiles.map(|percentiles| (percentiles, found.sum)));
            ready.push((of, measured));
            (self.progress)(None, 1);
        }
        for round in 1..=self.rounds {
            for (of, measured) in &mut ready {
                (self.progress)(Some(&format!("{name}: round {round} of {}, {of}", self.rounds)), 0);
                measured.time().map_err(named(of))?;
                (self.progress)(None, 1);
            }
        }
        let rows = errors.into_iter().zip(&mut ready).map(|(errors, (_, measured))| Row::new(errors, measured.cost()));
        let rows = rows.collect();
        Ok(SceneFigures { name: name.to_owned(), about: scene.entry.about.clone(), mean: truth.mean(), rows })
    }

    /// The light of the scene in double precision, of the geometry that is rendered.
    fn truth(&mut self, scene: &PreparedScene<'_>) -> Result<Truth, tyndall_render::Error> {
        let plan = scene.geometry.clone();
        let mut running = Running::new(self.gpu, plan, Some(&scene.scene), self.registry, &mut self.cache)?;
        running.frame(FrameOptions::default())?;
        let outputs = running.executor.plan().outputs.clone();
        let read = |wanted: &str| {
            let port = outputs.iter().find(|(name, _)| name == wanted).map(|(_, port)| *port);
            running.executor.read(port.expect("our own graph of the geometry has this output"))
        };
        let geometry = Geometry {
            depth: read("depth")?,
            normal: read("normal")?,
            material: read("material")?,
            objects: objects(&scene.scene),
            triangle: read("triangle")?,
        };
        let (width, height) = self.file.size;
        let twin = scene.scene.twin(0.0, f64::from(width) / f64::from(height));
        let casters = self.file.shadows.then(|| Casters::new(&scene.scene));
        let seen = Seen { scene: &twin, geometry: &geometry, casters: casters.as_ref() };
        Ok(Truth::new(self.file.output, seen, self.file.size, &|| (self.progress)(None, 1)))
    }

    fn draw(&mut self, names: &Names<'_>, of: (usize, &str), found: &[[f32; 3]], errors: &Errors, mean: f64) {
        let light = found.iter().map(|pixel| color::of_light(pixel.map(f64::from), mean)).collect();
        let error = errors.of_pixels.iter().map(|error| of_error(*error)).collect();
        self.pictures.push(Pixels { path: names.found(of), pixels: light });
        self.pictures.push(Pixels { path: names.error(of), pixels: error });
    }
}
