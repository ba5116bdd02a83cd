//! What a port was made from, as numbers that change when it does.

use tyndall_graph::descriptor::ParamValue;
use tyndall_graph::{Handle, ParamSetting, Plan, PlannedPass, Resource, SlotKind, Table};
use tyndall_plugin::Registry;
use tyndall_scene::Encoded;

use crate::digest::Digest;

/// What a pass and all passes upstream of it compute from, in four parts that change for different reasons.
///
/// The same in every plan that holds these passes, whatever else it holds, in every process and on every machine.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub struct Fingerprint {
    /// Kinds of passes, revisions of those in Rust, connections, sizes and formats.
    pub graph: u64,
    /// Linked WGSL.
    pub shaders: u64,
    /// Values of parameters, and the files that they name.
    pub parameters: u64,
    /// Scene data that are read.
    pub scene: u64,
}

impl Fingerprint {
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

/// What a pass was made from.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Print {
    /// Of a pass that depends on frames before: its own frame's scene, and the passes that wrote what it remembers.
    pub made_from: Fingerprint,
    /// It depends on frames before.
    pub remembers: bool,
    /// It, or a pass before it, does something beside writing its ports.
    has_side_effect: bool,
}

impl Print {
    /// What its results are known by; `None` where one may differ from another of the same fingerprint.
    pub fn shared(&self) -> Option<Fingerprint> {
        (!self.remembers && !self.has_side_effect).then_some(self.made_from)
    }
}

/// What every pass of a plan was made from.
pub(crate) type Prints = Table<PlannedPass, Print>;

/// The fingerprints of a plan's passes.
pub(crate) fn fingerprints(plan: &Plan, registry: &Registry, scene: Option<&Encoded>, frame: u32) -> Prints {
    // What is remembered was made by passes that stand later, and from what they remember: first each by itself.
    let mut found = Prints::new();
    for _ in 0..2 {
        let before = std::mem::take(&mut found);
        for pass in plan.passes.handles() {
            found.push(of_pass(plan, registry, (scene, frame), pass, &found, &before));
        }
        if !found.iter().any(|print| print.remembers) {
            break;
        }
    }
    found
}

fn of_pass(
    plan: &Plan,
    registry: &Registry,
    (scene, frame): (Option<&Encoded>, u32),
    pass: Handle<PlannedPass>,
    upstream: &Prints,
    before: &Prints,
) -> Print {
    let descriptor = plan.descriptor(pass);
    let (mut remembers, mut has_side_effect) = (false, descriptor.side_effect);
    let mut digests = Digests::default();
    digests.graph.text(&descriptor.name);
    digests.graph.number(u64::from(descriptor.revision));
    for port in &descriptor.ports {
        digests.graph.text(&port.name);
    }
    for binding in plan.bindings(pass) {
        let slot = binding.map(|slot| &plan.slots[slot]);
        digests.graph.text(&slot.map_or(String::new(), |slot| resource(&slot.resource)));
        let initial = slot.and_then(|slot| slot.initial());
        initial.into_iter().flatten().for_each(|number| digests.graph.number(u64::from(number.to_bits())));
        if let Some(SlotKind::History { of, .. }) = slot.map(|slot| slot.kind) {
            remembers = true;
            let port = &plan.ports[of];
            digests.graph.number(port.port.port.index() as u64);
            if let Some(print) = port.pass.and_then(|pass| before.get(pass)) {
                digests.add(print.made_from);
            }
        }
    }
    digests.shaders.number(registry.pass(&descriptor.name).map_or(0, |pass| pass.fingerprint));
    for (param, setting) in descriptor.params.iter().zip(plan.params(pass)) {
        digests.parameters.text(&param.name);
        match setting {
            ParamSetting::Value(ParamValue::File(path)) => {
                digests.parameters.bytes(&std::fs::read(path).unwrap_or_default())
            }
            ParamSetting::Value(value) => digests.parameters.text(&value.to_string()),
            ParamSetting::Frame => digests.parameters.text(&format!("frame {frame}")),
            ParamSetting::Time => digests.parameters.text(&format!("time of frame {frame}")),
        }
    }
    for name in &descriptor.scene {
        digests.scene.text(name);
        digests.scene.bytes(scene.map_or(&[], |scene| scene.bytes(name)));
    }
    for source in plan.sources(pass) {
        let Some(port) = source.map(|source| &plan.ports[source]) else {
            digests.graph.text("nothing is fed");
            continue;
        };
        let Some(producer) = port.pass else {
            digests.graph.text("a constant is fed");
            continue;
        };
        let print = &upstream[producer];
        remembers |= print.remembers;
        has_side_effect |= print.has_side_effect;
        digests.graph.number(port.port.port.index() as u64);
        digests.add(print.made_from);
    }
    Print { made_from: digests.finish(), remembers, has_side_effect }
}

/// A fingerprint in the making.
#[derive(Default)]
struct Digests {
    graph: Digest,
    shaders: Digest,
    parameters: Digest,
    scene: Digest,
}

impl Digests {
    /// Of a pass that is read.
    fn add(&mut self, print: Fingerprint) {
        self.graph.number(print.graph);
        self.shaders.number(print.shaders);
        self.parameters.number(print.parameters);
        self.scene.number(print.scene);
    }

    fn finish(&self) -> Fingerprint {
        let Self { graph, shaders, parameters, scene } = self;
        Fingerprint {
            graph: graph.finish(),
            shaders: shaders.finish(),
            parameters: parameters.finish(),
            scene: scene.finish(),
        }
    }
}

fn resource(resource: &Resource) -> String {
    match resource {
        Resource::Texture { dimension, format, width, height, depth_or_layers } => {
            format!("{dimension} {format} {width}x{height}x{depth_or_layers}")
        }
        Resource::Buffer { bytes, stride } => format!("{bytes} bytes by {stride}"),
    }
}
