//! `compare`: the same scenes by every method, against light in double precision.

mod codes;
mod color;
mod errors;
mod figures;
mod file;
mod measure;
mod page;
mod plot;
mod prepare;
mod table;
#[cfg(test)]
mod tests;
mod truth;
mod twin;

use std::path::Path;
use std::sync::Arc;

use indicatif::{ProgressBar, ProgressStyle};
use tyndall_document::{Diagnostics, Source, render_text};
use tyndall_gpu::{FrameOptions, Gpu, PipelineCache};
use tyndall_image::{Image, Meaning};
use tyndall_plugin::Registry;

use self::errors::Errors;
use self::figures::{Figures, Method, Row, SceneFigures};
use self::file::{CompareFile, Entry};
use self::measure::Measured;
use self::page::{Names, Picture};
use self::prepare::{PreparedScene, prepare};
use self::truth::Truth;
use self::twin::Twin;
use crate::App;
use crate::cli::{Arguments, Compare};
use crate::failure::Failure;
use crate::running::Running;
use crate::{plugins, terminal};

pub(crate) fn run(app: &App, arguments: &Arguments, verb: &Compare) -> Result<(), Failure> {
    let mut out = Diagnostics::default();
    let source = Source::read(&verb.file)?;
    let file = file::read(&source, &mut out).ok_or_else(|| out.clone())?;
    let file = chosen(file, verb)?;
    let folders: Vec<&Path> = file.methods.iter().map(|method| method.path.as_path()).chain([&*verb.file]).collect();
    let registry = plugins::registry(app, arguments, &folders)?;
    let scenes = prepare(&file, &registry, &mut out);
    if out.has_errors() {
        return Err(out.into());
    }
    if !out.is_empty() {
        terminal::error(&render_text(&out, terminal::color()));
    }
    if verb.out.exists() && !verb.out.is_dir() {
        return Err(Failure::Usage(format!("--out {} is no folder", verb.out.display())));
    }
    let gpu = Gpu::open(verb.adapter.as_deref())?;
    let mut work = Work::new(&gpu, &registry, &file, verb.rounds);
    let scenes = scenes.iter().enumerate().map(|scene| work.scene(scene)).collect::<Result<Vec<_>, _>>()?;
    work.progress.finish_and_clear();
    let figures = Figures {
        about: file.about.clone(),
        output: file.light.output(),
        adapter: gpu.info.name.clone(),
        size: file.size,
        rounds: verb.rounds,
        methods: methods(&file),
        scenes,
    };
    write(&figures, &work.pictures, verb)
}

/// The file with only what the command line asks for.
fn chosen(mut file: CompareFile, verb: &Compare) -> Result<CompareFile, Failure> {
    file.scenes = filtered(file.scenes, "--scene", &verb.scene)?;
    file.methods = filtered(file.methods, "--method", &verb.method)?;
    file.size = verb.size.unwrap_or(file.size);
    Ok(file)
}

/// The entries whose names hold one of `wanted` in any case; all where nothing is wanted.
fn filtered(entries: Vec<Entry>, argument: &str, wanted: &[String]) -> Result<Vec<Entry>, Failure> {
    let holds = |entry: &Entry, part: &String| entry.name.to_lowercase().contains(&part.to_lowercase());
    if let Some(part) = wanted.iter().find(|part| !entries.iter().any(|entry| holds(entry, part))) {
        let names: Vec<String> = entries.iter().map(|entry| format!("`{}`", entry.name)).collect();
        let message = format!("{argument} {part}: no name in the file holds this; there are {}", names.join(", "));
        return Err(Failure::Usage(message));
    }
    Ok(entries.into_iter().filter(|entry| wanted.is_empty() || wanted.iter().any(|part| holds(entry, part))).collect())
}

/// Methods of one graph are a family: they differ by their settings.
fn methods(file: &CompareFile) -> Vec<Method> {
    let mut graphs: Vec<&Path> = Vec::new();
    let mut method = |entry: &'_ Entry, path| {
        let family = graphs.iter().position(|graph| *graph == path).unwrap_or_else(|| {
            graphs.push(path);
            graphs.len() - 1
        });
        let graph = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
        Method { name: entry.name.clone(), about: entry.about.clone(), family, graph }
    };
    file.methods.iter().map(|entry| method(entry, entry.path.as_path())).collect()
}

/// A comparison under way.
struct Work<'a> {
    gpu: &'a Arc<Gpu>,
    registry: &'a Registry,
    file: &'a CompareFile,
    rounds: u32,
    cache: PipelineCache,
    progress: ProgressBar,
    pictures: Vec<Picture>,
}

impl<'a> Work<'a> {
    fn new(gpu: &'a Arc<Gpu>, registry: &'a Registry, file: &'a CompareFile, rounds: u32) -> Self {
        let rows = u64::from(file.size.1);
        let turns = file.methods.len() as u64 * (1 + u64::from(rounds));
        let progress = ProgressBar::new(file.scenes.len() as u64 * (rows + turns));
        let style = ProgressStyle::with_template("{bar:30} {percent} % {msg}");
        progress.set_style(style.unwrap_or_else(|_| ProgressStyle::default_bar()));
        Self { gpu, registry, file, rounds, cache: PipelineCache::default(), progress, pictures: Vec::new() }
    }

    /// One scene by every method.
    fn scene(&mut self, (index, scene): (usize, &PreparedScene<'_>)) -> Result<SceneFigures, Failure> {
        let name = scene.entry.name.as_str();
        self.progress.set_message(format!("{name}: truth"));
        let truth = self.truth(scene)?;
        let names = Names::new(index, name);
        self.pictures.push(Picture { path: names.truth(), pixels: color::of_truth(&truth) });
        let mut ready = Vec::new();
        let mut errors = Vec::new();
        for (place, method) in scene.methods.iter().enumerate() {
            let of = method.entry.name.as_str();
            self.progress.set_message(format!("{name}: {of}"));
            let measured = Measured::new(self.gpu, method, self.registry, &mut self.cache);
            let measured = measured.and_then(|measured| measured.picture().map(|picture| (measured, picture)));
            let (measured, picture) = measured.map_err(|failure| in_method(failure, of, name))?;
            let found = Errors::new(&picture, &truth);
            self.draw(&names, (place, of), &picture, &found, truth.mean());
            errors.extend(found.percentiles);
            ready.push((of, measured));
            self.progress.inc(1);
        }
        for round in 1..=self.rounds {
            for (of, measured) in &mut ready {
                self.progress.set_message(format!("{name}: round {round} of {}, {of}", self.rounds));
                measured.time().map_err(|failure| in_method(failure, of, name))?;
                self.progress.inc(1);
            }
        }
        let rows = errors.into_iter().zip(&mut ready).map(|(errors, (_, measured))| Row::new(errors, measured.cost()));
        let rows = rows.collect();
        Ok(SceneFigures { name: name.to_owned(), about: scene.entry.about.clone(), mean: truth.mean(), rows })
    }

    /// The light of the scene in double precision, up to the depth that is rendered.
    fn truth(&mut self, scene: &PreparedScene<'_>) -> Result<Truth, Failure> {
        let plan = scene.geometry.clone();
        let mut running = Running::new(self.gpu, plan, Some(&scene.scene), self.registry, &mut self.cache)?;
        running.frame(FrameOptions::default())?;
        let depth = running.executor.read(running.executor.plan().roots[0])?;
        let (width, height) = self.file.size;
        let twin = Twin::new(&scene.scene, f64::from(width) / f64::from(height));
        Ok(Truth::new(self.file.light, &twin, self.file.size, &depth.data, &|| self.progress.inc(1)))
    }

    fn draw(&mut self, names: &Names<'_>, of: (usize, &str), found: &[[f32; 3]], errors: &Errors, mean: f64) {
        let light = found.iter().map(|pixel| color::of_light(pixel.map(f64::from), mean)).collect();
        let error = errors.of_pixels.iter().map(|error| color::of_error(*error)).collect();
        self.pictures.push(Picture { path: names.found(of), pixels: light });
        self.pictures.push(Picture { path: names.error(of), pixels: error });
    }
}

/// Says in which method of which scene the machine failed.
fn in_method(failure: Failure, method: &str, scene: &str) -> Failure {
    terminal::error(&format!("error: method `{method}` cannot draw scene `{scene}`:"));
    failure
}

/// Pictures first, the page last: what it shows is there when it is.
fn write(figures: &Figures, pictures: &[Picture], verb: &Compare) -> Result<(), Failure> {
    let (width, height) = figures.size;
    for picture in pictures {
        let data = picture.pixels.iter().flatten().map(|byte| f32::from(*byte) / 255.0).collect();
        tyndall_image::write(&verb.out.join(&picture.path), &Image::new(width, height, 3, data), Meaning::Display)?;
    }
    let mut written = vec![verb.out.join("table.md")];
    tyndall_image::write_bytes(&written[0], table::markdown(figures).as_bytes())?;
    if let Some(plot) = page::plot_of(figures, &figures.about, &figures.over_all(), page::P99) {
        written.push(verb.out.join("plot.svg"));
        tyndall_image::write_bytes(&verb.out.join("plot.svg"), plot.as_bytes())?;
    }
    if let Some(path) = &verb.json {
        tyndall_image::write_bytes(path, format!("{:#}\n", figures.json()).as_bytes())?;
        written.push(path.clone());
    }
    written.push(verb.out.join("index.html"));
    tyndall_image::write_bytes(&verb.out.join("index.html"), page::html(figures).as_bytes())?;
    terminal::text(&table::text(figures));
    terminal::line("");
    written.iter().for_each(|path| terminal::line(&format!("wrote {}", path.display())));
    Ok(())
}
