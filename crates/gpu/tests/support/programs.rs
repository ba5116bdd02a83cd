//! Passes of one dispatch, declared by hand: the registry of plugins stands above this crate.

use std::collections::HashMap;
use std::sync::Arc;

use tyndall_document::{Source, render_text};
use tyndall_gpu::{GpuError, Kernel, Program, Programs, Recorder, Setup};
use tyndall_graph::descriptor::{
    Class, Dimension, Disabled, Format, ParamDescriptor, ParamType, ParamValue, PassDescriptor, PortDescriptor,
    PortKind, Role, SizeRule,
};
use tyndall_graph::{Catalogue, Resource};
use tyndall_shader::{Library, Linked, link};

const SOURCE: &str = "
struct Params { value: f32 }
var<uniform> params: Params;
var color: texture_storage_2d<rgba32float, write>;
@compute @workgroup_size(8, 8) fn main(@builtin(global_invocation_id) id: vec3<u32>) {
    textureStore(color, id.xy, vec4(params.value));
}";

const STEP: &str = "
struct Params { factor: f32 }
var<uniform> params: Params;
var input: texture_2d<f32>;
var scaled: texture_storage_2d<rgba32float, write>;
@compute @workgroup_size(8, 8) fn main(@builtin(global_invocation_id) id: vec3<u32>) {
    textureStore(scaled, id.xy, params.factor * textureLoad(input, id.xy, 0));
}";

/// Needs a workgroup that no adapter offers; naga alone does not know that.
const GREEDY: &str = "
var color: texture_storage_2d<rgba32float, write>;
@compute @workgroup_size(1024, 64) fn main(@builtin(global_invocation_id) id: vec3<u32>) {
    textureStore(color, id.xy, vec4(1.0));
}";

/// The shaders of the passes, linked, by the passes' names.
pub struct Shaders(HashMap<&'static str, Arc<Linked>>);

pub fn shaders() -> Shaders {
    let linked = |(name, text): (&'static str, &str)| {
        let linked = link(&Source::new(format!("{name}.wgsl"), text), &Library::default());
        (name, Arc::new(linked.unwrap_or_else(|problems| panic!("{}", render_text(&problems, false)))))
    };
    Shaders([("test.source", SOURCE), ("test.step", STEP), ("test.greedy", GREEDY)].map(linked).into())
}

struct Dispatch(Kernel, [u32; 3]);

impl Program for Dispatch {
    fn record(&mut self, recorder: &mut Recorder<'_>) -> Result<(), GpuError> {
        recorder.dispatch(&mut self.0, self.1)
    }
}

impl Programs for Shaders {
    fn program(&self, setup: &mut Setup<'_>) -> Result<Box<dyn Program>, GpuError> {
        let descriptor = setup.pass.descriptor().clone();
        let output = descriptor.outputs().next().unwrap().name.clone();
        let size = match setup.pass.resource(setup.pass.port(&output)?) {
            Some(Resource::Texture { width, height, .. }) => [*width, *height, 1],
            _ => [1; 3],
        };
        Ok(Box::new(Dispatch(Kernel::new(setup, &self.0[descriptor.name.as_str()], "main")?, size)))
    }

    fn shaders(&self, pass: &str) -> u64 {
        self.0[pass].fingerprint
    }
}

/// What the passes declare.
pub fn catalogue() -> Catalogue {
    let source = pass("test.source", vec![output("color", SizeRule::frame(1.0))], Some("value"));
    let step = pass("test.step", vec![input("input"), output("scaled", SizeRule::same("input"))], Some("factor"));
    let greedy = pass("test.greedy", vec![output("color", SizeRule::frame(1.0))], None);
    let mut catalogue = Catalogue::new();
    for descriptor in [source, step, greedy] {
        catalogue.insert(Arc::new(descriptor)).unwrap();
    }
    catalogue
}

fn pass(name: &str, ports: Vec<PortDescriptor>, param: Option<&str>) -> PassDescriptor {
    let number = |name: &str| ParamDescriptor {
        name: name.to_owned(),
        about: "A number".to_owned(),
        unit: String::new(),
        accepts: ParamType::Float { range: None },
        default: ParamValue::Float(1.0),
        fixed: false,
    };
    PassDescriptor {
        name: name.to_owned(),
        about: "For tests.".to_owned(),
        source: String::new(),
        ports: ports.into(),
        params: param.map(number).into_iter().collect(),
        presets: Vec::new(),
        scene: Vec::new(),
        side_effect: false,
        revision: 0,
    }
}

fn port(name: &str, role: Role, format: Option<Format>, size: Option<SizeRule>) -> PortDescriptor {
    PortDescriptor {
        name: name.to_owned(),
        about: "A picture".to_owned(),
        unit: String::new(),
        role,
        kind: PortKind::Texture { dimension: Dimension::D2, class: Class::Color, format, filtered: false },
        size,
        unordered: false,
    }
}

fn input(name: &str) -> PortDescriptor {
    port(name, Role::Input, None, None)
}

fn output(name: &str, size: SizeRule) -> PortDescriptor {
    port(name, Role::Output { disabled: Disabled::Constant([0.0; 4]) }, Some(Format::Rgba32Float), Some(size))
}
