//! `render`: a graph's outputs as files.

use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use tyndall_document::Place;
use tyndall_gpu::{Executor, FrameOptions, Gpu, PipelineCache};
use tyndall_graph::descriptor::{Dimension, PortKind};
use tyndall_graph::{Graph, Handle, PlannedPort, PortRef, Resource, Roots};
use tyndall_image::{FileKind, frame_path, has_frame_number, supported};
use tyndall_render::Running;

use crate::App;
use crate::cli::{Arguments, Render};
use crate::failure::Failure;
use crate::loading::{self, Loaded, Wanted};
use crate::pictures::{distinct, no_picture, write_port};
use crate::warnings::Untold;
use crate::{plugins, terminal};

/// A port, and the file that it goes to (with `####` for the number of a frame).
struct Output {
    port: PortRef,
    pattern: PathBuf,
}

/// Renders, and returns the files that the pictures depend on.
pub(crate) fn run(app: &App, arguments: &Arguments, verb: &Render) -> Result<Vec<PathBuf>, Failure> {
    let mut clock = Clock::start(app);
    let untold = Untold::of(&verb.warnings)?;
    let registry = plugins::registry(app, arguments, &[&verb.graph.graph])?;
    clock.lap("plugins");
    let loaded = loading::load(&verb.graph, &registry, &untold)?;
    let depends_on = depends_on(verb, &loaded);
    let outputs = outputs(verb, &loaded.graph)?;
    clock.lap("graph and scene");
    let (first, end) = verb.frames.unwrap_or((0, 1));
    let roots = match (&verb.dump, verb.output.is_empty()) {
        (Some(_), _) => Roots::Ports(loaded.graph.written_ports().collect()),
        (None, true) => Roots::Outputs,
        (None, false) => Roots::Ports(outputs.iter().map(|output| output.port).collect()),
    };
    let plan = loading::plan(&loaded, Wanted { roots, keep: end - first > 1, live: &[] })?;
    clock.lap("plan");
    let gpu = Gpu::open(verb.adapter.as_deref())?;
    clock.lap("device");
    let mut cache = PipelineCache::default();
    let mut running = Running::new(&gpu, plan, loaded.scene.as_ref(), &registry, &mut cache)?;
    clock.lap("pipelines");
    let progress = progress(u64::from(end - first));
    for frame in first..end {
        running.frame(FrameOptions { frame, ..FrameOptions::default() })?;
        gpu.wait()?;
        clock.lap("frames");
        let written = progress.suspend(|| write_frame(&running, verb, &outputs, frame));
        written?;
        clock.lap("files");
        progress.inc(1);
    }
    progress.finish_and_clear();
    loading::warn_of_unfinished(&running, &untold)?;
    terminal::line(&clock.summary());
    Ok(depends_on)
}

/// The files that the pictures depend on.
fn depends_on(verb: &Render, loaded: &Loaded) -> Vec<PathBuf> {
    let scene = loaded.scene.iter().flat_map(|scene| scene.files().to_vec());
    std::iter::once(verb.graph.graph.clone()).chain(scene).collect()
}

/// What is to be written, checked before anything is drawn.
fn outputs(verb: &Render, graph: &Graph) -> Result<Vec<Output>, Failure> {
    let mut outputs = Vec::new();
    for argument in &verb.output {
        let place = Place::Argument(format!("--output {argument}"));
        let Some((name, file)) = argument.split_once('=').filter(|(_, file)| !file.is_empty()) else {
            return Err(Failure::Usage(format!("--output {argument}: write NAME=FILE")));
        };
        let port = graph.find(name.trim(), place)?;
        outputs.push(Output { port, pattern: PathBuf::from(file) });
    }
    if verb.output.is_empty() {
        outputs = default_outputs(verb, graph);
    }
    if let Some(folder) = verb.dump.as_ref().filter(|folder| folder.exists() && !folder.is_dir()) {
        return Err(Failure::Usage(format!("--dump {} is not a folder", folder.display())));
    }
    for output in &outputs {
        if supported(&output.pattern)? != FileKind::Npy && !is_picture(graph, output.port) {
            return Err(no_picture(graph.port_name(output.port), &output.pattern));
        }
        let many = verb.frames.is_some_and(|(first, end)| end - first > 1);
        if many && !has_frame_number(&output.pattern) {
            let path = output.pattern.display();
            return Err(Failure::Usage(format!("every frame would overwrite {path}: put #### in its name")));
        }
    }
    refuse_shared_files(verb, graph, &outputs)?;
    Ok(outputs)
}

/// Two outputs must not go to one file, however the paths are spelt.
fn refuse_shared_files(verb: &Render, graph: &Graph, outputs: &[Output]) -> Result<(), Failure> {
    let (first, end) = verb.frames.unwrap_or((0, 1));
    // Two patterns that differ give one path only where a number has as many digits as one of them asks for at least.
    let longer = (1..=9).map(|digits| 10_u32.pow(digits)).filter(|frame| (first..end).contains(frame));
    for frame in [first].into_iter().chain(longer) {
        let named = outputs.iter().map(|output| frame_path(&output.pattern, frame));
        let files: Vec<PathBuf> = named.chain(dumped(verb, graph, frame).map(|(_, path)| path)).collect();
        distinct(&files)?;
    }
    Ok(())
}

/// `out/<graph>.<output>.exr`, `image` as `.png`; with the number of the frame where there are several.
fn default_outputs(verb: &Render, graph: &Graph) -> Vec<Output> {
    let file = verb.graph.graph.file_name().unwrap_or_default().to_string_lossy();
    let stem = file.strip_suffix(".graph.ron").or_else(|| file.strip_suffix(".ron")).unwrap_or(&file);
    let many = verb.frames.is_some_and(|(first, end)| end - first > 1);
    let number = if many { ".####" } else { "" };
    let path = |name: &str, port: PortRef| {
        let suffix = match name {
            _ if !is_picture(graph, port) => "npy",
            "image" => "png",
            _ => "exr",
        };
        Path::new("out").join(format!("{stem}.{name}{number}.{suffix}"))
    };
    graph.outputs.iter().map(|(name, port)| Output { port: *port, pattern: path(name, *port) }).collect()
}

fn is_picture(graph: &Graph, port: PortRef) -> bool {
    matches!(graph.port(port).kind, PortKind::Texture { dimension: Dimension::D2, .. })
}

fn write_frame(running: &Running<'_>, verb: &Render, outputs: &[Output], frame: u32) -> Result<(), Failure> {
    let executor = &running.executor;
    for output in outputs {
        let path = frame_path(&output.pattern, frame);
        let name = || executor.plan().graph.port_name(output.port);
        let port = executor.plan().planned(output.port);
        let port = port.ok_or_else(|| Failure::Usage(format!("`{}` belongs to a pass that does not run", name())))?;
        write_port(executor, port, &path)?;
        print_written(&path, executor, port);
    }
    for (port, path) in dumped(verb, &executor.plan().graph, frame) {
        let Some(planned) = executor.plan().planned(port) else { continue };
        write_port(executor, planned, &path)?;
        print_written(&path, executor, planned);
    }
    Ok(())
}

/// What `--dump` writes of a frame.
fn dumped<'a>(verb: &'a Render, graph: &'a Graph, frame: u32) -> impl Iterator<Item = (PortRef, PathBuf)> + 'a {
    let many = verb.frames.is_some_and(|(first, end)| end - first > 1);
    let folder =
        verb.dump.as_ref().map(|folder| if many { folder.join(format!("{frame:04}")) } else { folder.clone() });
    folder.into_iter().flat_map(move |folder| {
        graph.written_ports().map(move |port| {
            let suffix = if is_picture(graph, port) { "exr" } else { "npy" };
            (port, folder.join(format!("{}.{suffix}", graph.port_name(port))))
        })
    })
}

/// Prints what was written.
fn print_written(path: &Path, executor: &Executor, port: Handle<PlannedPort>) {
    let size = match executor.plan().resource(port) {
        Resource::Texture { width, height, .. } => format!("{width}x{height}, "),
        Resource::Buffer { .. } => String::new(),
    };
    let bytes = std::fs::metadata(path).map_or(0, |data| data.len());
    terminal::line(&format!("wrote {}  ({size}{})", path.display(), tyndall_gpu::bytes(bytes)));
}

/// A progress bar on a terminal, if there are several frames to wait for.
fn progress(frames: u64) -> indicatif::ProgressBar {
    if frames < 2 {
        return indicatif::ProgressBar::hidden();
    }
    indicatif::ProgressBar::new(frames)
}

/// Where the time goes.
struct Clock {
    started: Instant,
    last: Instant,
    laps: Vec<(&'static str, Duration)>,
}

impl Clock {
    fn start(app: &App) -> Self {
        Self { started: app.started, last: app.started, laps: Vec::new() }
    }

    fn lap(&mut self, name: &'static str) {
        let now = Instant::now();
        let took = now - self.last;
        self.last = now;
        match self.laps.iter_mut().find(|(lap, _)| *lap == name) {
            Some((_, sum)) => *sum += took,
            None => self.laps.push((name, took)),
        }
    }

    fn summary(&self) -> String {
        let laps: Vec<String> =
            self.laps.iter().map(|(name, took)| format!("{name} {}", milliseconds(*took))).collect();
        format!("{} in all: {}", milliseconds(self.started.elapsed()), laps.join(", "))
    }
}

fn milliseconds(duration: Duration) -> String {
    format!("{:.1} ms", duration.as_secs_f64() * 1e3)
}
