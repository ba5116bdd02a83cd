//! What each result of a plan was made from, as numbers.
//!
//! One recursion over a plan serves everybody who asks whether two results are the same: results that are kept from frame
//! to frame, results that tests share, what references on the CPU are asked, goldens and what they are recorded with.
//! The numbers of a pass are the same in every plan that holds it and the passes upstream of it, whatever else that plan
//! holds, in every process and on every machine.

use std::collections::{BTreeMap, BTreeSet};

use crate::descriptor::{ParamValue, PassDescriptor};
use crate::digest::Digest;
use crate::graph::{ParamSetting, Values};
use crate::handle::{Handle, Table};
use crate::plan::{Plan, PlannedPass, PlannedPort, Resource, SlotKind};

/// What a pass and all passes upstream of it compute from, in four parts that change for different reasons.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub struct MadeFrom {
    /// Kinds of passes, revisions of those in Rust, connections, sizes and formats.
    pub graph: u64,
    /// What the shaders do.
    pub shaders: u64,
    /// Values of parameters, and the content of files that they name.
    pub parameters: u64,
    /// The scene data that are read.
    pub scene: u64,
}

impl MadeFrom {
    /// The parts by name, in order.
    pub fn parts(&self) -> [(&'static str, u64); 4] {
        [("graph", self.graph), ("shaders", self.shaders), ("parameters", self.parameters), ("scene", self.scene)]
    }

    /// The names of the parts that differ.
    pub fn changed(&self, other: &Self) -> Vec<&'static str> {
        let pairs = self.parts().into_iter().zip(other.parts());
        pairs.filter(|(a, b)| a != b).map(|(a, _)| a.0).collect()
    }
}

/// What the results of a pass were made from.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Origin {
    /// Of a pass that depends on frames before: its own frame's scene and parameters, and the passes that wrote what it
    /// remembers.
    pub made_from: MadeFrom,
    /// It depends on frames before.
    pub remembers: bool,
    /// It, or a pass upstream, does something beside writing its ports.
    pub has_side_effect: bool,
}

impl Origin {
    /// What its results are known by; `None` where one may differ from another that was made from the same.
    pub fn repeatable(&self) -> Option<MadeFrom> {
        (!self.remembers && !self.has_side_effect).then_some(self.made_from)
    }
}

/// The origins of all passes of a plan, in one frame after the other.
#[derive(Debug, Clone)]
pub struct Provenance {
    /// Of a pass without those upstream.
    own: Table<PlannedPass, MadeFrom>,
    origins: Table<PlannedPass, Origin>,
    /// What the passes were made from that wrote what is remembered, as far as that is followed: once around.
    remembered: Table<PlannedPass, MadeFrom>,
    /// Names of scene data, sorted; and which of them each pass reads.
    scene: Vec<String>,
    reads: Table<PlannedPass, Vec<usize>>,
    /// Digests of the files that parameters name.
    files: BTreeMap<String, u64>,
}

impl Provenance {
    /// Of a plan, whose passes (`plugin.pass`) have shaders that do what `shaders` stands for; `file` gives a digest of the
    /// content of a file that a parameter names. Nothing is known of a frame before [`Provenance::update`].
    pub fn new(plan: &Plan, shaders: &dyn Fn(&str) -> u64, file: &dyn Fn(&str) -> u64) -> Self {
        let descriptors = || plan.passes.handles().map(|pass| plan.descriptor(pass));
        let scene: BTreeSet<&String> = descriptors().flat_map(|descriptor| &descriptor.scene).collect();
        let number = |name: &String| scene.iter().position(|known| *known == name).unwrap_or_default();
        let reads = descriptors().map(|descriptor| descriptor.scene.iter().map(number).collect()).collect();
        let own = plan.passes.handles().map(|pass| MadeFrom {
            graph: wiring(plan, pass),
            shaders: shaders(&plan.descriptor(pass).name),
            ..MadeFrom::default()
        });
        Self {
            own: own.collect(),
            origins: plan.passes.column(Origin::default()),
            remembered: plan.passes.column(MadeFrom::default()),
            scene: scene.into_iter().cloned().collect(),
            reads,
            files: files(plan).map(|path| (path.clone(), file(path))).collect(),
        }
    }

    /// Names of the scene data that some pass reads: [`Provenance::update`] asks for their versions by index.
    pub fn scene(&self) -> &[String] {
        &self.scene
    }

    /// Follows a frame, in which parameters have these values and scene data these versions. Allocates nothing.
    pub fn update(&mut self, plan: &Plan, values: &Table<PlannedPass, Values>, version: impl Fn(usize) -> u64) {
        for pass in plan.passes.handles() {
            self.own[pass].parameters = self.parameters(plan.descriptor(pass), &values[pass]);
            self.own[pass].scene = self.scene_of(pass, &version);
        }
        // What is remembered was made by passes that stand later, and from what they remember: first each by itself.
        self.remembered.fill(MadeFrom::default());
        self.follow(plan);
        if self.origins.iter().any(|origin| origin.remembers) {
            for pass in plan.passes.handles() {
                self.remembered[pass] = self.origins[pass].made_from;
            }
            self.follow(plan);
        }
    }

    /// What the results of a pass were made from.
    pub fn of(&self, pass: Handle<PlannedPass>) -> &Origin {
        &self.origins[pass]
    }

    /// The origins of all passes.
    pub fn origins(&self) -> &Table<PlannedPass, Origin> {
        &self.origins
    }

    /// What a pass computes from by itself, without those upstream.
    pub fn own(&self, pass: Handle<PlannedPass>) -> MadeFrom {
        self.own[pass]
    }

    fn parameters(&self, descriptor: &PassDescriptor, values: &Values) -> u64 {
        let mut digest = Digest::default();
        for (param, value) in descriptor.params.iter().zip(values) {
            digest.text(&param.name);
            match value {
                ParamValue::Bool(on) => digest.number(u64::from(*on)),
                ParamValue::Integer(number) => digest.number(*number as u64),
                ParamValue::Float(number) => digest.number(number.to_bits()),
                ParamValue::Vector(numbers) => numbers.iter().for_each(|number| digest.number(number.to_bits())),
                ParamValue::Choice(word) => digest.text(word),
                ParamValue::File(path) => digest.number(self.files.get(path).copied().unwrap_or_default()),
            }
        }
        digest.finish()
    }

    fn scene_of(&self, pass: Handle<PlannedPass>, version: impl Fn(usize) -> u64) -> u64 {
        let mut digest = Digest::default();
        for index in &self.reads[pass] {
            digest.text(&self.scene[*index]);
            digest.number(version(*index));
        }
        digest.finish()
    }

    /// Every pass with those upstream.
    fn follow(&mut self, plan: &Plan) {
        for pass in plan.passes.handles() {
            let mut digests = Digests::default();
            digests.add(&self.own[pass]);
            let mut origin = Origin { has_side_effect: plan.descriptor(pass).side_effect, ..Origin::default() };
            for port in histories(plan, pass) {
                origin.remembers = true;
                if let Some(producer) = plan.ports[port].pass {
                    digests.add(&self.remembered[producer]);
                }
            }
            for producer in plan.sources(pass).iter().flatten().filter_map(|port| plan.ports[*port].pass) {
                let upstream = &self.origins[producer];
                origin.remembers |= upstream.remembers;
                origin.has_side_effect |= upstream.has_side_effect;
                digests.add(&upstream.made_from);
            }
            self.origins[pass] = Origin { made_from: digests.finish(), ..origin };
        }
    }
}

/// A [`MadeFrom`] in the making.
#[derive(Default)]
struct Digests {
    graph: Digest,
    shaders: Digest,
    parameters: Digest,
    scene: Digest,
}

impl Digests {
    fn add(&mut self, made_from: &MadeFrom) {
        self.graph.number(made_from.graph);
        self.shaders.number(made_from.shaders);
        self.parameters.number(made_from.parameters);
        self.scene.number(made_from.scene);
    }

    fn finish(&self) -> MadeFrom {
        let Self { graph, shaders, parameters, scene } = self;
        MadeFrom {
            graph: graph.finish(),
            shaders: shaders.finish(),
            parameters: parameters.finish(),
            scene: scene.finish(),
        }
    }
}

/// What a plan says of a pass: its kind, what it is bound to, and which ports feed it.
fn wiring(plan: &Plan, pass: Handle<PlannedPass>) -> u64 {
    let descriptor = plan.descriptor(pass);
    let mut digest = Digest::default();
    digest.text(&descriptor.name);
    digest.number(u64::from(descriptor.revision));
    for ((port, slot), source) in descriptor.ports.iter().zip(plan.bindings(pass)).zip(plan.sources(pass)) {
        digest.text(&port.name);
        if let Some(slot) = slot.map(|slot| &plan.slots[slot]) {
            digest.text(&resource(&slot.resource));
            slot.initial().into_iter().flatten().for_each(|number| digest.number(u64::from(number.to_bits())));
        }
        let fed = source.map(|source| &plan.ports[source]);
        match fed {
            None => digest.text("no pass feeds it"),
            Some(fed) if fed.pass.is_none() => digest.text("a constant feeds it"),
            Some(fed) => digest.text(&plan.graph.port(fed.port).name),
        }
    }
    for port in histories(plan, pass) {
        digest.text(&plan.port_descriptor(port).name);
    }
    digest.finish()
}

/// The ports whose content of the frame before a pass reads.
fn histories(plan: &Plan, pass: Handle<PlannedPass>) -> impl Iterator<Item = Handle<PlannedPort>> + '_ {
    let slots = plan.bindings(pass).iter().flatten();
    slots.filter_map(|slot| match plan.slots[*slot].kind {
        SlotKind::History { of, .. } => Some(of),
        _ => None,
    })
}

/// The files that parameters of a plan's passes name.
fn files(plan: &Plan) -> impl Iterator<Item = &String> {
    let settings = plan.passes.handles().flat_map(|pass| plan.params(pass));
    settings.filter_map(|setting| match setting {
        ParamSetting::Value(ParamValue::File(path)) => Some(path),
        _ => None,
    })
}

/// As it stands in records for ever.
fn resource(resource: &Resource) -> String {
    match resource {
        Resource::Texture { dimension, format, width, height, depth_or_layers } => {
            format!("{dimension} {format} {width}x{height}x{depth_or_layers}")
        }
        Resource::Buffer { bytes, stride } => format!("{bytes} bytes by {stride}"),
    }
}
