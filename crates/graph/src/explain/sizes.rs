//! The rules from which the size of a port follows.

use super::port::port_of;
use crate::descriptor::{Extent, PortKind, SizeRule};
use crate::graph::{ParamSetting, PortRef};
use crate::plan::Plan;
use crate::plan::sizes::{Size, sizes};
use crate::signature::RoleKind;

/// Longest chain that is told.
const MOST_LINES: usize = 40;

/// Every rule on the way from a port's size to the frame, a fixed size or a parameter.
pub(super) fn size_lines(plan: &Plan, port: PortRef) -> Vec<String> {
    let (sizes, _) = sizes(&plan.graph, &plan.graph.table.feeds, plan.size);
    let mut chain = Chain { plan, sizes, lines: Vec::new(), told: Vec::new() };
    chain.tell(port);
    chain.lines
}

struct Chain<'a> {
    plan: &'a Plan,
    sizes: Vec<Size>,
    lines: Vec<String>,
    told: Vec<PortRef>,
}

impl Chain<'_> {
    fn tell(&mut self, port: PortRef) {
        if self.told.contains(&port) || self.lines.len() >= MOST_LINES {
            return;
        }
        self.told.push(port);
        let graph = &self.plan.graph;
        let table = &graph.table;
        let number = table.port(port.pass, port.port);
        let role = table.kind(port.pass).signature.ports[port.port as usize].role;
        let (name, size) = (graph.port_name(port), self.words(port));
        let source = table.feeds[number as usize].number().filter(|source| *source != number);
        if let (true, Some(source)) = (role != RoleKind::Output, source) {
            let source = port_of(self.plan, source);
            self.lines.push(format!("{name} is {size}, because {} is fed to it", graph.port_name(source)));
            return self.tell(source);
        }
        let descriptor = graph.port(port);
        if let PortKind::Value { bytes, .. } = descriptor.kind {
            return self.lines.push(format!("{name} is one value of {bytes} bytes"));
        }
        let rule = descriptor.size.clone().unwrap_or_else(|| SizeRule::frame(1.0));
        self.lines.push(format!("{name} is {size}: {}", self.rule_words(port.pass, &rule)));
        for extent in [&rule.width, &rule.height, &rule.depth] {
            if let Extent::Port { port: named, .. } = extent
                && let Some(index) =
                    graph.pass(port.pass).descriptor().ports.iter().position(|other| other.name == *named)
            {
                self.tell(PortRef { pass: port.pass, port: index as u32 });
            }
        }
    }

    /// The rule, with what its parameters and the frame are.
    fn rule_words(&self, pass: u32, rule: &SizeRule) -> String {
        let mut words = rule.to_string();
        let mut known: Vec<String> = Vec::new();
        for extent in [&rule.width, &rule.height, &rule.depth] {
            let fact = match extent {
                Extent::Frame { .. } | Extent::FramePixels(_) => {
                    format!("the frame is {}×{}", self.plan.size.0, self.plan.size.1)
                }
                Extent::Param(param) => self.param_words(pass, param),
                Extent::Fixed(_) | Extent::Port { .. } | Extent::Picture { .. } => continue,
            };
            if !known.contains(&fact) {
                known.push(fact);
            }
        }
        if !known.is_empty() {
            words += &format!(" ({})", known.join(", "));
        }
        words
    }

    fn param_words(&self, pass: u32, name: &str) -> String {
        let of_pass = self.plan.graph.pass(pass);
        let settings = of_pass.params.iter().zip(&of_pass.descriptor().params);
        let setting = settings.into_iter().find(|(_, param)| param.name == name).map(|(setting, _)| setting);
        match setting {
            Some(ParamSetting::Value(value)) => format!("`{name}` is {value}"),
            _ => format!("`{name}`"),
        }
    }

    fn words(&self, port: PortRef) -> String {
        let table = &self.plan.graph.table;
        let size = self.sizes[table.port(port.pass, port.port) as usize];
        let axes = table.kind(port.pass).signature.ports[port.port as usize].axes as usize;
        match &size[..axes] {
            [] => "one value".to_owned(),
            [elements] => format!("{elements} elements"),
            extents => extents.iter().map(ToString::to_string).collect::<Vec<_>>().join("×"),
        }
    }
}
