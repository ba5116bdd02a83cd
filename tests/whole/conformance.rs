//! What holds of every pass that ships.

use std::collections::BTreeMap;
use std::path::Path;

use crate::support::{LIGHTS, content, executor, gpu, planned, registry, run_all, scene, set_scene};
use tempfile::TempDir;
use tyndall_document::is_name;
use tyndall_graph::Roots;
use tyndall_graph::descriptor::{
    Class, Dimension, ParamDescriptor, ParamValue, PassDescriptor, PortDescriptor, PortKind, Role,
};
use tyndall_plugin::Registry;

#[test]
fn every_pass_says_what_it_is() {
    let registry = registry(&[]);
    assert!(registry.passes().count() >= 10);
    for pass in registry.passes() {
        let descriptor = &pass.descriptor;
        let name = &descriptor.name;
        assert!(is_sentence(&descriptor.about), "{name}: {:?}", descriptor.about);
        assert!(is_sentence(&pass.plugin_about), "{name}: {:?}", pass.plugin_about);
        assert!(descriptor.scene.is_sorted(), "{name}: scene data are sorted");
        assert!(descriptor.outputs().next().is_some() || descriptor.side_effect, "{name} does nothing");
        for port in &descriptor.ports {
            assert!(!port.about.is_empty(), "{name}.{} is not documented", port.name);
            assert!(is_name(&port.name), "{name}.{}", port.name);
        }
        for preset in &descriptor.presets {
            assert!(!preset.about.is_empty(), "{name}: the preset {} is not documented", preset.name);
        }
        for param in &descriptor.params {
            assert!(!param.about.is_empty(), "{name}.{} is not documented", param.name);
            assert!(is_name(&param.name), "{name}.{}", param.name);
            assert!(is_in_range(param), "{name}.{}: its default is out of its range", param.name);
        }
    }
}

/// Two ports of one name and meaning have one unit, or any picture would do.
#[test]
fn the_same_quantity_has_the_same_unit() {
    let registry = registry(&[]);
    let ports = || registry.passes().flat_map(|pass| &pass.descriptor.ports);
    for (name, unit) in [("depth", "m"), ("airlight", "W/(sr m^2)"), ("radiance", "W/(sr m^2)")] {
        assert!(ports().any(|port| port.name == name), "no port `{name}` any more");
        assert!(ports().all(|port| port.name != name || port.unit == unit), "a port `{name}` is not in {unit}");
    }
}

#[test]
fn every_pass_renders_over_garbage_without_nan() {
    let (gpu, registry, scene) = (gpu(), registry(&[]), scene(LIGHTS));
    let folder = TempDir::new().unwrap();
    let picture = folder.path().join("picture.npy");
    std::fs::write(&picture, npy()).unwrap();
    for pass in registry.passes() {
        let text = graph(&registry, &pass.descriptor, &picture);
        let plan = planned(&registry, &text, |_, options| options.roots = Roots::All);
        let mut executor = executor(&gpu, &registry, plan);
        set_scene(&mut executor, &scene, 0.0);
        executor.poison(f32::NAN).unwrap();
        run_all(&mut executor);
        for port in pass.descriptor.outputs() {
            let name = format!("tested.{}", port.name);
            let data = content(&executor, &name).floats();
            assert!(!data.is_empty() && data.iter().all(|number| !number.is_nan()), "{} in {text}", port.name);
        }
    }
}

/// The test of the test: what nobody writes stays NaN.
#[test]
fn garbage_is_seen() {
    let registry = crate::support::with_plugin(
        "t",
        &[
            (
                "plugin.ron",
                r#"(name: "t", version: "0.1.0", about: "For tests.", passes: {
            "p": (about: "Half a picture.", shader: "p.wgsl", ports: { "color": (about: "Half", size: Frame(1.0)) }) })"#,
            ),
            (
                "p.wgsl",
                "var color: texture_storage_2d<rgba32float, write>;
            @compute @workgroup_size(8, 8) fn main(@builtin(global_invocation_id) id: vec3<u32>) {
                if id.x < 2 { textureStore(color, id.xy, vec4(1.0)); }
            }",
            ),
        ],
    );
    let text = r#"(version: 1, size: (4, 3), passes: { "p": (use: "t.p") }, outputs: { "color": "p.color" })"#;
    let mut executor = executor(&gpu(), &registry, planned(&registry, text, |_, _| ()));
    executor.poison(f32::NAN).unwrap();
    run_all(&mut executor);
    assert_eq!(content(&executor, "color").floats().iter().filter(|number| number.is_nan()).count(), 2 * 3 * 4);
}

fn is_sentence(text: &str) -> bool {
    text.ends_with('.') && text.starts_with(|c: char| c.is_uppercase())
}

fn is_in_range(param: &ParamDescriptor) -> bool {
    let within = |number: f64| param.accepts.range().is_none_or(|(low, high)| (low..=high).contains(&number));
    match &param.default {
        ParamValue::Integer(number) => within(*number as f64),
        ParamValue::Float(number) => within(*number),
        ParamValue::Vector(numbers) => numbers.iter().all(|number| within(*number)),
        ParamValue::Choice(word) => param.accepts.choices().contains(word),
        ParamValue::Bool(_) | ParamValue::File(_) => true,
    }
}

/// Texels on a side of a table.
const SMALL_TABLE: f64 = 24.0;

/// The pass as `tested`, all its inputs fed: from a geometry buffer's port of the same name, from passes that make what
/// only they make (values, tables, volumes), or else with a colour.
fn graph(registry: &Registry, descriptor: &PassDescriptor, picture: &Path) -> String {
    let mut passes = BTreeMap::new();
    add(registry, "tested", descriptor, picture, &mut passes);
    format!(
        "(version: 1, size: (4, 3), passes: {{
            \"surfaces\": (use: \"core.gbuffer\"),
            \"colour\": (use: \"core.constant\", params: {{ \"value\": (0.1, 2.0, 30.0) }}),
            {}
        }}, outputs: {{ \"one\": \"tested.{}\" }})",
        passes.into_values().collect::<String>(),
        descriptor.outputs().next().expect("a pass has an output").name,
    )
}

/// Adds a pass and those that its inputs need, by name.
fn add(
    registry: &Registry,
    name: &str,
    descriptor: &PassDescriptor,
    picture: &Path,
    passes: &mut BTreeMap<String, String>,
) {
    let mut inputs = Vec::new();
    for port in descriptor.inputs() {
        assert!(!matches!(port.role, Role::History(_)), "feed the history of {}", port.name);
        let source = match (port.name.as_str(), &port.kind) {
            ("depth" | "normal" | "material" | "triangle", _) => format!("surfaces.{}", port.name),
            (_, PortKind::Texture { dimension: Dimension::D2, class, .. }) if *class != Class::Data => {
                "colour.color".to_owned()
            }
            _ => {
                let (maker, made) = maker(registry, port);
                let maker_name = maker.name.replace('.', "_");
                if !passes.contains_key(&maker_name) {
                    add(registry, &maker_name, maker, picture, passes);
                }
                format!("{maker_name}.{made}")
            }
        };
        inputs.push(format!("\"{}\": {source:?}", port.name));
    }
    let params = descriptor.params.iter().filter_map(|param| match &param.default {
        ParamValue::File(_) => Some(format!("\"{}\": {:?}", param.name, picture.display().to_string())),
        // a small table is made as a large one is
        ParamValue::Integer(_) if param.name == "size" => {
            let least = param.accepts.range().map_or(SMALL_TABLE, |(low, _)| SMALL_TABLE.max(low));
            Some(format!("\"size\": {least}"))
        }
        _ => None,
    });
    let params = params.collect::<Vec<_>>().join(", ");
    let text = format!(
        "{name:?}: (use: {:?}, inputs: {{ {} }}, params: {{ {} }}),\n",
        descriptor.name,
        inputs.join(", "),
        params
    );
    passes.insert(name.to_owned(), text);
}

/// A pass that makes such things, and its output: by the same name if there is one, and of fewest inputs.
fn maker<'a>(registry: &'a Registry, wanted: &PortDescriptor) -> (&'a PassDescriptor, &'a str) {
    let alike = |port: &PortDescriptor| match (&port.kind, &wanted.kind) {
        (PortKind::Value { element, .. }, PortKind::Value { element: other, .. }) => element == other,
        (PortKind::Texture { dimension, class, .. }, PortKind::Texture { dimension: other, class: meant, .. }) => {
            dimension == other && class == meant
        }
        _ => false,
    };
    let outputs = registry.passes().flat_map(|pass| pass.descriptor.outputs().map(|port| (&*pass.descriptor, port)));
    let made = outputs.filter(|(_, port)| matches!(port.role, Role::Output { .. }) && alike(port));
    let best = made.min_by_key(|(pass, port)| (port.name != wanted.name, pass.inputs().count()));
    let (pass, port) = best.unwrap_or_else(|| panic!("no pass makes what `{}` reads", wanted.name));
    (pass, &port.name)
}

/// A picture of 4 by 3 texels with three channels, all 0.5.
fn npy() -> Vec<u8> {
    let header = format!("{:<117}\n", "{'descr': '<f4', 'fortran_order': False, 'shape': (3, 4, 3), }");
    let mut bytes = b"\x93NUMPY\x01\x00".to_vec();
    bytes.extend((header.len() as u16).to_le_bytes());
    bytes.extend(header.as_bytes());
    bytes.extend(0.5_f32.to_le_bytes().repeat(36));
    bytes
}
