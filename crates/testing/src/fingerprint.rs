//! What a port was made from, as numbers that change when it does.

use tyndall_graph::descriptor::{ParamValue, Role};
use tyndall_graph::{ParamSetting, Plan, Resource};
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
    let [mut graph, mut shaders, mut parameters, mut scene_data] = [Digest::default(); 4];
    graph.text(&descriptor.name);
    graph.number(u64::from(descriptor.revision));
    for binding in plan.bindings(pass) {
        let slot = binding.map(|slot| &plan.slots[slot as usize]);
        graph.text(&slot.map_or(String::new(), |slot| resource(&slot.resource)));
        let initial = slot.and_then(|slot| slot.initial());
        initial.into_iter().flatten().for_each(|number| graph.number(u64::from(number.to_bits())));
    }
    shaders.number(registry.pass(&descriptor.name).map_or(0, |pass| pass.fingerprint));
    for setting in plan.params(pass) {
        match setting {
            ParamSetting::Value(ParamValue::File(path)) => parameters.bytes(&std::fs::read(path).unwrap_or_default()),
            ParamSetting::Value(value) => parameters.text(&value.to_string()),
            ParamSetting::Frame => parameters.text(&format!("frame {frame}")),
            ParamSetting::Time => parameters.text(&format!("time of frame {frame}")),
        }
    }
    for name in &descriptor.scene {
        scene_data.text(name);
        scene_data.bytes(scene.map_or(&[], |scene| scene.bytes(name)));
    }
    for source in plan.sources(pass) {
        let Some(port) = source.map(|source| &plan.ports[source as usize]) else {
            graph.text("nothing is fed");
            continue;
        };
        let Some(producer) = port.pass else {
            graph.text("a constant is fed");
            continue;
        };
        let print = upstream[producer as usize]?;
        graph.number(u64::from(port.port.port));
        graph.number(print.graph);
        shaders.number(print.shaders);
        parameters.number(print.parameters);
        scene_data.number(print.scene);
    }
    Some(Fingerprint {
        graph: graph.finish(),
        shaders: shaders.finish(),
        parameters: parameters.finish(),
        scene: scene_data.finish(),
    })
}

fn resource(resource: &Resource) -> String {
    match resource {
        Resource::Texture { dimension, format, width, height, depth_or_layers } => {
            format!("{dimension} {format} {width}x{height}x{depth_or_layers}")
        }
        Resource::Buffer { bytes, stride } => format!("{bytes} bytes by {stride}"),
    }
}
