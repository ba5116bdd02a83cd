//! What flows through every port, and whether both ends of each connection agree.

use tyndall_document::{Code, Diagnostic};

use super::connections::Connections;
use super::mistakes::Mistakes;
use super::scope::Scope;
use crate::codes;
use crate::descriptor::{Class, Format, PortDescriptor, PortKind, Scalar};
use crate::graph::Pass;
use crate::handle::{Handle, Table};
use crate::signature::RoleKind;
use crate::wiring::{Feeds, Flow, GraphPort, Passes, Shape};

type Flows = Table<GraphPort, Flow>;

/// Checks every connection as the file has it, and again where switched-off passes are passed through; gives what flows
/// through every port then.
pub(super) fn check(
    scope: &Scope<'_>,
    order: &[Handle<Pass>],
    connections: &Connections,
    feeds: &Feeds,
    out: &mut Mistakes,
) -> Flows {
    let (passes, written) = (&scope.passes, &connections.written);
    let as_written = flows(passes, order, connections, written);
    check_edges(scope, written, &as_written, |_| true, out);
    if feeds == written {
        return as_written;
    }
    let flows = flows(passes, order, connections, feeds);
    check_edges(scope, feeds, &flows, |port| feeds[port] != written[port], out);
    flows
}

/// Finds what flows through every port.
fn flows(passes: &Passes, order: &[Handle<Pass>], connections: &Connections, feeds: &Feeds) -> Flows {
    let mut flows = passes.pass_of.column(Flow::UNKNOWN);
    for pass in passes.kind_of.handles() {
        for (port, signature, descriptor) in passes.declared_ports_of(pass) {
            if signature.role == RoleKind::Output && signature.like.is_none() {
                flows[port] = declared(descriptor, Flow::UNKNOWN);
            }
        }
    }
    for pass in order {
        let ports = passes.declared_ports_of(*pass);
        for (port, _, descriptor) in ports.clone().filter(|(_, port, _)| port.role.reads_this_frame()) {
            flows[port] = match feeds[port].like() {
                Some(source) if source != port => flows[source],
                Some(_) => absent(descriptor),
                None => Flow::UNKNOWN,
            };
        }
        for (port, signature, descriptor) in ports {
            if let Some(like) = signature.like {
                flows[port] = declared(descriptor, flows[passes.ports[*pass].at(like)]);
            }
        }
    }
    for port in &connections.history {
        if let Some(source) = feeds[*port].like() {
            flows[*port] = flows[source];
        }
    }
    flows
}

/// Reports what is wrong with what is fed to inputs.
fn check_edges(
    scope: &Scope<'_>,
    feeds: &Feeds,
    flows: &Flows,
    concerns: impl Fn(Handle<GraphPort>) -> bool,
    out: &mut Mistakes,
) {
    let passes = &scope.passes;
    let ports = passes.kind_of.handles().flat_map(|pass| passes.declared_ports_of(pass));
    for (port, _, demanded) in ports.filter(|(port, signature, _)| signature.role.is_input() && concerns(*port)) {
        let Some(source) = feeds[port].like().filter(|source| *source != port) else { continue };
        let fed = passes.descriptor(source);
        let mistake = kind_mistake(demanded, fed, flows[source]).or_else(|| unit_mistake(demanded, fed));
        out.extend(mistake.and_then(|mistake| edge_mistake(scope, port, source, mistake)));
    }
}

/// What is wrong with a connection.
fn edge_mistake(
    scope: &Scope<'_>,
    port: Handle<GraphPort>,
    source: Handle<GraphPort>,
    (code, message): (Code, String),
) -> Option<Diagnostic> {
    let (passes, file) = (&scope.passes, scope.file);
    let writer = passes.pass_of[source];
    let from = format!("{}.{}", scope.name(writer), passes.descriptor(source).name);
    let mut inputs = file.passes[passes.pass_of[port]].inputs.iter();
    let input = inputs.find(|input| file.text(&input.name) == passes.descriptor(port).name)?;
    let named = input.from.as_ref()?;
    let message = match from == file.text(named) {
        true => message,
        false => format!("{message} (`{}` is switched off, so `{from}` flows here)", file.text(named)),
    };
    let diagnostic = Diagnostic::error(code, scope.place(named.span), message);
    Some(diagnostic.relate(scope.place_of(writer), format!("`{from}` is written here")))
}

/// What an output declares; what it leaves open is taken from `like`.
fn declared(port: &PortDescriptor, like: Flow) -> Flow {
    match &port.kind {
        PortKind::Texture { dimension, class, format, .. } => {
            let like_format = match like.shape {
                Shape::Texture { format, .. } => Some(format),
                _ => None,
            };
            let class = if *class == Class::Any { like.class } else { *class };
            match format.or(like_format) {
                Some(format) => Flow { class, shape: Shape::Texture { dimension: *dimension, format } },
                None => Flow::UNKNOWN,
            }
        }
        PortKind::Buffer { stride, .. } => Flow { class: Class::Data, shape: Shape::Buffer { stride: *stride } },
        PortKind::Value { bytes, .. } => Flow { class: Class::Data, shape: Shape::Value { bytes: *bytes } },
    }
}

/// The constant that stands for an optional input that is not connected.
fn absent(port: &PortDescriptor) -> Flow {
    let PortKind::Texture { dimension, class, format, filtered } = &port.kind else {
        return declared(port, Flow::UNKNOWN);
    };
    let usual = match class {
        Class::Scalar => Format::R32Float,
        Class::RasterDepth => Format::Depth32Float,
        Class::Display => Format::Rgba8Unorm,
        _ if *filtered => Format::Rgba16Float,
        Class::Color | Class::Vector | Class::Data | Class::Any => Format::Rgba32Float,
    };
    let class = if *class == Class::Any { Class::Data } else { *class };
    Flow { class, shape: Shape::Texture { dimension: *dimension, format: format.unwrap_or(usual) } }
}

fn kind_mistake(demanded: &PortDescriptor, fed: &PortDescriptor, flow: Flow) -> Option<(Code, String)> {
    let name = &demanded.name;
    match (&demanded.kind, flow.shape) {
        (_, Shape::Unknown) => None,
        (PortKind::Texture { dimension, class, format, filtered }, Shape::Texture { dimension: d, format: f }) => {
            if *dimension != d {
                return Some((codes::WRONG_DIMENSION, format!("`{name}` is a {dimension} texture, but this is {d}")));
            }
            if *class != flow.class && *class != Class::Any {
                let message = format!("`{name}` is of class {class}, but this is of class {}", flow.class);
                return Some((codes::WRONG_CLASS, message));
            }
            if let Some(format) = format.filter(|format| *format != f) {
                return Some((codes::WRONG_FORMAT, format!("`{name}` is read as {format}, but this is {f}")));
            }
            let unfiltered = *filtered && f.scalar() == Scalar::U32;
            unfiltered.then(|| (codes::WRONG_FORMAT, format!("`{name}` is read through a filter, but this is {f}")))
        }
        (PortKind::Buffer { element, stride }, Shape::Buffer { stride: s }) => {
            element_mistake(name, (element, *stride), (element_of(fed), s))
        }
        (PortKind::Value { element, bytes }, Shape::Value { bytes: b }) => {
            element_mistake(name, (element, *bytes), (element_of(fed), b))
        }
        (kind, shape) => {
            let message = format!("`{name}` is {}, but this is {}", kind_words(kind), shape_words(shape));
            Some((codes::WRONG_KIND, message))
        }
    }
}

fn element_mistake(name: &str, demanded: (&str, u32), fed: (&str, u32)) -> Option<(Code, String)> {
    let (element, bytes) = demanded;
    (demanded != fed).then(|| {
        let message =
            format!("`{name}` has elements `{element}` of {bytes} bytes, but this has `{}` of {} bytes", fed.0, fed.1);
        (codes::WRONG_ELEMENT, message)
    })
}

fn unit_mistake(demanded: &PortDescriptor, fed: &PortDescriptor) -> Option<(Code, String)> {
    let differ = !demanded.unit.is_empty() && !fed.unit.is_empty() && demanded.unit != fed.unit;
    differ.then(|| {
        (codes::WRONG_UNIT, format!("`{}` is in {}, but this is in {}", demanded.name, demanded.unit, fed.unit))
    })
}

fn element_of(port: &PortDescriptor) -> &str {
    match &port.kind {
        PortKind::Buffer { element, .. } | PortKind::Value { element, .. } => element,
        PortKind::Texture { .. } => "",
    }
}

fn kind_words(kind: &PortKind) -> &'static str {
    match kind {
        PortKind::Texture { .. } => "a texture",
        PortKind::Buffer { .. } => "a buffer",
        PortKind::Value { .. } => "a value",
    }
}

fn shape_words(shape: Shape) -> &'static str {
    match shape {
        Shape::Texture { .. } => "a texture",
        Shape::Buffer { .. } => "a buffer",
        Shape::Value { .. } | Shape::Unknown => "a value",
    }
}
