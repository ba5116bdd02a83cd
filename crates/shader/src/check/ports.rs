//! Checks that ports and variables agree.

use naga::StorageAccess;
use tyndall_document::Diagnostic;
use tyndall_graph::descriptor::{Class, Dimension, Format, PortDescriptor, PortKind, Role, Scalar};

use super::Pass;
use crate::codes;
use crate::ports::{dimension, shape};
use crate::reflect::{Resource, ResourceKind, SampleClass};

/// Reports every port that is missing from the shaders, and every output that none of them writes.
pub fn missing(pass: &Pass<'_>, out: &mut Vec<Diagnostic>) {
    let targets: Vec<&str> = pass
        .shaders
        .iter()
        .flat_map(|linked| &linked.entry_points)
        .flat_map(|entry| entry.targets.iter().map(|target| target.name.as_str()))
        .collect();
    let rasterises =
        pass.shaders.iter().flat_map(|linked| &linked.entry_points).any(|e| e.stage == naga::ShaderStage::Vertex);
    for port in &pass.descriptor.ports {
        let depth = matches!(port.kind, PortKind::Texture { class: Class::RasterDepth, .. });
        if targets.contains(&port.name.as_str()) || (depth && rasterises && port.role.is_output()) {
            continue;
        }
        let variables: Vec<_> = pass.resources().filter(|resource| resource.name == port.name).collect();
        match variables.first() {
            None if misnamed(pass, port) => {}
            None => out.push(without_variable(pass, port)),
            Some(first) if port.role.is_output() && !variables.iter().any(|resource| resource.written) => {
                out.push(never_written(port, first));
            }
            Some(_) => {}
        }
    }
}

fn without_variable(pass: &Pass<'_>, port: &PortDescriptor) -> Diagnostic {
    let message = format!("the port `{}` of `{}` has no variable in the shader", port.name, pass.descriptor.name);
    Diagnostic::error(codes::PORT, pass.file(), message).suggest(format!("declare `{}`", declaration(port)))
}

/// Whether an unknown variable was probably meant to be this port; it is reported, with the port's name.
fn misnamed(pass: &Pass<'_>, port: &PortDescriptor) -> bool {
    pass.resources().any(|resource| pass.is_unknown(&resource.name) && pass.meant(&resource.name) == Some(&port.name))
}

fn never_written(port: &PortDescriptor, resource: &Resource) -> Diagnostic {
    let message = format!("`{}` is an output, but the shader never writes to it", port.name);
    Diagnostic::error(codes::PORT, resource.place.clone(), message).suggest(format!("declare `{}`", declaration(port)))
}

/// Reports where a variable is not what its port declares.
pub fn agree(port: &PortDescriptor, resource: &Resource, out: &mut Vec<Diagnostic>) {
    if let Some(message) = disagreement(port, resource) {
        let problem = Diagnostic::error(codes::PORT, resource.place.clone(), message);
        out.push(problem.suggest(format!("the port is declared as `{}`", declaration(port))));
    }
}

/// The declaration in WGSL that a port asks for.
fn declaration(port: &PortDescriptor) -> String {
    let name = &port.name;
    let writes = port.role.is_output();
    match &port.kind {
        PortKind::Texture { dimension, class, format, .. } => {
            let dimension = match dimension {
                Dimension::D2 => "2d",
                Dimension::D2Array => "2d_array",
                Dimension::D3 => "3d",
            };
            let access = if matches!(port.role, Role::InOut) { "read_write" } else { "write" };
            match (writes, format) {
                (true, Some(format)) => format!("var {name}: texture_storage_{dimension}<{format}, {access}>;"),
                (true, None) => format!("var {name}: texture_storage_{dimension}<…, {access}>;"),
                (false, Some(format)) => format!("var {name}: texture_{dimension}<{}>;", scalar(*format)),
                (false, None) if *class == Class::RasterDepth => format!("var {name}: texture_depth_{dimension};"),
                (false, None) => format!("var {name}: texture_{dimension}<f32>;"),
            }
        }
        PortKind::Buffer { element, .. } => {
            let access = if writes { "read_write" } else { "read" };
            format!("var<storage, {access}> {name}: array<{element}>;")
        }
        PortKind::Value { element, .. } if writes => format!("var<storage, read_write> {name}: {element};"),
        PortKind::Value { element, .. } => format!("var<uniform> {name}: {element};"),
    }
}

/// What reading a format gives.
fn scalar(format: Format) -> &'static str {
    match format.scalar() {
        Scalar::U32 => "u32",
        Scalar::I32 => "i32",
        Scalar::F32 | Scalar::F16 | Scalar::Unorm8 => "f32",
    }
}

fn disagreement(port: &PortDescriptor, resource: &Resource) -> Option<String> {
    let name = &port.name;
    match (&port.kind, &resource.kind) {
        (PortKind::Texture { dimension: want, class, format, filtered: wanted }, ResourceKind::Texture { .. }) => {
            let ResourceKind::Texture { dimension: dim, arrayed, class: sampled, filtered } = resource.kind else {
                return None;
            };
            if port.role == Role::InOut {
                return Some(format!("`{name}` is read and written in place, but its variable is read-only"));
            }
            dimensions(name, *want, dim, arrayed)
                .or_else(|| sampling(name, *class, *format, sampled))
                .or_else(|| (*wanted != filtered && !port.role.is_output()).then(|| filtering(name, filtered)))
        }
        (PortKind::Texture { dimension: want, format, .. }, ResourceKind::StorageTexture { .. }) => {
            let ResourceKind::StorageTexture { dimension: dim, arrayed, format: stored, access } = resource.kind else {
                return None;
            };
            dimensions(name, *want, dim, arrayed)
                .or_else(|| access_of(port, access))
                .or_else(|| (*format != Some(stored)).then(|| formats(name, *format, stored)))
        }
        (PortKind::Buffer { element, stride }, ResourceKind::StorageBuffer { .. }) => {
            buffer(port, element, *stride, &resource.kind)
        }
        (PortKind::Value { element, bytes }, ResourceKind::Uniform { type_name, size, .. }) => {
            if port.role.is_output() {
                return Some(format!("`{name}` is written, but a uniform is read-only"));
            }
            value(name, (element, *bytes), (type_name, *size))
        }
        (
            PortKind::Value { element, bytes },
            ResourceKind::StorageBuffer { type_name, read_only, stride, element: None, .. },
        ) => written(port, *read_only).or_else(|| value(name, (element, *bytes), (type_name, *stride))),
        (kind, found) => {
            Some(format!("the port `{name}` is {}, but its variable is {}", words(kind), found_words(found)))
        }
    }
}

fn words(kind: &PortKind) -> &'static str {
    match kind {
        PortKind::Texture { .. } => "a texture",
        PortKind::Buffer { .. } => "a buffer of elements",
        PortKind::Value { .. } => "a value",
    }
}

fn found_words(kind: &ResourceKind) -> &'static str {
    match kind {
        ResourceKind::Texture { .. } | ResourceKind::StorageTexture { .. } => "a texture",
        ResourceKind::Uniform { .. } => "a uniform",
        ResourceKind::StorageBuffer { element: Some(_), .. } => "a buffer of elements",
        ResourceKind::StorageBuffer { .. } => "a buffer of one value",
        ResourceKind::Sampler { .. } => "a sampler",
    }
}

fn dimensions(name: &str, want: Dimension, dim: naga::ImageDimension, arrayed: bool) -> Option<String> {
    if dimension(dim, arrayed) == Some(want) {
        return None;
    }
    let want = match want {
        Dimension::D2 => "a 2D texture",
        Dimension::D2Array => "a 2D texture with layers",
        Dimension::D3 => "a 3D texture",
    };
    Some(format!("the port `{name}` is {want}, but its variable is {}", shape(dim, arrayed)))
}

/// Whether what is read fits the format, or the class where every format of a class is read.
fn sampling(name: &str, class: Class, format: Option<Format>, sampled: SampleClass) -> Option<String> {
    let allowed: &[SampleClass] = match (format, class) {
        (Some(format), _) if format.scalar() == Scalar::U32 => &[SampleClass::Uint],
        (Some(Format::Depth32Float), _) | (None, Class::RasterDepth) => &[SampleClass::Depth, SampleClass::Float],
        (None, Class::Data) => &[SampleClass::Float, SampleClass::Uint],
        _ => &[SampleClass::Float],
    };
    let words = |class| match class {
        SampleClass::Float => "f32",
        SampleClass::Uint => "u32",
        SampleClass::Sint => "i32",
        SampleClass::Depth => "depth",
    };
    let found = words(sampled);
    let wanted = words(allowed[0]);
    (!allowed.contains(&sampled)).then(|| format!("the port `{name}` holds {wanted}, but its variable reads {found}"))
}

fn filtering(name: &str, filtered: bool) -> String {
    if filtered {
        format!("`{name}` is sampled with a filtering sampler, but its port is not declared as filtered")
    } else {
        format!("the port `{name}` is declared as filtered, but no filtering sampler samples it")
    }
}

fn formats(name: &str, want: Option<Format>, stored: Format) -> String {
    match want {
        Some(want) => format!("the port `{name}` is {want}, but its variable is {stored}"),
        None => format!("the port `{name}` has any format of its class, but its variable is {stored}"),
    }
}

fn access_of(port: &PortDescriptor, access: StorageAccess) -> Option<String> {
    let (name, loads, stores) =
        (&port.name, access.contains(StorageAccess::LOAD), access.contains(StorageAccess::STORE));
    match port.role {
        Role::InOut if !(loads && stores) => {
            Some(format!("`{name}` is read and written in place, but its variable is not `read_write`"))
        }
        Role::Input | Role::Optional(_) | Role::History(_) if stores => {
            Some(format!("`{name}` is an input, but its variable is writable"))
        }
        _ => None,
    }
}

/// Checks that a buffer is writable exactly where its port says so.
fn written(port: &PortDescriptor, read_only: bool) -> Option<String> {
    let name = &port.name;
    match (&port.role, read_only) {
        (Role::InOut, true) => Some(format!("`{name}` is read and written in place, but its variable is read-only")),
        (Role::Input | Role::Optional(_) | Role::History(_), false) => {
            Some(format!("`{name}` is an input, but its variable is writable"))
        }
        _ => None,
    }
}

fn buffer(port: &PortDescriptor, element: &str, stride: u32, found: &ResourceKind) -> Option<String> {
    let ResourceKind::StorageBuffer { type_name, read_only, element: held, stride: held_stride, header, .. } = found
    else {
        return None;
    };
    let name = &port.name;
    let Some(held) = held else {
        return Some(format!("the port `{name}` is a buffer of elements, but its variable is a single `{type_name}`"));
    };
    if *header > 0 {
        return Some(format!("the buffer `{name}` must be an array, but is `{type_name}`"));
    }
    written(port, *read_only).or_else(|| {
        if held != element {
            Some(format!("the elements of the port `{name}` are `{element}`, but those of its variable are `{held}`"))
        } else if *held_stride != stride {
            Some(format!(
                "an element of the port `{name}` takes {stride} bytes, but one of its variable takes {held_stride}"
            ))
        } else {
            None
        }
    })
}

fn value(name: &str, want: (&str, u32), found: (&str, u32)) -> Option<String> {
    if want.0 != found.0 {
        Some(format!("the port `{name}` is a `{}`, but its variable is a `{}`", want.0, found.0))
    } else if want.1 != found.1 {
        Some(format!("the port `{name}` takes {} bytes, but its variable takes {}", want.1, found.1))
    } else {
        None
    }
}
