//! What a port was made from, as numbers that change when it does.

use std::collections::BTreeMap;
use std::hash::{DefaultHasher, Hash, Hasher};

use tyndall_graph::descriptor::{ParamValue, Role};
use tyndall_graph::{ParamSetting, Plan};
use tyndall_plugin::Registry;
use tyndall_scene::Encoded;

/// What a pass and all passes upstream of it compute from, in four parts that change for different reasons.
///
/// The same in every plan that holds these passes, whatever else it holds, and in every process. A new toolchain may
/// hash differently: then goldens are stale without need, never fresh without right.
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

/// The fingerprints of a plan's passes by position; `None` for those that depend on a frame before.
pub(crate) fn fingerprints(
    plan: &Plan,
    registry: &Registry,
    scene: Option<&Encoded>,
    frame: u32,
) -> Vec<Option<Fingerprint>> {
    let mut found: Vec<Option<Fingerprint>> = Vec::with_capacity(plan.passes.len());
    for pass in 0..plan.passes.len() as u32 {
        let of_pass = of_pass(plan, registry, scene, frame, pass, &found);
        found.push(of_pass);
    }
    found
}

fn of_pass(
    plan: &Plan,
    registry: &Registry,
    scene: Option<&Encoded>,
    frame: u32,
    pass: u32,
    upstream: &[Option<Fingerprint>],
) -> Option<Fingerprint> {
    let descriptor = plan.descriptor(pass);
    if descriptor.side_effect || descriptor.ports.iter().any(|port| matches!(port.role, Role::History(_))) {
        return None;
    }
    let mut hashers: BTreeMap<&str, DefaultHasher> = BTreeMap::new();
    let mut hash = |part: &'static str, value: &dyn Fn(&mut DefaultHasher)| value(hashers.entry(part).or_default());
    hash("graph", &|to| {
        (&descriptor.name, descriptor.revision).hash(to);
        for binding in plan.bindings(pass) {
            let slot = binding.map(|slot| &plan.slots[slot as usize]);
            slot.map(|slot| slot.resource).hash(to);
            slot.and_then(|slot| slot.initial()).map(|value| value.map(f32::to_bits)).hash(to);
        }
    });
    hash("shaders", &|to| registry.pass(&descriptor.name).map_or(0, |pass| pass.fingerprint).hash(to));
    hash("parameters", &|to| {
        for setting in plan.params(pass) {
            match setting {
                ParamSetting::Value(ParamValue::File(path)) => std::fs::read(path).ok().hash(to),
                ParamSetting::Value(value) => value.to_string().hash(to),
                ParamSetting::Frame | ParamSetting::Time => frame.hash(to),
            }
        }
    });
    hash("scene", &|to| {
        for name in &descriptor.scene {
            (name, scene.map(|scene| scene.bytes(name))).hash(to);
        }
    });
    for source in plan.sources(pass).iter() {
        let from = match source.map(|source| &plan.ports[source as usize]) {
            Some(port) => match port.pass {
                Some(producer) => Some((upstream[producer as usize]?, port.port.port)),
                None => None,
            },
            None => None,
        };
        hash("graph", &|to| from.map(|(print, port)| (print.graph, port)).hash(to));
        hash("shaders", &|to| from.map(|(print, _)| print.shaders).hash(to));
        hash("parameters", &|to| from.map(|(print, _)| print.parameters).hash(to));
        hash("scene", &|to| from.map(|(print, _)| print.scene).hash(to));
    }
    let part = |name: &str| hashers.get(name).map_or(0, DefaultHasher::finish);
    Some(Fingerprint {
        graph: part("graph"),
        shaders: part("shaders"),
        parameters: part("parameters"),
        scene: part("scene"),
    })
}
