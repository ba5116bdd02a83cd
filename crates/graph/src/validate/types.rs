//! What flows through every port, and whether both ends of each connection agree.

use tyndall_document::{Code, Diagnostic};

use super::Validator;
use crate::codes;
use crate::descriptor::{Class, Format, PortDescriptor, PortKind};
use crate::signature::RoleKind;
use crate::table::{Feed, Flow, Shape};

impl Validator<'_> {
    /// Checks every connection as the file has it, and again where switched-off passes are passed through.
    pub(super) fn check_types(&mut self) {
        let written = std::mem::take(&mut self.written);
        self.flow(&written);
        self.check_edges(&written, |_| true);
        if self.table.enabled.contains(&false) {
            let effective = self.table.feeds.clone();
            self.flow(&effective);
            self.check_edges(&effective, |number| written[number] != effective[number]);
        }
        self.written = written;
    }

    /// Finds what flows through every port.
    fn flow(&mut self, feeds: &[Feed]) {
        self.flow_of_outputs();
        for pass in 0..self.table.order.len() {
            self.flow_of_pass(self.table.order[pass], feeds);
        }
        for port in &self.table.history {
            if let Some(source) = feeds[*port as usize].number() {
                self.table.flows[*port as usize] = self.table.flows[source as usize];
            }
        }
    }

    /// Of outputs this is in the descriptor, but for those of any class.
    fn flow_of_outputs(&mut self) {
        for pass in 0..self.table.passes() {
            let kind = self.kind_of(pass);
            let first = self.table.first_port[pass as usize] as usize;
            for (index, port) in kind.descriptor.ports.iter().enumerate() {
                self.table.flows[first + index] = match kind.signature.ports[index].role {
                    RoleKind::Output if kind.signature.ports[index].like.is_none() => declared(port, Flow::UNKNOWN),
                    _ => Flow::UNKNOWN,
                };
            }
        }
    }

    fn flow_of_pass(&mut self, pass: u32, feeds: &[Feed]) {
        let kind = self.kind_of(pass);
        let first = self.table.first_port[pass as usize];
        for (number, (port, descriptor)) in (first..).zip(kind.signature.ports.iter().zip(&kind.descriptor.ports)) {
            if matches!(port.role, RoleKind::Output | RoleKind::History) {
                continue;
            }
            self.table.flows[number as usize] = match feeds[number as usize].number() {
                Some(source) if source != number => self.table.flows[source as usize],
                Some(_) => absent(descriptor),
                None => Flow::UNKNOWN,
            };
        }
        for (number, (port, descriptor)) in (first..).zip(kind.signature.ports.iter().zip(&kind.descriptor.ports)) {
            if let Some(like) = port.like {
                self.table.flows[number as usize] = declared(descriptor, self.table.flows[(first + like) as usize]);
            }
        }
    }

    fn check_edges(&mut self, feeds: &[Feed], concerns: impl Fn(usize) -> bool) {
        for pass in 0..self.table.passes() {
            for number in self.table.ports(pass) {
                let index = (number - self.table.first_port[pass as usize]) as usize;
                let role = self.kind_of(pass).signature.ports[index].role;
                if role.is_input()
                    && concerns(number as usize)
                    && let Some(source) = feeds[number as usize].number().filter(|source| *source != number)
                    && let Some(mistake) = self.mistake(pass, index, source)
                {
                    self.report_edge(number, source, mistake);
                }
            }
        }
    }

    /// What is wrong with feeding the port at `index` from the port `source`.
    fn mistake(&self, pass: u32, index: usize, source: u32) -> Option<(Code, String)> {
        let demanded = &self.kind_of(pass).descriptor.ports[index];
        let flow = self.table.flows[source as usize];
        let fed = self.descriptor_of(source);
        kind_mistake(demanded, fed, flow).or_else(|| unit_mistake(demanded, fed))
    }

    fn descriptor_of(&self, number: u32) -> &PortDescriptor {
        let pass = self.table.pass_of[number as usize];
        &self.kind_of(pass).descriptor.ports[(number - self.table.first_port[pass as usize]) as usize]
    }

    fn report_edge(&mut self, number: u32, source: u32, (code, message): (Code, String)) {
        let (pass, writer) = (self.table.pass_of[number as usize], self.table.pass_of[source as usize]);
        let file = self.file;
        let name = &self.descriptor_of(number).name;
        let from = format!("{}.{}", file.text(&file.passes[writer as usize].name), self.descriptor_of(source).name);
        let input = file.passes[pass as usize].inputs.iter().find(|input| file.text(&input.name) == name);
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
