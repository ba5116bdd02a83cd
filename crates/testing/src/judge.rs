//! What was rendered, held against everything that a test says.

use std::collections::{BTreeMap, BTreeSet};

use tyndall_graph::{Handle, Plan, PlannedPort, PortRef};
use tyndall_image::Image;
use tyndall_plugin::{ReferenceInput, Registry};
use tyndall_render::Loaded;

use crate::adapter::AdapterClass;
use crate::blame::Upstream;
use crate::cached_references::CachedReferences;
use crate::file::{Property, Tapped};
use crate::golden;
use crate::metric::Judgement;
use crate::options::Options;
use crate::outcome::{Check, GOLDEN, PortOutcome, Reach, State};
use crate::picture::Picture;
use crate::property;
use crate::run::{Ready, find, inputs_of};
use crate::session::{Rendered, moment};

/// Holds ports against what a test says of them.
pub(crate) struct Judge<'a> {
    pub ready: &'a Ready,
    pub options: &'a Options,
    pub adapter: AdapterClass,
    pub answers: &'a CachedReferences,
}

impl Judge<'_> {
    /// Every tapped port of a frame, in the order in which the passes run. Where only the first failure is wanted, ports that
    /// were made from one that fails are left out: nothing that they could say would change whose fault it is.
    pub fn frame(&self, rendered: &Rendered) -> Vec<PortOutcome> {
        let (plan, upstream) = (&self.ready.plan, Upstream::of(&self.ready.plan));
        let mut failing: BTreeSet<Handle<PlannedPort>> = BTreeSet::new();
        let mut outcomes = Vec::with_capacity(self.ready.tapped.len());
        for tapped in &self.ready.tapped {
            let position = plan.position(tapped.port.pass);
            let made_from = position.map(|position| upstream.ports(position));
            let inherits = || made_from.is_some_and(|ports| !ports.is_disjoint(&failing));
            if self.options.fail_fast && inherits() {
                continue;
            }
            let outcome = self.port(tapped, rendered);
            if outcome.fails_by_itself() {
                failing.extend(plan.planned(tapped.port));
            }
            outcomes.push(outcome);
        }
        outcomes
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
            let judgement = Judgement::failed("it was not rendered".to_owned());
            outcome.checks.push(Check::new("rendered", Reach::EveryNumber, judgement));
            return outcome;
        };
        let with_goldens = !self.options.without_goldens && !self.ready.resized;
        if with_goldens {
            self.golden(tapped, rendered, &actual, &mut outcome);
            self.reference(tapped, &actual, &mut outcome);
        }
        let of_any_size = |property: &&Property| !self.ready.resized || !matches!(property, Property::Mean { .. });
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
        let check = match golden::read(&self.ready.file.goldens(), &outcome.key, records, actual) {
            Ok(expected) => {
                let metric = golden.metric(self.adapter);
                let judgement = metric.judge(actual, &expected);
                outcome.expected = Some(expected);
                Check { by: Some(metric), ..Check::new(GOLDEN, Reach::EveryNumber, judgement) }
            }
            Err(missing) => Check::new(GOLDEN, Reach::Nothing, Judgement::failed(missing.to_string())),
        };
        outcome.checks.push(check);
    }

    fn reference(&self, tapped: &Tapped, actual: &Picture, outcome: &mut PortOutcome) {
        let Some(reference) = &tapped.reference else { return };
        let what = format!("reference ({})", reference.provenance);
        outcome.checks.push(match tyndall_image::read_exact(&reference.file) {
            Ok(image) => {
                let wanted = actual.compared().channels;
                let expected = Picture::new(golden::as_port(image.first_channels(wanted), actual.class), actual.class);
                let judgement = reference.metric.judge(&Picture::new(actual.compared(), actual.class), &expected);
                Check { by: Some(reference.metric), ..Check::new(&what, Reach::EveryNumber, judgement) }
            }
            Err(error) => Check::new(&what, Reach::Nothing, Judgement::failed(error.to_string())),
        });
    }

    fn property(&self, property: &Property, tapped: &Tapped, actual: &Picture, rendered: &Rendered) -> Check {
        let graph = &self.ready.loaded.graph;
        let other = |name: &str| rendered.picture(&self.ready.plan, find(graph, name)?);
        let computed = || self.computed(tapped, actual, rendered);
        let judgement = property::judge(property, actual, &other, &computed);
        let ports = property.ports().iter().filter_map(|name| find(graph, name));
        let also_on = ports.map(|port| graph.port_name(port)).collect();
        let by = property.metric();
        let reach = if by.is_some() { Reach::EveryNumber } else { Reach::Something };
        Check { also_on, by, ..Check::new(&property::name(property), reach, judgement) }
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
    pub answers: &'a CachedReferences,
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
            .filter_map(|(port, slot)| Some((port.name.as_str(), plan.slots[(*slot)?].resource)));
        let frame = rendered.frame;
        let params = descriptor.params.iter().zip(plan.params(position));
        let (time, aspect) = moment(plan, frame);
        let scene = self.loaded.scene.as_ref();
        let reads_triangles = descriptor.scene.iter().any(|name| name == "triangles");
        let surfaces = scene.filter(|_| reads_triangles).map(|scene| scene.surfaces(time));
        let moment = scene.map(|scene| scene.moment(time, aspect));
        let scene = scene.map(|scene| scene.twin(time, aspect));
        let input = ReferenceInput {
            inputs,
            resources: resources.collect(),
            params: params.map(|(param, setting)| (param.name.as_str(), setting.value(frame, time))).collect(),
            scene: scene.as_ref(),
            moment: moment.as_ref(),
            surfaces: surfaces.as_ref(),
        };
        let outputs = self.answers.of(&descriptor.name, reference, &input)?;
        let port = &self.loaded.graph.port(port).name;
        let data = outputs.get(port.as_str()).ok_or_else(|| format!("the reference says nothing of `{port}`"))?.exact();
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
    pub(crate) fn new(what: &str, reach: Reach, judgement: Judgement) -> Self {
        Self { what: what.to_owned(), judgement, reach, by: None, also_on: Vec::new() }
    }
}
