//! `bench`: times per pass and per frame, and bytes of memory.

use std::time::Instant;

use serde_json::{Value, json};
use tyndall_gpu::{FrameOptions, Gpu, PipelineCache, Timing, bytes};
use tyndall_graph::descriptor::{ParamDescriptor, ParamValue};
use tyndall_graph::{Graph, Plan, PlannedPass, Roots, Table};
use tyndall_image::metrics::median;
use tyndall_render::Running;

use crate::App;
use crate::cli::{Arguments, Bench};
use crate::failure::Failure;
use crate::loading::{self, Wanted};
use crate::warnings::Untold;
use crate::{plugins, terminal};

/// Most frames in which each pass is timed by itself: enough for a median.
const MOST_FRAMES_PER_PASS: u32 = 16;

/// What was measured; times in microseconds, medians.
struct Figures {
    adapter: String,
    size: (u32, u32),
    load_us: f64,
    validate_us: f64,
    plan_us: f64,
    first_image_ms: f64,
    cpu_us: f64,
    gpu_us: Option<f64>,
    passes: Vec<PassFigures>,
    shared: u64,
    unshared: u64,
}

struct PassFigures {
    name: String,
    runs: u64,
    cpu_us: f64,
    gpu_us: Option<f64>,
}

pub(crate) fn run(app: &App, arguments: &Arguments, verb: &Bench) -> Result<(), Failure> {
    let registry = plugins::registry(app, arguments, &[&verb.graph.graph])?;
    let loaded = loading::load(&verb.graph, &registry, &Untold::of_models())?;
    let varied = verb.vary.iter().map(|text| Varied::parse(text, &loaded.graph)).collect::<Result<Vec<_>, _>>()?;
    let live: Vec<String> = varied.iter().map(|varied| varied.name.clone()).collect();
    let start = Instant::now();
    let plan = loading::plan(&loaded, Wanted { roots: Roots::Outputs, keep: verb.keep, live: &live })?;
    let plan_us = start.elapsed().as_secs_f64() * 1e6;
    let gpu = Gpu::open(verb.adapter.as_deref())?;
    let mut running = Running::new(&gpu, plan, loaded.scene.as_ref(), &registry, &mut PipelineCache::default())?;

    let (mut cpu, mut gpu_times) = (Vec::new(), Vec::new());
    let mut first_image_ms = 0.0;
    for frame in 0..verb.frames {
        for varied in &varied {
            varied.set(&mut running, frame, verb.frames)?;
        }
        let options = FrameOptions { frame, everything: !verb.keep, timing: Timing::Frame, cpu_times: false };
        let report = running.frame(options)?;
        if frame == 0 {
            if let Some((_, port)) = running.executor.plan().outputs.first() {
                running.executor.read(*port)?;
            }
            first_image_ms = app.started.elapsed().as_secs_f64() * 1e3;
        }
        cpu.push(report.cpu_us);
        gpu_times.extend(report.gpu_us);
    }
    let passes = time_passes(&mut running, verb)?;
    loading::warn_of_unfinished(&running, &Untold::of_models())?;
    let plan: &Plan = running.executor.plan();
    let figures = Figures {
        adapter: gpu.info.name.clone(),
        size: plan.size,
        load_us: loaded.load_us,
        validate_us: loaded.validate_us,
        plan_us,
        first_image_ms,
        cpu_us: median(&mut cpu).unwrap_or_default(),
        gpu_us: median(&mut gpu_times),
        passes,
        shared: plan.bytes.shared,
        unshared: plan.bytes.unshared,
    };
    if let Some(path) = &verb.json {
        tyndall_image::write_bytes(path, format!("{:#}\n", figures.json()).as_bytes())?;
    }
    terminal::text(&figures.text());
    if let Some(path) = &verb.json {
        terminal::line(&format!("wrote {}", path.display()));
    }
    Ok(())
}

/// Times each pass in frames of its own: timestamps around all passes at once would distort all of them.
fn time_passes(running: &mut Running<'_>, verb: &Bench) -> Result<Vec<PassFigures>, Failure> {
    let runs: Table<PlannedPass, u64> = running.executor.counters().iter().map(|counters| counters.runs).collect();
    let mut figures = Vec::with_capacity(runs.len());
    for (pass, runs) in runs.entries() {
        let (mut cpu, mut gpu) = (Vec::new(), Vec::new());
        for frame in 0..verb.frames.min(MOST_FRAMES_PER_PASS) {
            let options = FrameOptions { frame, everything: true, timing: Timing::Pass(pass), cpu_times: true };
            gpu.extend(running.frame(options)?.gpu_us);
            cpu.push(running.executor.counters()[pass].cpu_us);
        }
        figures.push(PassFigures {
            name: running.executor.plan().pass_name(pass).to_owned(),
            runs: *runs,
            cpu_us: median(&mut cpu).unwrap_or_default(),
            gpu_us: median(&mut gpu),
        });
    }
    Ok(figures)
}

/// A parameter that varies from one value to another over the frames.
struct Varied {
    name: String,
    targets: Vec<(String, String)>,
    from: f64,
    to: f64,
}

impl Varied {
    fn parse(text: &str, graph: &Graph) -> Result<Self, Failure> {
        let wrong = || Failure::Usage(format!("--vary {text}: write NAME=A..B"));
        let (name, range) = text.split_once('=').ok_or_else(wrong)?;
        let (from, to) = range.split_once("..").ok_or_else(wrong)?;
        let (from, to): (f64, f64) = (from.parse().map_err(|_| wrong())?, to.parse().map_err(|_| wrong())?);
        let mut targets = Vec::new();
        for found in graph.find_params(name) {
            let pass = graph.pass(found.pass);
            let param = &pass.descriptor().params[found.param];
            if let Some(reason) = why_not(param, from, to) {
                return Err(Failure::Usage(format!(
                    "--vary {text}: `{}` of pass `{}` {reason}",
                    param.name, pass.name
                )));
            }
            targets.push((pass.name.clone(), param.name.clone()));
        }
        if targets.is_empty() {
            return Err(Failure::Usage(format!("--vary {text}: the graph has no parameter `{name}`")));
        }
        Ok(Self { name: name.to_owned(), targets, from, to })
    }

    fn set(&self, running: &mut Running<'_>, frame: u32, frames: u32) -> Result<(), Failure> {
        let part = f64::from(frame) / f64::from((frames - 1).max(1));
        let value = self.from + part * (self.to - self.from);
        for (pass, param) in &self.targets {
            running.executor.set_param(pass, param, ParamValue::Float(value))?;
        }
        Ok(())
    }
}

/// Why a parameter cannot vary.
fn why_not(param: &ParamDescriptor, from: f64, to: f64) -> Option<String> {
    if param.fixed {
        return Some("is part of the pipeline, and cannot change while it runs".to_owned());
    }
    let refusal = [from, to].into_iter().find_map(|value| param.check(&ParamValue::Float(value)).err());
    refusal.map(|refusal| refusal.to_string())
}

impl Figures {
    fn json(&self) -> Value {
        let pass = |pass: &PassFigures| json!({ "name": pass.name, "runs": pass.runs, "cpu_us": pass.cpu_us, "gpu_us": pass.gpu_us });
        json!({
            "adapter": self.adapter,
            "size": [self.size.0, self.size.1],
            "load_us": self.load_us,
            "validate_us": self.validate_us,
            "plan_us": self.plan_us,
            "first_image_ms": self.first_image_ms,
            "frame": { "cpu_us": self.cpu_us, "gpu_us": self.gpu_us },
            "passes": self.passes.iter().map(pass).collect::<Vec<_>>(),
            "transient_bytes": { "shared": self.shared, "unshared": self.unshared },
        })
    }

    fn text(&self) -> String {
        let time = |us: Option<f64>| us.map_or("-".to_owned(), |us| format!("{:.3} ms", us / 1e3));
        let width = self.passes.iter().map(|pass| pass.name.len()).max().unwrap_or(4).max(5);
        let mut text = format!("{} at {}x{}\n\n", self.adapter, self.size.0, self.size.1);
        text += &format!("{:width$}  {:>6}  {:>12}  {:>12}\n", "pass", "runs", "record", "GPU");
        for pass in &self.passes {
            let (name, runs) = (&pass.name, pass.runs);
            text += &format!("{name:width$}  {runs:>6}  {:>12}  {:>12}\n", time(Some(pass.cpu_us)), time(pass.gpu_us));
        }
        text +=
            &format!("{:width$}  {:>6}  {:>12}  {:>12}\n\n", "frame", "", time(Some(self.cpu_us)), time(self.gpu_us));
        text += &format!(
            "load {:.1} us, validate {:.1} us, plan {:.1} us; first image after {:.1} ms\n",
            self.load_us, self.validate_us, self.plan_us, self.first_image_ms
        );
        text + &format!("transient memory {}, {} without sharing\n", bytes(self.shared), bytes(self.unshared))
    }
}
