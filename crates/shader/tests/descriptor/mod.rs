//! The pass that the shaders of these tests belong to.

use tyndall_graph::descriptor::{
    Class, Dimension, Disabled, Format, ParamDescriptor, ParamType, ParamValue, PassDescriptor, PortDescriptor,
    PortKind, Role, SizeRule,
};

/// Names of scene data that there are.
pub const SCENE: &[&str] = &["camera", "lights", "medium"];

fn port(name: &str, role: Role, kind: PortKind) -> PortDescriptor {
    let size = role.is_output().then(|| SizeRule::frame(1.0));
    PortDescriptor { name: name.into(), about: String::new(), unit: String::new(), role, kind, size, unordered: false }
}

fn texture(dimension: Dimension, class: Class, format: Option<Format>, filtered: bool) -> PortKind {
    PortKind::Texture { dimension, class, format, filtered }
}

fn param(name: &str, default: ParamValue, fixed: bool) -> ParamDescriptor {
    let accepts = match default {
        ParamValue::Float(_) => ParamType::Float { range: None },
        _ => ParamType::Integer { range: None },
    };
    ParamDescriptor { name: name.into(), about: String::new(), unit: String::new(), accepts, default, fixed }
}

/// Two inputs, an output, a parameter of each sort, the camera.
pub fn descriptor() -> PassDescriptor {
    let output = || Role::Output { disabled: Disabled::Constant([0.0; 4]) };
    PassDescriptor {
        name: "test.pass".into(),
        about: String::new(),
        source: String::new(),
        ports: [
            port("depth", Role::Input, texture(Dimension::D2, Class::Scalar, None, false)),
            port("lights_found", Role::Input, PortKind::Buffer { element: "u32".into(), stride: 4 }),
            port("radiance", output(), texture(Dimension::D2, Class::Color, Some(Format::Rgba32Float), false)),
        ]
        .into(),
        params: [param("exposure", ParamValue::Float(1.0), false), param("nodes", ParamValue::Integer(12), true)]
            .into(),
        presets: Vec::new(),
        scene: vec!["camera".into()],
        side_effect: false,
        revision: 0,
    }
}
