//! The rules from which the size of a port follows.

use crate::descriptor::{Extent, PortKind, SizeRule};
use crate::graph::{ParamSetting, Pass, PortRef};
use crate::handle::Handle;
use crate::plan::Plan;
use crate::plan::sizes::{Sizes, sizes};

/// Longest chain that is shown.
const MOST_LINES: usize = 40;

/// Every rule on the way from a port's size to the frame, a fixed size or a parameter.
pub(super) fn size_lines(plan: &Plan, port: PortRef) -> Vec<String> {
    let (sizes, _) = sizes(&plan.graph, &plan.graph.wiring.feeds, plan.size);
    let mut chain = Chain { plan, sizes, lines: Vec::new(), explained: Vec::new() };
    chain.tell(port);
    chain.lines
}

struct Chain<'a> {
    plan: &'a Plan,
    sizes: Sizes,
    lines: Vec<String>,
    explained: Vec<PortRef>,
}

impl Chain<'_> {
    fn tell(&mut self, port: PortRef) {
        if self.explained.contains(&port) || self.lines.len() >= MOST_LINES {
            return;
        }
        self.explained.push(port);
        let graph = &self.plan.graph;
        let wiring = &graph.wiring;
        let number = wiring.passes.port(port);
        let (name, size) = (graph.port_name(port), self.words(port));
        let source = wiring.feeds[number].like().filter(|source| *source != number);
        if let (true, Some(source)) = (graph.signature(port).role.is_input(), source) {
            let source = wiring.passes.port_ref(source);
            self.lines.push(format!("{name} is {size}, because {} is connected to it", graph.port_name(source)));
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
                && let Some(named) = graph.pass(port.pass).descriptor().port_named(named)
            {
                self.tell(PortRef { port: named, ..port });
            }
        }
    }

    /// The rule, with what its parameters and the frame are.
    fn rule_words(&self, pass: Handle<Pass>, rule: &SizeRule) -> String {
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

    fn param_words(&self, pass: Handle<Pass>, name: &str) -> String {
        let of_pass = self.plan.graph.pass(pass);
        let settings = of_pass.params.iter().zip(&of_pass.descriptor().params);
        let setting = settings.into_iter().find(|(_, param)| param.name == name).map(|(setting, _)| setting);
        match setting {
            Some(ParamSetting::Value(value)) => format!("`{name}` is {value}"),
            _ => format!("`{name}`"),
        }
    }

    fn words(&self, port: PortRef) -> String {
        let graph = &self.plan.graph;
        match &self.sizes[graph.wiring.passes.port(port)][..graph.signature(port).axes] {
            [] => "one value".to_owned(),
            [elements] => format!("{elements} elements"),
            extents => extents.iter().map(ToString::to_string).collect::<Vec<_>>().join("×"),
        }
    }
}
