//! One test, from its file to what it found.

use std::collections::BTreeSet;
use std::path::Path;
use std::sync::Arc;
use std::time::Instant;

use tyndall_document::Diagnostics;
use tyndall_graph::descriptor::PortDescriptor;
use tyndall_graph::{Digest, Graph, Handle, Pass, Plan, PlannedPass, PlannedPort, PortRef, Roots};
use tyndall_plugin::Registry;
use tyndall_render::{Error, Loaded, load};

use crate::adapter::AdapterClass;
use crate::blame::{Upstream, attribute};
use crate::file::{Change, Expectation, Property, Tapped, TestFile, check, check_run, matches, read};
use crate::golden::{self, Records};
use crate::judge::{Computing, Judge};
use crate::metric::Judgement;
use crate::options::Options;
use crate::outcome::{Outcome, PassOutcome, PortOutcome, Problem, RelationOutcome, State};
use crate::picture::Picture;
use crate::provenance::Origins;
use crate::session::{Rendered, Session, Variation};
use crate::unchecked::{self, written};
use crate::{bless, isolate, relation, robust};

/// A test whose file, graph and scene are read.
pub(crate) struct Ready {
    pub file: TestFile,
    pub registry: Arc<Registry>,
    pub loaded: Loaded,
    pub plan: Plan,
    /// What is judged, in the order of the plan.
    pub tapped: Vec<Tapped>,
    /// Of these, what somebody wants to know of. The others are what that was made from.
    pub chosen: BTreeSet<String>,
    pub records: Records,
    /// It runs in another size than its own, for which what it states of its size says nothing.
    pub resized: bool,
}

/// Another run of a relation.
struct Run {
    loaded: Loaded,
    plan: Plan,
    rendered: Vec<Rendered>,
}

impl Session {
    /// Runs the test in a file.
    pub fn run(&mut self, path: &Path, options: &Options) -> Outcome {
        self.run_from(None, path, options)
    }

    /// The same with the passes of this registry, whichever the session would choose.
    pub fn run_with(&mut self, registry: &Arc<Registry>, path: &Path, options: &Options) -> Outcome {
        self.run_from(Some(registry), path, options)
    }

    fn run_from(&mut self, registry: Option<&Arc<Registry>>, path: &Path, options: &Options) -> Outcome {
        let start = Instant::now();
        let mut outcome = Outcome { path: path.to_owned(), ..Outcome::default() };
        self.digest = options.digest.then(Digest::default);
        if let Err(error) = self.try_run(registry, path, options, &mut outcome) {
            outcome.problems.push(match error {
                Error::Mistakes(mut mistakes) => {
                    mistakes.sort();
                    mistakes.dedup();
                    Problem::Mistakes(mistakes)
                }
                Error::Gpu(error) => Problem::Machine(error.to_string()),
            });
        }
        outcome.warnings.extend(std::mem::take(&mut self.unfinished));
        outcome.digest = self.digest.take().map(|digest| digest.finish());
        outcome.took = start.elapsed();
        outcome
    }

    fn try_run(
        &mut self,
        registry: Option<&Arc<Registry>>,
        path: &Path,
        options: &Options,
        outcome: &mut Outcome,
    ) -> Result<(), Error> {
        let ready = self.ready(registry, path, options, outcome)?;
        outcome.about.clone_from(&ready.file.about);
        outcome.graph.clone_from(&ready.file.request.graph);
        outcome.passes = passes(&ready.plan);
        if options.isolate {
            isolate::run(self, &ready, options, outcome)?;
        } else {
            let ports = match () {
                () if options.for_report => written(&ready.plan),
                () if options.only.is_some() => ready.ports_of_taps(),
                () => ready.ports(),
            };
            let frames = &ready.file.frames;
            let mut rendered = self.render(&ready.loaded, &ready.registry, &ports, frames, Variation::PLAIN)?;
            if options.for_report {
                let take = |frame| unchecked::take(&ready, options, frame);
                outcome.unchecked = rendered.iter_mut().flat_map(take).collect();
            }
            let adapter = AdapterClass::of(self.gpu());
            let judging = self.judging();
            let judge = Judge { ready: &ready, options, adapter, answers: &self.answers };
            let judged = rendered.iter().filter(|frame| options.looks_at(frame.frame));
            outcome.ports = judged.flat_map(|frame| judge.frame(frame)).collect();
            self.judged(judging);
            let decided = options.fail_fast && !outcome.ports.iter().all(PortOutcome::passed);
            outcome.left_out.extend(ready.left_out_by_size());
            if !ready.resized && !decided && options.only.is_none() {
                outcome.relations = self.relations(&ready, &rendered, options)?;
            }
            attribute(&ready.plan, &Upstream::of(&ready.plan), outcome);
            robust::run(self, &ready, &rendered, options, outcome)?;
            if options.bless {
                bless::run(&ready, &rendered, adapter, options, outcome);
            }
            // What lies before the chosen ports was judged for their sake: only what excuses them is told.
            let chosen = |port: &PortOutcome| ready.chosen.contains(&port.name) || port.state != State::Passed;
            outcome.ports.retain(chosen);
        }
        if !ready.resized && !options.without_goldens && options.only.is_none() {
            let claimed = claimed(&ready);
            let orphans = golden::orphans(&ready.file.goldens(), &claimed);
            outcome.problems.extend(orphans.into_iter().map(Problem::Orphan));
            // Blessing has dropped some.
            let records = Records::read(&ready.file.goldens())?;
            let gone = golden::orphan_records(&ready.file.goldens(), &claimed, &records);
            outcome.problems.extend(gone.into_iter().map(Problem::OrphanRecord));
        }
        if options.for_report {
            let times = self.times(&ready.loaded, &ready.registry, &ready.plan)?;
            outcome.passes.iter_mut().zip(times).for_each(|(pass, time)| pass.microseconds = time);
        } else {
            for port in outcome.ports.iter_mut().filter(|port| port.state == State::Passed) {
                (port.actual, port.expected) = (None, None);
            }
        }
        Ok(())
    }

    /// The registry of a test, and the kinds (`plugin.pass`) of the passes that it runs.
    ///
    /// # Errors
    /// Every mistake of the test, of its graph and scene, and of the plugins.
    pub fn kinds(&mut self, path: &Path) -> Result<(Arc<Registry>, BTreeSet<String>), Error> {
        let ready = self.ready(None, path, &Options::default(), &mut Outcome::default())?;
        let kinds = passes(&ready.plan).into_iter().map(|pass| pass.kind).collect();
        Ok((ready.registry, kinds))
    }

    fn ready(
        &mut self,
        registry: Option<&Arc<Registry>>,
        path: &Path,
        options: &Options,
        outcome: &mut Outcome,
    ) -> Result<Ready, Error> {
        let mut out = Diagnostics::default();
        let Some(mut file) = read(path, &mut out) else { return Err(out.into()) };
        let size = file.request.size.map(|own| options.size_of(own));
        let resized = size != file.request.size;
        file.request.size = size;
        let registry = registry.map_or_else(|| self.registry(&file.request.graph), |given| Ok(given.clone()))?;
        let Some(loaded) = load(&file.request, &registry, &mut out).filter(|_| !out.has_errors()) else {
            return Err(out.into());
        };
        let has_reference = |pass: &str| registry.pass(pass).is_some_and(|pass| pass.reference.is_some());
        let mut tapped = check(&file, &loaded.graph, &has_reference, &mut out);
        if out.has_errors() {
            return Err(out.into());
        }
        outcome.warnings = out;
        if options.without_references {
            leave_out_references(&mut file, &mut tapped);
        }
        let graph = &loaded.graph;
        let named = file.ports_named();
        let roots = tapped.iter().map(|tapped| tapped.port).chain(named.filter_map(|name| find(graph, name))).collect();
        let plan = Self::plan(&loaded.graph, Roots::Ports(roots), Variation::PLAIN)?;
        let records = Records::read(&file.goldens())?;
        tapped.sort_by_key(|tapped| plan.planned(tapped.port));
        let wanted = |tapped: &&Tapped| options.tap.as_ref().is_none_or(|pattern| matches(pattern, &tapped.name));
        let chosen: Vec<&Tapped> = tapped.iter().filter(wanted).collect();
        let needed = needed(graph, &plan, &chosen);
        let chosen = chosen.into_iter().map(|tapped| tapped.name.clone()).collect();
        tapped.retain(|tapped| needed.contains(&tapped.port));
        if let Some(kind) = &options.only {
            tapped.retain(|tapped| graph.pass(tapped.port.pass).descriptor().name == *kind);
        }
        Ok(Ready { file, registry, loaded, plan, tapped, chosen, records, resized })
    }

    fn relations(&mut self, ready: &Ready, own: &[Rendered], options: &Options) -> Result<Vec<RelationOutcome>, Error> {
        let mut outcomes = Vec::new();
        let graph = &ready.loaded.graph;
        let upstream = Upstream::of(&ready.plan);
        let wanted = |name: &str| options.tap.as_ref().is_none_or(|pattern| matches(pattern, name));
        for relation in &ready.file.relations {
            let failed = |relation: &RelationOutcome| !relation.judgement.passed;
            if options.fail_fast && outcomes.iter().any(failed) {
                break;
            }
            let expect: Vec<_> = relation.expect.iter().filter(|expectation| wanted(&expectation.port)).collect();
            if expect.is_empty() {
                continue;
            }
            let ports: Vec<PortRef> = expect.iter().filter_map(|expectation| find(graph, &expectation.port)).collect();
            let asking = expect.iter().zip(&ports).filter(|(each, _)| matches!(each.change, Change::CpuReference(_)));
            let inputs = asking.flat_map(|(_, port)| ready.inputs(port.pass)).map(|(_, port)| port);
            let rendering: Vec<PortRef> = ports.iter().copied().chain(inputs).collect();
            let (mut runs, mut changed) = (Vec::new(), BTreeSet::new());
            for settings in &relation.runs {
                let mut request = ready.file.request.clone();
                request.set.extend(settings.iter().cloned());
                let mut out = Diagnostics::default();
                let loaded = load(&request, &ready.registry, &mut out).filter(|_| !out.has_errors());
                let Some(loaded) = loaded else { return Err(out.into()) };
                let plan = Self::plan(&loaded.graph, Roots::Ports(rendering.clone()), Variation::PLAIN)?;
                check_run(&ready.file, &expect, (&ready.loaded, &ready.plan), (&loaded, &plan), &mut out);
                if out.has_errors() {
                    return Err(out.into());
                }
                let frames = &ready.file.frames;
                let rendered = self.render(&loaded, &ready.registry, &rendering, frames, Variation::PLAIN)?;
                changed.extend(self.made_from_other(ready, &loaded, &plan));
                runs.push(Run { loaded, plan, rendered });
            }
            let unheld = |port: PortRef| -> Vec<String> {
                let position = ready.plan.position(port.pass);
                let made_from = position.map(|position| upstream.ports(position)).into_iter().flatten();
                let names = made_from.filter(|port| changed.contains(port)).map(|port| ready.plan.port_name(*port));
                let held = |name: &String| {
                    let of_port = |each: &&Expectation| each.port == *name;
                    expect.iter().copied().filter(of_port).any(|each| matches!(each.change, Change::CpuReference(_)))
                };
                names.filter(|name| !held(name)).collect()
            };
            let judging = self.judging();
            for (expectation, port) in expect.iter().zip(&ports) {
                for (frame, own) in own.iter().enumerate().filter(|(_, own)| options.looks_at(own.frame)) {
                    let others: Option<Vec<Picture>> =
                        runs.iter().map(|run| run.rendered.get(frame)?.picture(&ready.plan, *port)).collect();
                    let judgement = match (own.picture(&ready.plan, *port), others) {
                        (Some(own), Some(others)) => {
                            let computed = |run: usize| {
                                let Run { loaded, plan, rendered } = &runs[run];
                                let registry = &ready.registry;
                                let computing = Computing { plan, registry, loaded, answers: &self.answers };
                                computing.port(*port, &others[run], &rendered[frame])
                            };
                            relation::judge(expectation.change, &own, &others, &computed)
                        }
                        _ => Judgement::failed("it was not rendered in every run".to_owned()),
                    };
                    outcomes.push(RelationOutcome {
                        frame: own.frame,
                        about: relation.about.clone(),
                        port: expectation.port.clone(),
                        pass: graph.pass(port.pass).name.clone(),
                        unheld: unheld(*port),
                        judgement,
                        state: State::Passed,
                    });
                }
            }
            self.judged(judging);
        }
        Ok(outcomes)
    }
}

impl Session {
    /// Ports of the test's own plan that another run makes of something else.
    fn made_from_other(&self, ready: &Ready, other: &Loaded, plan: &Plan) -> BTreeSet<Handle<PlannedPort>> {
        let frame = ready.file.frames.last().copied().unwrap_or_default();
        let own = self.prints(&ready.loaded, &ready.registry, &ready.plan, frame);
        let others = self.prints(other, &ready.registry, plan, frame);
        let is_same = |port: &Handle<PlannedPort>| {
            let print = |plan: &Plan, prints: &Origins, port: Handle<PlannedPort>| {
                Some(prints[plan.ports[port].pass?].made_from)
            };
            let in_other = plan.planned(ready.plan.ports[*port].port);
            let print_there = in_other.and_then(|port| print(plan, &others, port));
            print_there.is_some() && print_there == print(&ready.plan, &own, *port)
        };
        let ports = ready.plan.ports.entries().filter(|(_, port)| port.pass.is_some());
        ports.map(|(port, _)| port).filter(|port| !is_same(port)).collect()
    }
}

impl Ready {
    /// Every port that is needed to judge: those tapped, those that properties and relations name, and the inputs of
    /// passes with a reference on the CPU.
    pub fn ports(&self) -> Vec<PortRef> {
        let graph = &self.loaded.graph;
        let mut ports: BTreeSet<PortRef> = self.ports_of_taps().into_iter().collect();
        ports.extend(self.file.ports_named().filter_map(|name| find(graph, name)));
        ports.into_iter().collect()
    }

    /// Of these, what is needed to judge what is tapped.
    fn ports_of_taps(&self) -> Vec<PortRef> {
        let graph = &self.loaded.graph;
        let mut ports: BTreeSet<PortRef> = self.tapped.iter().map(|tapped| tapped.port).collect();
        let named = self.tapped.iter().flat_map(|tapped| &tapped.properties).flat_map(|property| property.ports());
        ports.extend(named.filter_map(|name| find(graph, name)));
        for tapped in self.tapped.iter().filter(|tapped| tapped.asks_cpu()) {
            ports.extend(self.inputs(tapped.port.pass).into_iter().map(|(_, port)| port));
        }
        ports.into_iter().collect()
    }

    /// What feeds a pass of the graph: the input, and the port.
    pub fn inputs(&self, pass: Handle<Pass>) -> Vec<(Handle<PortDescriptor>, PortRef)> {
        inputs_of(&self.plan, pass)
    }

    /// What is not asked where it runs in another size than its own.
    fn left_out_by_size(&self) -> Option<String> {
        let any = |asks: &dyn Fn(&Tapped) -> bool| self.tapped.iter().any(asks);
        let is_mean = |property: &Property| matches!(property, Property::Mean { .. });
        let parts = [
            ("goldens", any(&|tapped| tapped.golden.is_some())),
            ("other renderers' pictures", any(&|tapped| tapped.reference.is_some())),
            ("means", any(&|tapped| tapped.properties.iter().any(is_mean))),
            ("relations", !self.file.relations.is_empty()),
        ];
        let parts: Vec<&str> = parts.into_iter().filter_map(|(what, is_there)| is_there.then_some(what)).collect();
        (self.resized && !parts.is_empty()).then(|| format!("in another size than its own: {}", parts.join(", ")))
    }

    /// The name of a golden.
    pub fn key(&self, port: &str, frame: u32) -> String {
        golden::key(port, frame, self.file.frames.len() > 1)
    }
}

/// Takes away whatever asks a reference on the CPU.
fn leave_out_references(file: &mut TestFile, tapped: &mut [Tapped]) {
    for port in tapped {
        port.properties.retain(|property| !matches!(property, Property::CpuReference { .. }));
    }
    for relation in &mut file.relations {
        relation.expect.retain(|expectation| !matches!(expectation.change, Change::CpuReference(_)));
    }
}

/// What feeds a pass of a plan: the input, and the port.
pub(crate) fn inputs_of(plan: &Plan, pass: Handle<Pass>) -> Vec<(Handle<PortDescriptor>, PortRef)> {
    let Some(position) = plan.position(pass) else { return Vec::new() };
    let sources = plan.sources(position).entries();
    sources.filter_map(|(input, source)| Some((input, plan.ports[(*source)?].port))).collect()
}

/// These ports, and all that they were made from and are held against.
fn needed(graph: &Graph, plan: &Plan, chosen: &[&Tapped]) -> BTreeSet<PortRef> {
    let upstream = Upstream::of(plan);
    let named = chosen.iter().flat_map(|tapped| &tapped.properties).flat_map(|property| property.ports());
    let ports = chosen.iter().map(|tapped| tapped.port).chain(named.filter_map(|name| find(graph, name)));
    let mut needed = BTreeSet::new();
    for port in ports {
        needed.insert(port);
        let before = plan.position(port.pass).map(|position| upstream.ports(position));
        needed.extend(before.into_iter().flatten().map(|port| plan.ports[*port].port));
    }
    needed
}

impl Tapped {
    fn asks_cpu(&self) -> bool {
        self.properties.iter().any(|property| matches!(property, Property::CpuReference { .. }))
    }
}

/// The port of this name, which was checked before.
pub(crate) fn find(graph: &Graph, name: &str) -> Option<PortRef> {
    graph.find(name, tyndall_document::Place::Argument(String::new())).ok()
}

/// File names of the goldens that the taps of a test claim, whichever were chosen.
pub(crate) fn claimed(ready: &Ready) -> BTreeSet<String> {
    let mut ignored = Diagnostics::default();
    let all = check(&ready.file, &ready.loaded.graph, &|_| true, &mut ignored);
    let golden = all.iter().filter(|tapped| tapped.golden.is_some());
    let names = golden.flat_map(|tapped| {
        let class = ready.plan.planned(tapped.port).map(|port| ready.plan.ports[port].class);
        let name = move |frame: &u32| Some(golden::file_name(&ready.key(&tapped.name, *frame), class?));
        ready.file.frames.iter().filter_map(name)
    });
    names.collect()
}

/// The passes of a plan, in order.
fn passes(plan: &Plan) -> Vec<PassOutcome> {
    let reads = |pass| {
        let sources = plan.sources(pass).iter().flatten();
        let from: BTreeSet<Handle<PlannedPass>> = sources.filter_map(|source| plan.ports[*source].pass).collect();
        from.into_iter().map(|pass| plan.pass_name(pass).to_owned()).collect()
    };
    let pass = |pass| PassOutcome {
        name: plan.pass_name(pass).to_owned(),
        kind: plan.descriptor(pass).name.clone(),
        reads: reads(pass),
        bytes: plan.outputs_of(pass).map(|port| plan.resource(port).bytes()).sum(),
        microseconds: None,
    };
    plan.passes.handles().map(pass).collect()
}
