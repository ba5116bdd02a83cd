//! What flows through every port, and whether both ends of each connection agree.

use tyndall_document::{Code, Diagnostic};

use super::Validator;
use crate::codes;
use crate::descriptor::{Class, Format, PortDescriptor, PortKind};
use crate::graph::{Pass, PortRef};
use crate::handle::Handle;
use crate::signature::RoleKind;
use crate::wiring::{Feeds, Flow, GraphPort, Shape};

impl Validator<'_> {
    /// Checks every connection as the file has it, and again where switched-off passes are passed through.
    pub(super) fn check_types(&mut self) {
        let written = std::mem::take(&mut self.written);
        self.flow(&written);
        self.check_edges(&written, |_| true);
        if self.wiring.enabled.iter().any(|on| !on) {
            let effective = self.wiring.feeds.clone();
            self.flow(&effective);
            self.check_edges(&effective, |number| written[number] != effective[number]);
        }
        self.written = written;
    }

    /// Finds what flows through every port.
    fn flow(&mut self, feeds: &Feeds) {
        self.flow_of_outputs();
        for pass in self.wiring.order.clone() {
            self.flow_of_pass(pass, feeds);
        }
        for port in &self.wiring.history {
            if let Some(source) = feeds[*port].like() {
                self.wiring.flows[*port] = self.wiring.flows[source];
            }
        }
    }

    /// Of outputs this is in the descriptor, but for those of any class.
    fn flow_of_outputs(&mut self) {
        for pass in self.passes.handles() {
            let kind = self.kind_of(pass);
            for (number, (port, descriptor)) in
                self.wiring.ports[pass].handles().zip(kind.signature.ports.iter().zip(&kind.descriptor.ports))
            {
                self.wiring.flows[number] = match port.role {
                    RoleKind::Output if port.like.is_none() => declared(descriptor, Flow::UNKNOWN),
                    _ => Flow::UNKNOWN,
                };
            }
        }
    }

    fn flow_of_pass(&mut self, pass: Handle<Pass>, feeds: &Feeds) {
        let kind = self.kind_of(pass);
        let ports = self.wiring.ports[pass];
        let numbered = || ports.handles().zip(kind.signature.ports.iter().zip(&kind.descriptor.ports));
        for (number, (_, descriptor)) in numbered().filter(|(_, (port, _))| port.role.reads_this_frame()) {
            self.wiring.flows[number] = match feeds[number].like() {
                Some(source) if source != number => self.wiring.flows[source],
                Some(_) => absent(descriptor),
                None => Flow::UNKNOWN,
            };
        }
        for (number, (port, descriptor)) in numbered() {
            if let Some(like) = port.like {
                self.wiring.flows[number] = declared(descriptor, self.wiring.flows[ports.at(like)]);
            }
        }
    }

    fn check_edges(&mut self, feeds: &Feeds, concerns: impl Fn(Handle<GraphPort>) -> bool) {
        for pass in self.passes.handles() {
            let kind = self.kind_of(pass);
            for (number, port) in self.wiring.ports[pass].handles().zip(&kind.signature.ports) {
                if port.role.is_input()
                    && concerns(number)
                    && let Some(source) = feeds[number].like().filter(|source| *source != number)
                    && let Some(mistake) = self.mistake(number, source)
                {
                    self.report_edge(number, source, mistake);
                }
            }
        }
    }

    /// What is wrong with feeding a port from the port `source`.
    fn mistake(&self, number: Handle<GraphPort>, source: Handle<GraphPort>) -> Option<(Code, String)> {
        let (demanded, fed) = (self.descriptor_of(number), self.descriptor_of(source));
        kind_mistake(demanded, fed, self.wiring.flows[source]).or_else(|| unit_mistake(demanded, fed))
    }

    fn descriptor_of(&self, number: Handle<GraphPort>) -> &PortDescriptor {
        let PortRef { pass, port } = self.wiring.port_ref(number);
        &self.kind_of(pass).descriptor.ports[port]
    }

    fn report_edge(&mut self, number: Handle<GraphPort>, source: Handle<GraphPort>, (code, message): (Code, String)) {
        let (pass, writer) = (self.wiring.pass_of[number], self.wiring.pass_of[source]);
        let file = self.file;
        let name = &self.descriptor_of(number).name;
        let from = format!("{}.{}", file.text(&file.passes[writer].name), self.descriptor_of(source).name);
        let input = file.passes[pass].inputs.iter().find(|input| file.text(&input.name) == name);
        let Some(named) = input.and_then(|input| input.from.as_ref()) else { return };
        let message = match from == file.text(named) {
            true => message,
            false => format!("{message} (`{}` is switched off, so `{from}` flows here)", file.text(named)),
        };
        let diagnostic = Diagnostic::error(code, self.place(named.span), message);
        let related = self.place(self.pass_span(writer));
        self.report(diagnostic.relate(related, format!("`{from}` is written here")));
    }
}

/// What an output declares; what it leaves open it has of `like`.
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

/// The constant that stands for an optional input that nothing feeds.
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
                return Some((codes::WRONG_DIMENSION, format!("`{name}` is a {dimension} texture, and this is {d}")));
            }
            if *class != flow.class && *class != Class::Any {
                let message = format!("`{name}` is of class {class}, and this is of class {}", flow.class);
                return Some((codes::WRONG_CLASS, message));
            }
            if let Some(format) = format.filter(|format| *format != f) {
                return Some((codes::WRONG_FORMAT, format!("`{name}` is read as {format}, and this is {f}")));
            }
            let unfiltered = *filtered && matches!(f, Format::R32Uint | Format::Rg32Uint | Format::Rgba32Uint);
            unfiltered.then(|| (codes::WRONG_FORMAT, format!("`{name}` is read through a filter, and this is {f}")))
        }
        (PortKind::Buffer { element, stride }, Shape::Buffer { stride: s }) => {
            element_mistake(name, (element, *stride), (element_of(fed), s))
        }
        (PortKind::Value { element, bytes }, Shape::Value { bytes: b }) => {
            element_mistake(name, (element, *bytes), (element_of(fed), b))
        }
        (kind, shape) => {
            let message = format!("`{name}` is {}, and this is {}", kind_words(kind), shape_words(shape));
            Some((codes::WRONG_KIND, message))
        }
    }
}

fn element_mistake(name: &str, demanded: (&str, u32), fed: (&str, u32)) -> Option<(Code, String)> {
    let (element, bytes) = demanded;
    (demanded != fed).then(|| {
        let message =
            format!("`{name}` has elements `{element}` of {bytes} bytes, and this has `{}` of {} bytes", fed.0, fed.1);
        (codes::WRONG_ELEMENT, message)
    })
}

fn unit_mistake(demanded: &PortDescriptor, fed: &PortDescriptor) -> Option<(Code, String)> {
    let differ = !demanded.unit.is_empty() && !fed.unit.is_empty() && demanded.unit != fed.unit;
    differ.then(|| {
        (codes::WRONG_UNIT, format!("`{}` is in {}, and this is in {}", demanded.name, demanded.unit, fed.unit))
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
