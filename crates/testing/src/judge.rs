//! What was rendered, held against everything that a test says, and whose fault it is where that does not hold.

use std::collections::BTreeMap;

use tyndall_graph::descriptor::ParamValue;
use tyndall_graph::{ParamSetting, Plan, PortRef};
use tyndall_image::Image;
use tyndall_plugin::{ReferenceInput, Registry};
use tyndall_render::Loaded;

use crate::adapter::AdapterClass;
use crate::answers::Answers;
use crate::file::{Property, Tapped};
use crate::golden;
use crate::metric::Judgement;
use crate::options::Options;
use crate::outcome::{Check, GOLDEN, Outcome, PortOutcome, State};
use crate::picture::Picture;
use crate::property;
use crate::run::{Ready, find, inputs_of};
use crate::session::{Rendered, moment};

/// Holds ports against what a test says of them.
pub(crate) struct Judge<'a> {
    pub ready: &'a Ready,
    pub options: &'a Options,
    pub adapter: AdapterClass,
    pub answers: &'a Answers,
}

impl Judge<'_> {
    /// Every tapped port of a frame, in the order in which the passes run.
    pub fn frame(&self, rendered: &Rendered) -> Vec<PortOutcome> {
        self.ready.tapped.iter().map(|tapped| self.port(tapped, rendered)).collect()
    }

    /// One port of a frame.
    pub fn port(&self, tapped: &Tapped, rendered: &Rendered) -> PortOutcome {
        let graph = &self.ready.loaded.graph;
        let pass = graph.pass(tapped.port.pass);
        let mut outcome = PortOutcome {
            name: tapped.name.clone(),
            pass: pass.name.clone(),
            kind: pass.descriptor().name.clone(),
            frame: rendered.frame,
            key: self.ready.key(&tapped.name, rendered.frame),
            checks: Vec::new(),
            state: State::Passed,
            stale: Vec::new(),
            actual: rendered.picture(&self.ready.plan, tapped.port),
            expected: None,
            metric: tapped.golden.as_ref().map(|golden| golden.metric(self.adapter)),
        };
        let Some(actual) = outcome.actual.clone() else {
            outcome.checks.push(Check::new("rendered", Judgement::failed("it was not rendered".to_owned())));
            return outcome;
        };
        let with_goldens = !self.options.without_goldens && self.options.size.is_none();
        if with_goldens {
            self.golden(tapped, rendered, &actual, &mut outcome);
            self.reference(tapped, &actual, &mut outcome);
        }
        let of_any_size =
            |property: &&Property| self.options.size.is_none() || !matches!(property, Property::Mean { .. });
        for property in tapped.properties.iter().filter(of_any_size) {
            outcome.checks.push(self.property(property, tapped, &actual, rendered));
        }
        outcome
    }

    fn golden(&self, tapped: &Tapped, rendered: &Rendered, actual: &Picture, outcome: &mut PortOutcome) {
        let Some(golden) = &tapped.golden else { return };
        let records = &self.ready.records;
        let made_from = rendered.made_from.get(&tapped.port).copied().flatten();
        if let Some(record) = records.get(&outcome.key) {
            outcome.stale = record.stale(made_from.as_ref());
        }
        let thinned = actual.thinned();
        let actual = outcome.actual.insert(thinned);
        let judgement = match golden::read(&self.ready.file.goldens(), &outcome.key, records, actual) {
            Ok(expected) => {
                let judgement = golden.metric(self.adapter).judge(actual, &expected);
                outcome.expected = Some(expected);
                judgement
            }
            Err(missing) => Judgement::failed(missing.to_string()),
        };
        outcome.checks.push(Check::new(GOLDEN, judgement));
    }

    fn reference(&self, tapped: &Tapped, actual: &Picture, outcome: &mut PortOutcome) {
        let Some(reference) = &tapped.reference else { return };
        let what = format!("reference ({})", reference.provenance);
        let judgement = match tyndall_image::read(&reference.file) {
            Ok(image) => {
                let wanted = actual.compared().channels;
                let expected = Picture::new(image.first_channels(wanted), actual.class);
                reference.metric.judge(&Picture::new(actual.compared(), actual.class), &expected)
            }
            Err(error) => Judgement::failed(error.to_string()),
        };
        outcome.checks.push(Check::new(&what, judgement));
    }

    fn property(&self, property: &Property, tapped: &Tapped, actual: &Picture, rendered: &Rendered) -> Check {
        let graph = &self.ready.loaded.graph;
        let other = |name: &str| rendered.picture(&self.ready.plan, find(graph, name)?);
        let computed = || self.computed(tapped, actual, rendered);
        let judgement = property::judge(property, actual, &other, &computed);
        let ports = property.ports().iter().filter_map(|name| find(graph, name));
        let also_on = ports.map(|port| graph.pass(port.pass).name.clone()).collect();
        Check { what: property::name(property), judgement, also_on }
    }

    fn computed(&self, tapped: &Tapped, actual: &Picture, rendered: &Rendered) -> Result<Picture, String> {
        let Ready { plan, registry, loaded, .. } = self.ready;
        Computing { plan, registry, loaded, answers: self.answers }.port(tapped.port, actual, rendered)
    }
}

/// What is asked of references on the CPU.
pub(crate) struct Computing<'a> {
    pub plan: &'a Plan,
    pub registry: &'a Registry,
    pub loaded: &'a Loaded,
    pub answers: &'a Answers,
}

impl Computing<'_> {
    /// What the pass's reference on the CPU makes of the inputs that the pass was given.
    pub fn port(&self, port: PortRef, actual: &Picture, rendered: &Rendered) -> Result<Picture, String> {
        self.answers.timed(|| self.ask(port, actual, rendered))
    }

    fn ask(&self, port: PortRef, actual: &Picture, rendered: &Rendered) -> Result<Picture, String> {
        let plan = self.plan;
        let position = plan.position(port.pass).ok_or("the pass does not run")?;
        let descriptor = plan.descriptor(position);
        let registered = self.registry.pass(&descriptor.name).and_then(|pass| pass.reference);
        let reference = registered.ok_or_else(|| format!("`{}` has no reference on the CPU", descriptor.name))?;
        let mut inputs = BTreeMap::new();
        for (index, from) in inputs_of(plan, port.pass) {
            let name = descriptor.ports[index].name.as_str();
            let data =
                rendered.ports.get(&from).ok_or_else(|| format!("what is fed into `{name}` was not rendered"))?;
            inputs.insert(name, data.as_ref());
        }
        let resources = descriptor
            .ports
            .iter()
            .zip(plan.bindings(position))
            .filter_map(|(port, slot)| Some((port.name.as_str(), plan.slots[(*slot)? as usize].resource)));
        let frame = rendered.frame;
        let value = |setting: &ParamSetting| match setting {
            ParamSetting::Value(value) => value.clone(),
            ParamSetting::Frame => ParamValue::Float(f64::from(frame)),
            ParamSetting::Time => ParamValue::Float(f64::from(frame) / tyndall_gpu::FRAMES_PER_SECOND),
        };
        let params = descriptor.params.iter().zip(plan.params(position));
        let (time, aspect) = moment(plan, frame);
        let scene = self.loaded.scene.as_ref();
        let reads_triangles = descriptor.scene.iter().any(|name| name == "triangles");
        let surfaces = scene.filter(|_| reads_triangles).map(|scene| scene.surfaces(time));
        let scene = scene.map(|scene| scene.twin(time, aspect));
        let input = ReferenceInput {
            inputs,
            resources: resources.collect(),
            params: params.map(|(param, setting)| (param.name.as_str(), value(setting))).collect(),
            scene: scene.as_ref(),
            surfaces: surfaces.as_ref(),
        };
        let answer = self.answers.of(&descriptor.name, reference, &input);
        let outputs = answer.as_ref().as_ref().map_err(String::clone)?;
        let port = &self.loaded.graph.port(port).name;
        let data = outputs.get(port.as_str()).ok_or_else(|| format!("the reference says nothing of `{port}`"))?.clone();
        if data.len() != actual.image.data.len() {
            return Err(format!(
                "the reference gives {} numbers, and the port holds {}",
                data.len(),
                actual.image.data.len()
            ));
        }
        Ok(actual.with(Image { data, ..actual.image }))
    }
}

impl Check {
    pub(crate) fn new(what: &str, judgement: Judgement) -> Self {
        Self { what: what.to_owned(), judgement, also_on: Vec::new() }
    }
}

/// Says whose fault each failure is: that of the first pass which fails though all that it reads holds. What depends on
/// a pass that fails is inherited. A check that names other passes falls with these; a relation is weighed like a check.
pub(crate) fn attribute(plan: &Plan, outcome: &mut Outcome) {
    let mut blame = Blame::new(plan);
    for port in &outcome.ports {
        let failed = || port.checks.iter().filter(|check| !check.judgement.passed);
        blame.failing(&port.pass, failed().any(|check| check.also_on.is_empty()));
    }
    for relation in outcome.relations.iter().filter(|relation| !relation.judgement.passed) {
        blame.failing(&relation.pass, true);
    }
    // Only now is it known what a check about other passes falls with; a pass that nothing excuses fails by itself.
    for port in outcome.ports.iter().filter(|port| !port.passed()) {
        let mut failed = port.checks.iter().filter(|check| !check.judgement.passed);
        let excused = failed.all(|check| blame.falls_with(&port.pass, &check.also_on));
        blame.failing(&port.pass, !excused);
    }
    for port in outcome.ports.iter_mut().filter(|port| !port.passed()) {
        let mut failed = port.checks.iter().filter(|check| !check.judgement.passed);
        let excused = failed.all(|check| blame.falls_with(&port.pass, &check.also_on));
        port.state = if excused { State::Inherited } else { State::Guilty };
    }
    for relation in outcome.relations.iter_mut().filter(|relation| !relation.judgement.passed) {
        let excused = blame.falls_with(&relation.pass, &[]);
        relation.state = if excused { State::Inherited } else { State::Guilty };
    }
}

/// Which passes of a plan fail by themselves.
struct Blame<'a> {
    plan: &'a Plan,
    upstream: Vec<std::collections::BTreeSet<usize>>,
    failing: Vec<bool>,
}

impl<'a> Blame<'a> {
    fn new(plan: &'a Plan) -> Self {
        Self { plan, upstream: crate::run::upstream(plan), failing: vec![false; plan.passes.len()] }
    }

    fn position(&self, name: &str) -> Option<usize> {
        (0..self.plan.passes.len()).find(|pass| self.plan.pass_name(*pass as u32) == name)
    }

    fn failing(&mut self, pass: &str, fails: bool) {
        if let Some(position) = self.position(pass) {
            self.failing[position] |= fails;
        }
    }

    /// Whether something upstream of a pass fails, or one of these others, or something upstream of one.
    fn falls_with(&self, pass: &str, also_on: &[String]) -> bool {
        let Some(pass) = self.position(pass) else { return false };
        let others = also_on.iter().filter_map(|name| self.position(name)).filter(|other| *other != pass);
        let involved = others.flat_map(|other| self.upstream[other].iter().copied().chain([other]));
        self.upstream[pass].iter().copied().chain(involved).any(|other| other != pass && self.failing[other])
    }
}
