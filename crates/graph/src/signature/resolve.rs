//! From the names in a port's descriptor to handles.

use super::{Amount, DescriptorError, PortSignature, RoleKind, Rule};
use crate::descriptor::{
    Class, Dimension, Disabled, Extent, ParamDescriptor, ParamType, PassDescriptor, PortDescriptor, PortKind, Role,
    SizeRule,
};
use crate::handle::Handle;

/// A port with its names resolved; mistakes are added to `errors`.
pub(super) fn resolve(
    descriptor: &PassDescriptor,
    port: &PortDescriptor,
    errors: &mut Vec<DescriptorError>,
) -> PortSignature {
    let (role, constant) = match &port.role {
        Role::Input => (RoleKind::Input, [0.0; 4]),
        Role::Optional(value) => (RoleKind::Optional, *value),
        Role::History(value) => (RoleKind::History, *value),
        Role::Output { disabled: Disabled::Constant(value) } => (RoleKind::Output, *value),
        Role::Output { disabled: Disabled::Input(_) } => (RoleKind::Output, [0.0; 4]),
        Role::InOut => (RoleKind::InOut, [0.0; 4]),
    };
    PortSignature {
        role,
        rule: port.size.as_ref().map(|rule| indexed(descriptor, port, rule, errors)),
        like: like(descriptor, port, errors),
        through: through(descriptor, port, errors),
        constant,
        axes: axes(&port.kind),
    }
}

fn indexed(
    descriptor: &PassDescriptor,
    port: &PortDescriptor,
    rule: &SizeRule,
    errors: &mut Vec<DescriptorError>,
) -> Rule {
    let amounts = [&rule.width, &rule.height, &rule.depth].map(|extent| amount(descriptor, port, extent, errors));
    match amounts[0] {
        _ if *rule == SizeRule::frame(1.0) => Rule::Frame,
        Amount::Port(other, ..) if *rule == SizeRule::same(&descriptor.ports[other].name) => Rule::Same(other),
        _ => Rule::Other(amounts),
    }
}

fn amount(
    descriptor: &PassDescriptor,
    port: &PortDescriptor,
    extent: &Extent,
    errors: &mut Vec<DescriptorError>,
) -> Amount {
    let name = || port.name.clone();
    let mut scale_of = |scale: f64| {
        errors.extend((!(scale > 0.0 && scale.is_finite())).then(|| DescriptorError::BadScale { port: name() }));
        scale
    };
    match extent {
        Extent::Fixed(0) => {
            errors.push(DescriptorError::ZeroSize { port: name() });
            Amount::Fixed(1)
        }
        Extent::Fixed(texels) => Amount::Fixed(*texels),
        Extent::Frame { axis, scale } => Amount::Frame(*axis, scale_of(*scale)),
        Extent::FramePixels(scale) => Amount::FramePixels(scale_of(*scale)),
        Extent::Port { port: named, axis, scale } => {
            let scale = scale_of(*scale);
            match descriptor.port_named(named) {
                Some(other) if matches!(descriptor.ports[other].role, Role::History(_)) => {
                    errors.push(DescriptorError::HistorySize { port: name(), named: named.clone() });
                    Amount::Fixed(1)
                }
                Some(other) => Amount::Port(other, *axis, scale),
                None => {
                    errors.push(DescriptorError::UnknownSizePort { port: name(), named: named.clone() });
                    Amount::Fixed(1)
                }
            }
        }
        Extent::Picture { param: named, axis } => {
            let is_file = |param: &Handle<ParamDescriptor>| descriptor.params[*param].accepts == ParamType::File;
            match descriptor.param_named(named).filter(is_file) {
                Some(param) => Amount::Picture(param, *axis),
                None => {
                    errors.push(DescriptorError::UnknownSizeParam { port: name(), named: named.clone() });
                    Amount::Fixed(1)
                }
            }
        }
        Extent::Param(named) => match descriptor.param_named(named) {
            Some(param) if matches!(descriptor.params[param].accepts, ParamType::Integer { .. }) => {
                Amount::Param(param)
            }
            found => {
                let (port, named) = (name(), named.clone());
                errors.push(match found {
                    Some(_) => DescriptorError::SizeParamNotInteger { port, named },
                    None => DescriptorError::UnknownSizeParam { port, named },
                });
                Amount::Fixed(1)
            }
        },
    }
}

/// The input that an output of any class is like: the first texture that its size names.
fn like(
    descriptor: &PassDescriptor,
    port: &PortDescriptor,
    errors: &mut Vec<DescriptorError>,
) -> Option<Handle<PortDescriptor>> {
    let PortKind::Texture { class, format, .. } = &port.kind else { return None };
    if !matches!(port.role, Role::Output { .. }) {
        return None;
    }
    if *class != Class::Any {
        errors.extend(format.is_none().then(|| DescriptorError::NoFormat { port: port.name.clone() }));
        return None;
    }
    let rule = port.size.as_ref();
    let extents = rule.iter().flat_map(|rule| [&rule.width, &rule.height, &rule.depth]);
    let named = extents.filter_map(|extent| match extent {
        Extent::Port { port, .. } => descriptor.port_named(port),
        _ => None,
    });
    let is_texture_input = |port: &Handle<PortDescriptor>| {
        let port = &descriptor.ports[*port];
        port.role.is_input() && matches!(port.kind, PortKind::Texture { .. })
    };
    let found = named.into_iter().find(is_texture_input);
    errors.extend(found.is_none().then(|| DescriptorError::NoClass { port: port.name.clone() }));
    found
}

/// The input that is passed on while the pass is disabled.
fn through(
    descriptor: &PassDescriptor,
    port: &PortDescriptor,
    errors: &mut Vec<DescriptorError>,
) -> Option<Handle<PortDescriptor>> {
    let Role::Output { disabled: Disabled::Input(named) } = &port.role else { return None };
    let name = port.name.clone();
    let found = descriptor.port_named(named).filter(|other| descriptor.ports[*other].role.is_input());
    let Some(index) = found else {
        errors.push(DescriptorError::UnknownThrough { port: name, named: named.clone() });
        return None;
    };
    let input = &descriptor.ports[index];
    if matches!(input.role, Role::History(_)) {
        errors.push(DescriptorError::ThroughHistory { port: name, named: named.clone() });
    } else if !may_stand_for(&input.kind, &port.kind) {
        errors.push(DescriptorError::ThroughOther { port: name, named: named.clone() });
    }
    Some(index)
}

fn may_stand_for(input: &PortKind, output: &PortKind) -> bool {
    match (input, output) {
        (
            PortKind::Texture { dimension: a, class: class_a, .. },
            PortKind::Texture { dimension: b, class: class_b, .. },
        ) => a == b && (class_a == class_b || *class_a == Class::Any || *class_b == Class::Any),
        (PortKind::Buffer { element: a, .. }, PortKind::Buffer { element: b, .. }) => a == b,
        (PortKind::Value { element: a, .. }, PortKind::Value { element: b, .. }) => a == b,
        _ => false,
    }
}

fn axes(kind: &PortKind) -> usize {
    match kind {
        PortKind::Texture { dimension: Dimension::D2, .. } => 2,
        PortKind::Texture { .. } => 3,
        PortKind::Buffer { .. } => 1,
        PortKind::Value { .. } => 0,
    }
}
