//! What the tests of one run share: the device, the registry, compiled pipelines, and results that have not changed.

use std::collections::{BTreeMap, HashMap};
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::{Duration, Instant};

use tyndall_document::Diagnostics;
use tyndall_gpu::{Executor, FRAMES_PER_SECOND, FrameOptions, Gpu, PipelineCache, PortData, Timing};
use tyndall_graph::descriptor::{Format, PortDescriptor};
use tyndall_graph::{Digest, Graph, Handle, MadeFrom, Order, Plan, PlanOptions, PlannedPort, PortRef, Resource, Roots};
use tyndall_plugin::{Plugin, Registry, SearchPath};
use tyndall_render::{Error, Loaded, Running};
use tyndall_scene::Encoded;

use crate::cached_references::CachedReferences;
use crate::picture::Picture;
use crate::provenance::{Origins, origins};
use crate::shared::Shared;
use crate::unchecked::written;

/// Makes the plugins of a registry.
pub type Plugins = Vec<fn() -> Plugin>;

/// What the tests of one run share.
///
/// A result that was computed for one test is given to every later one that is made from the same, so that of two
/// tests of one graph the second renders only what differs.
pub struct Session {
    plugins: Plugins,
    search: Vec<SearchPath>,
    pub(crate) gpu: Arc<Gpu>,
    /// By the folders that were searched; where one cannot be had, every mistake.
    registries: HashMap<Vec<PathBuf>, Result<Arc<Registry>, Diagnostics>>,
    pub(crate) cache: PipelineCache,
    shared: Arc<Shared>,
    /// What a pass took when it ran for the first time.
    costs: HashMap<MadeFrom, Duration>,
    /// Pictures that a driver has left undone.
    pub(crate) unfinished: Diagnostics,
    pub(crate) answers: CachedReferences,
    /// Of everything that is rendered, where somebody asks for it.
    pub(crate) digest: Option<Digest>,
    /// What sharing has saved.
    pub saved: Saved,
}

/// What a port was made from, and which port of the pass it is.
pub(crate) type ResultKey = (MadeFrom, Handle<PortDescriptor>);

/// How much sharing results between tests has saved, and what took time.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Saved {
    /// Runs of passes that would have been needed.
    pub passes: usize,
    /// Of these, runs that were not.
    pub spared: usize,
    /// Time that these took when they ran for the first time: an estimate of what is saved.
    pub spared_time: Duration,
    /// Time spent on rendering, compiling shaders and reading results back included.
    pub rendering: Duration,
    /// Time spent on references on the CPU.
    pub references: Duration,
    /// Time spent on comparing, references on the CPU left out.
    pub comparing: Duration,
    /// Time spent on measuring each pass and on pages, where there is a report.
    pub reporting: Duration,
}

impl std::ops::AddAssign for Saved {
    fn add_assign(&mut self, other: Self) {
        self.passes += other.passes;
        self.spared += other.spared;
        self.spared_time += other.spared_time;
        self.rendering += other.rendering;
        self.references += other.references;
        self.comparing += other.comparing;
        self.reporting += other.reporting;
    }
}

/// When judging began, and how long references on the CPU had taken until then.
pub(crate) struct Judging(Instant, Duration);

/// How a graph is rendered, apart from what it is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Variation {
    /// Which of the valid orders.
    pub order: Order,
    /// Ports share memory.
    pub share: bool,
    /// Memory holds NaN before it is first written.
    pub poison: bool,
    /// Results of earlier tests may be used.
    pub reuse: bool,
}

impl Variation {
    /// In file order, every port with memory of its own, with results of earlier tests.
    pub const PLAIN: Self = Self { order: Order::File, share: false, poison: false, reuse: true };
}

/// Ports of one frame.
pub struct Rendered {
    /// The frame.
    pub frame: u32,
    /// What was asked for.
    pub ports: BTreeMap<PortRef, Arc<PortData>>,
    /// What each was made from; `None` where it depends on a frame before.
    pub made_from: BTreeMap<PortRef, Option<MadeFrom>>,
}

impl Rendered {
    /// A port as a picture.
    pub fn picture(&self, plan: &Plan, port: PortRef) -> Option<Picture> {
        let class = plan.ports[plan.planned(port)?].class;
        Some(Picture::of(self.ports.get(&port)?, class))
    }
}

impl Session {
    /// Opens the adapter whose name holds `adapter`, or the best one. `search` are folders of plugins that win over
    /// those of crates.
    ///
    /// # Errors
    /// Where no adapter answers.
    pub fn new(plugins: Plugins, search: Vec<SearchPath>, adapter: Option<&str>) -> Result<Self, Error> {
        Self::sharing(&Arc::default(), plugins, search, adapter)
    }

    /// The same beside other sessions of these plugins, on a device of its own: what one has rendered, or has asked a
    /// reference, is known to all.
    ///
    /// # Errors
    /// Where no adapter answers.
    pub fn sharing(
        shared: &Arc<Shared>,
        plugins: Plugins,
        search: Vec<SearchPath>,
        adapter: Option<&str>,
    ) -> Result<Self, Error> {
        let gpu = Gpu::open(adapter)?;
        Ok(Self {
            plugins,
            search,
            gpu,
            registries: HashMap::new(),
            cache: PipelineCache::default(),
            shared: shared.clone(),
            costs: HashMap::new(),
            unfinished: Diagnostics::default(),
            answers: CachedReferences::sharing(&shared.references),
            digest: None,
            saved: Saved::default(),
        })
    }

    /// Another session on the same device. It knows all that this one has rendered and compiled so far, and keeps what it
    /// renders and compiles to itself: for passes whose shaders will not come again.
    #[must_use]
    pub fn fork(&self) -> Self {
        Self {
            plugins: self.plugins.clone(),
            search: self.search.clone(),
            gpu: self.gpu.clone(),
            registries: self.registries.clone(),
            cache: self.cache.clone(),
            shared: Arc::new(self.shared.fork()),
            costs: HashMap::new(),
            unfinished: Diagnostics::default(),
            answers: CachedReferences::sharing(&self.shared.references),
            digest: None,
            saved: Saved::default(),
        }
    }

    /// Judging begins.
    pub(crate) fn judging(&self) -> Judging {
        Judging(Instant::now(), self.answers.took())
    }

    /// Judging has ended.
    pub(crate) fn judged(&mut self, Judging(start, references): Judging) {
        let references = self.answers.took().saturating_sub(references);
        self.saved.references += references;
        self.saved.comparing += start.elapsed().saturating_sub(references);
    }

    /// The device.
    pub fn gpu(&self) -> &Arc<Gpu> {
        &self.gpu
    }

    /// The registry for a graph: beside the session's search paths, `plugins` beside the graph.
    ///
    /// # Errors
    /// Every mistake of every manifest and shader.
    pub fn registry(&mut self, graph: &Path) -> Result<Arc<Registry>, Error> {
        let beside = graph.parent().unwrap_or(Path::new("")).join("plugins");
        let mut paths = self.search.clone();
        if beside.is_dir() {
            // Behind what somebody named, before what is usual: as `tyndall render` looks for them.
            let at = paths.iter().position(|search| !search.required).unwrap_or(paths.len());
            paths.insert(at, SearchPath { path: beside, required: false });
        }
        let key: Vec<_> = paths.iter().map(|search| search.path.clone()).collect();
        if !self.registries.contains_key(&key) {
            let crates = self.plugins.iter().map(|plugin| plugin()).collect();
            let registry = tyndall_render::registry(crates, &paths).map(Arc::new);
            self.registries.insert(key.clone(), registry);
        }
        Ok(self.registries[&key].clone()?)
    }

    /// Plans a graph so that these ports can be read.
    ///
    /// # Errors
    /// Mistakes that show only at the frame's size.
    pub fn plan(graph: &Arc<Graph>, roots: Roots, variation: Variation) -> Result<Plan, Error> {
        let options =
            PlanOptions { roots, share: variation.share, order: variation.order, ..PlanOptions::new(graph.size) };
        Ok(tyndall_graph::plan(graph, &options)?)
    }

    /// Renders the ports of a graph in these frames, rising.
    ///
    /// # Errors
    /// Mistakes of the graph at its size; what the machine cannot do.
    pub fn render(
        &mut self,
        loaded: &Loaded,
        registry: &Registry,
        ports: &[PortRef],
        frames: &[u32],
        variation: Variation,
    ) -> Result<Vec<Rendered>, Error> {
        let start = Instant::now();
        let plan = Self::plan(&loaded.graph, Roots::Ports(ports.to_vec()), variation)?;
        let remembers = plan.passes.handles().any(|pass| plan.descriptor(pass).remembers());
        let rendered = if remembers || !variation.reuse {
            self.render_whole(loaded, registry, plan, ports, frames, (variation, remembers))
        } else {
            frames.iter().map(|frame| self.render_missing(loaded, registry, &plan, ports, *frame)).collect()
        };
        self.saved.rendering += start.elapsed();
        if let (Some(digest), Ok(rendered)) = (&mut self.digest, &rendered) {
            let ports = rendered.iter().flat_map(|frame| frame.ports.values());
            ports.for_each(|port| digest.bytes(&port.bytes));
        }
        rendered
    }

    /// Renders everything; with history every frame from 0 on.
    fn render_whole(
        &mut self,
        loaded: &Loaded,
        registry: &Registry,
        plan: Plan,
        ports: &[PortRef],
        frames: &[u32],
        (variation, remembers): (Variation, bool),
    ) -> Result<Vec<Rendered>, Error> {
        let mut running = Running::new(&self.gpu, plan, loaded.scene.as_ref(), registry, &mut self.cache)?;
        let all: Vec<u32> = match (remembers, frames.last()) {
            (true, Some(last)) => (0..=*last).collect(),
            _ => frames.to_vec(),
        };
        let mut rendered = Vec::with_capacity(frames.len());
        for frame in all {
            if variation.poison {
                running.executor.poison(f32::NAN)?;
            }
            running.frame(FrameOptions { frame, everything: true, ..FrameOptions::default() })?;
            self.saved.passes += running.executor.plan().passes.len();
            if frames.contains(&frame) {
                let prints = self.prints(loaded, registry, running.executor.plan(), frame);
                rendered.push(read_all(&running.executor, ports, frame, &prints)?);
            }
        }
        running.warn_of_unfinished(&mut self.unfinished)?;
        Ok(rendered)
    }

    pub(crate) fn prints(&self, loaded: &Loaded, registry: &Registry, plan: &Plan, frame: u32) -> Origins {
        let encoded = encode(loaded, plan, frame);
        origins(plan, registry, encoded.as_ref(), frame)
    }

    /// Renders what no test has rendered before, from what one has.
    fn render_missing(
        &mut self,
        loaded: &Loaded,
        registry: &Registry,
        plan: &Plan,
        ports: &[PortRef],
        frame: u32,
    ) -> Result<Rendered, Error> {
        let prints = self.prints(loaded, registry, plan, frame);
        let mut rendered = Rendered { frame, ports: BTreeMap::new(), made_from: BTreeMap::new() };
        let mut missing = Vec::new();
        for port in ports {
            let Some(planned) = plan.planned(*port) else { continue };
            let key = key(plan, &prints, planned);
            rendered.made_from.insert(*port, made_from(plan, &prints, planned));
            match key.and_then(|key| self.shared.result(&key)) {
                Some(data) => drop(rendered.ports.insert(*port, data)),
                None => missing.push(*port),
            }
        }
        self.saved.passes += plan.passes.len();
        if missing.is_empty() {
            self.spare(plan, &prints, &[]);
            return Ok(rendered);
        }
        let rest = Self::plan(&loaded.graph, Roots::Ports(missing.clone()), Variation::PLAIN)?;
        let rest_prints = self.prints(loaded, registry, &rest, frame);
        let mut running = Running::new(&self.gpu, rest, loaded.scene.as_ref(), registry, &mut self.cache)?;
        self.give_known(&mut running.executor, &rest_prints)?;
        running.frame(FrameOptions { frame, timing: Timing::Each, ..FrameOptions::default() })?;
        running.warn_of_unfinished(&mut self.unfinished)?;
        let executor = &running.executor;
        let ran = self.ran(executor, &rest_prints);
        self.spare(plan, &prints, &ran);
        for port in missing {
            let Some(planned) = executor.plan().planned(port) else { continue };
            let data = Arc::new(executor.read(planned)?);
            if let Some(key) = key(executor.plan(), &rest_prints, planned) {
                self.shared.keep(key, &data);
            }
            rendered.ports.insert(port, data);
        }
        Ok(rendered)
    }

    /// What the passes that an executor has run were made from, and what each took.
    fn ran(&mut self, executor: &Executor, prints: &Origins) -> Vec<MadeFrom> {
        let ran = executor.counters().iter().zip(prints).filter(|(counters, _)| counters.runs > 0);
        for (counters, print) in ran.clone() {
            let took = Duration::from_secs_f64(counters.alone_us / 1e6);
            self.costs.entry(print.made_from).or_insert(took);
        }
        ran.map(|(_, print)| print.made_from).collect()
    }

    /// Counts the passes of a plan that have not run, as they had before.
    fn spare(&mut self, plan: &Plan, prints: &Origins, ran: &[MadeFrom]) {
        self.saved.spared += plan.passes.len() - ran.len();
        let spared = prints.iter().map(|print| &print.made_from).filter(|print| !ran.contains(print));
        self.saved.spared_time += spared.filter_map(|print| self.costs.get(print)).sum::<Duration>();
    }

    /// Gives every result that is known from before, where a device takes it.
    fn give_known(&self, executor: &mut Executor, prints: &Origins) -> Result<(), Error> {
        for port in executor.plan().ports.handles() {
            let known = key(executor.plan(), prints, port).and_then(|key| self.shared.result(&key));
            if let Some(data) = known.filter(|_| can_be_given(executor.plan().resource(port))) {
                executor.give(port, &data.bytes)?;
            }
        }
        Ok(())
    }

    /// GPU time of every pass that these ports need by itself, in microseconds and in the order of `plan`; `None` where it
    /// cannot be measured. Each pass runs once more, not all of them for each.
    ///
    /// # Errors
    /// What the machine cannot do.
    pub fn times(&mut self, loaded: &Loaded, registry: &Registry, plan: &Plan) -> Result<Vec<Option<f64>>, Error> {
        let start = Instant::now();
        let all = Self::plan(&loaded.graph, Roots::Ports(written(plan)), Variation::PLAIN)?;
        let (passes, prints) = (all.passes.handles(), self.prints(loaded, registry, &all, 0));
        let mut running = Running::new(&self.gpu, all, loaded.scene.as_ref(), registry, &mut self.cache)?;
        self.give_known(&mut running.executor, &prints)?;
        running.frame(FrameOptions::default())?;
        let time = |pass| {
            running.executor.forget(pass);
            let options = FrameOptions { timing: Timing::Pass(pass), ..FrameOptions::default() };
            Ok(running.frame(options)?.gpu_us)
        };
        let times = passes.map(time).collect();
        self.saved.reporting += start.elapsed();
        times
    }

    /// Runs one pass of a frame with these inputs given, and reads its ports.
    ///
    /// # Errors
    /// What the machine cannot do; an input of another size.
    pub fn render_alone(
        &mut self,
        loaded: &Loaded,
        registry: &Registry,
        ports: &[PortRef],
        inputs: &BTreeMap<PortRef, Arc<PortData>>,
        frame: u32,
    ) -> Result<Rendered, Error> {
        let start = Instant::now();
        let plan = Self::plan(&loaded.graph, Roots::Ports(ports.to_vec()), Variation::PLAIN)?;
        let mut running = Running::new(&self.gpu, plan, loaded.scene.as_ref(), registry, &mut self.cache)?;
        for (port, data) in inputs {
            let executor = &mut running.executor;
            if let Some(planned) = executor.plan().planned(*port) {
                executor.give(planned, &data.bytes)?;
            }
        }
        running.frame(FrameOptions { frame, ..FrameOptions::default() })?;
        running.warn_of_unfinished(&mut self.unfinished)?;
        // What was given was made from nothing that is known here.
        let rendered = read_all(&running.executor, ports, frame, &Origins::new());
        self.saved.rendering += start.elapsed();
        rendered
    }
}

/// What a result is known by, where it can be shared.
fn key(plan: &Plan, prints: &Origins, port: Handle<PlannedPort>) -> Option<ResultKey> {
    let planned = &plan.ports[port];
    Some((prints[planned.pass?].repeatable()?, planned.port.port))
}

fn made_from(plan: &Plan, prints: &Origins, port: Handle<PlannedPort>) -> Option<MadeFrom> {
    Some(prints.get(plan.ports[port].pass?)?.made_from)
}

fn read_all(executor: &Executor, ports: &[PortRef], frame: u32, prints: &Origins) -> Result<Rendered, Error> {
    let mut rendered = Rendered { frame, ports: BTreeMap::new(), made_from: BTreeMap::new() };
    for port in ports {
        let Some(planned) = executor.plan().planned(*port) else { continue };
        rendered.ports.insert(*port, Arc::new(executor.read(planned)?));
        rendered.made_from.insert(*port, made_from(executor.plan(), prints, planned));
    }
    Ok(rendered)
}

/// The time of a frame in seconds, and width over height.
pub(crate) fn moment(plan: &Plan, frame: u32) -> (f64, f64) {
    (f64::from(frame) / FRAMES_PER_SECOND, f64::from(plan.size.0) / f64::from(plan.size.1))
}

/// The scene's bytes in a frame.
fn encode(loaded: &Loaded, plan: &Plan, frame: u32) -> Option<Encoded> {
    let (time, aspect) = moment(plan, frame);
    loaded.scene.as_ref().map(|scene| scene.encode_for(time, aspect, &|name| plan.reads(name)))
}

/// Nothing can be copied into a rasteriser's depth buffer.
fn can_be_given(resource: &Resource) -> bool {
    !matches!(resource, Resource::Texture { format: Format::Depth32Float, .. })
}
