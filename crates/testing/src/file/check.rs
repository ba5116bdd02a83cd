//! A test file held against its graph: which ports its taps mean, and whether what they ask fits.

use tyndall_document::{Diagnostic, Diagnostics, Place, Span};
use tyndall_graph::descriptor::{Class, PortKind};
use tyndall_graph::{Graph, PortRef};

use super::{Change, Golden, Property, Reference, Tap, TestFile};
use crate::codes;
use crate::metric::Metric;

/// A port that a test looks at, with all that its taps say.
#[derive(Debug, Clone)]
pub struct Tapped {
    /// The port.
    pub port: PortRef,
    /// `pass.port`.
    pub name: String,
    /// How far from its golden.
    pub golden: Option<Golden>,
    /// A picture that another renderer made.
    pub reference: Option<Reference>,
    /// What needs no golden.
    pub properties: Vec<Property>,
}

/// Finds the ports that a test looks at, in the graph's order. `has_reference` says whether a pass (`plugin.pass`) has a
/// reference on the CPU. A property of a tap with `*` is asked only of the ports that it fits.
pub fn check(
    file: &TestFile,
    graph: &Graph,
    has_reference: &dyn Fn(&str) -> bool,
    out: &mut Diagnostics,
) -> Vec<Tapped> {
    let mut checker = Checker { file, graph, has_reference, out };
    let ports: Vec<PortRef> = graph.written_ports().collect();
    for tap in &file.taps {
        checker.matches_something(&tap.pattern, tap.span, &ports);
        checker.properties_fit_something(tap, &ports);
    }
    checker.named_ports_exist();
    let enabled = ports.iter().filter(|port| graph.pass(port.pass).enabled);
    enabled.filter_map(|port| checker.tapped(*port)).collect()
}

struct Checker<'a> {
    file: &'a TestFile,
    graph: &'a Graph,
    has_reference: &'a dyn Fn(&str) -> bool,
    out: &'a mut Diagnostics,
}

impl Checker<'_> {
    fn matches_something(&mut self, pattern: &str, span: Span, ports: &[PortRef]) {
        let matching: Vec<_> = ports.iter().filter(|port| matches(pattern, &self.graph.port_name(**port))).collect();
        let place = self.file.place(span);
        if matching.is_empty() {
            let message = format!("`{pattern}` matches no port of the graph");
            let names: Vec<String> = ports.iter().map(|port| self.graph.port_name(*port)).collect();
            let problem = Diagnostic::error(codes::EMPTY_PATTERN, place, message);
            self.out.push(problem.suggest_near(pattern, names.iter().map(String::as_str)));
        } else if let Some(off) = matching.iter().map(|port| self.graph.pass(port.pass)).find(|pass| !pass.enabled)
            && matching.iter().all(|port| !self.graph.pass(port.pass).enabled)
        {
            let message = format!("`{pattern}` looks at pass `{}`, which is switched off", off.name);
            let problem = Diagnostic::error(codes::TAP_OFF, place, message);
            self.out.push(problem.suggest("switch it on with `set`, or leave the tap out"));
        }
    }

    /// A property of a pattern that no port fits is asked of nothing.
    fn properties_fit_something(&mut self, tap: &Tap, ports: &[PortRef]) {
        let looks_at = |port: &&PortRef| {
            self.graph.pass(port.pass).enabled && matches(&tap.pattern, &self.graph.port_name(**port))
        };
        let matching: Vec<PortRef> = ports.iter().filter(looks_at).copied().collect();
        for property in tap.properties.iter().filter(|_| tap.pattern.contains('*')) {
            let unfit = matching.iter().map(|port| self.unfit(*port, &property.value));
            let Some(Some(unfit)) = unfit.reduce(|all, one| all.and(one)) else { continue };
            let (code, why) = unfit;
            let message = format!("this fits no port that `{}` matches: {why}", tap.pattern);
            self.out.push(Diagnostic::error(code, self.file.place(property.span), message));
        }
    }

    /// Ports that properties and relations name.
    fn named_ports_exist(&mut self) {
        let properties = self.file.taps.iter().flat_map(|tap| &tap.properties);
        let named = properties.flat_map(|property| property.value.ports().iter().map(|port| (port, property.span)));
        let expected = self.file.relations.iter().flat_map(|relation| &relation.expect);
        let named: Vec<_> = named.chain(expected.map(|expectation| (&expectation.port, expectation.span))).collect();
        for (name, span) in named {
            match self.graph.find(name, self.file.place(span)) {
                Ok(port) if !self.graph.pass(port.pass).enabled => {
                    let message = format!("`{name}` is a port of a pass that is switched off");
                    self.out.push(Diagnostic::error(codes::TAP_OFF, self.file.place(span), message));
                }
                Ok(_) => {}
                Err(problem) => self.out.push(Diagnostic { code: codes::UNKNOWN_TAP, ..problem }),
            }
        }
        self.changes_fit();
    }

    /// What relations ask of ports: references on the CPU are there, and metrics are such as ports have.
    fn changes_fit(&mut self) {
        for expectation in self.file.relations.iter().flat_map(|relation| &relation.expect) {
            let place = self.file.place(expectation.span);
            let Ok(port) = self.graph.find(&expectation.port, place.clone()) else { continue };
            let asks_cpu = matches!(expectation.change, Change::CpuReference(_));
            let without = || self.without_reference(port).filter(|_| asks_cpu);
            let unseen = || expectation.change.metric().and_then(|by| self.unseen(port, &by));
            if let Some((code, why)) = without().or_else(unseen) {
                self.out.push(Diagnostic::error(code, place, why));
            }
        }
    }

    fn without_reference(&self, port: PortRef) -> Option<(tyndall_document::Code, String)> {
        let pass = &self.graph.pass(port.pass).descriptor().name;
        let message = format!("`{pass}` has no reference on the CPU");
        (!(self.has_reference)(pass)).then_some((codes::NO_REFERENCE, message))
    }

    fn tapped(&mut self, port: PortRef) -> Option<Tapped> {
        let name = self.graph.port_name(port);
        let mut tapped = Tapped { port, name, golden: None, reference: None, properties: Vec::new() };
        let mut found = false;
        for tap in self.file.taps.iter().filter(|tap| matches(&tap.pattern, &tapped.name)) {
            found = true;
            tapped.golden = tap.golden.clone().or(tapped.golden);
            tapped.reference = tap.reference.clone().or(tapped.reference);
            for property in &tap.properties {
                match self.unfit(port, &property.value) {
                    None => tapped.properties.push(property.value.clone()),
                    Some(_) if tap.pattern.contains('*') => {}
                    Some((code, why)) => {
                        self.out.push(Diagnostic::error(code, self.file.place(property.span), why));
                    }
                }
            }
        }
        let golden = tapped.golden.as_ref().map(|golden| (golden.metric, golden.span));
        let reference = tapped.reference.as_ref().map(|reference| (reference.metric, reference.span));
        for (metric, span) in golden.into_iter().chain(reference) {
            if let Some((code, why)) = self.unseen(port, &metric) {
                let problem = Diagnostic::error(code, self.file.place(span), why);
                self.out.push(problem.suggest("give it RelativeRmse, in a tap that stands later"));
            }
        }
        found.then_some(tapped)
    }

    /// Why FLIP cannot be used for a port.
    fn unseen(&self, port: PortRef, metric: &Metric) -> Option<(tyndall_document::Code, String)> {
        let is_unseen = matches!(metric, Metric::Flip { .. })
            && class(self.graph, port).is_some_and(|class| class != Class::Display);
        let message = || format!("FLIP says what a person sees, and `{}` is for no eye", self.graph.port_name(port));
        is_unseen.then(|| (codes::WRONG_CHECK, message()))
    }

    /// Why a property cannot be asked of a port, where it cannot.
    fn unfit(&self, port: PortRef, property: &Property) -> Option<(tyndall_document::Code, String)> {
        let name = self.graph.port_name(port);
        let class = class(self.graph, port);
        let wrong = |what: &str| Some((codes::WRONG_CHECK, format!("`{name}` {what}")));
        let place = || Place::Argument(String::new());
        let is_itself = |other: &String| self.graph.find(other, place()).is_ok_and(|other| other == port);
        match property {
            _ if matches!(property.ports(), [other] if is_itself(other)) => {
                Some((codes::VACUOUS_CHECK, format!("`{name}` is held against itself")))
            }
            Property::AlphaOne if !matches!(class, Some(Class::Color | Class::Display)) => {
                wrong("is not a colour, so it has no alpha")
            }
            Property::UnitLength { .. } if class != Some(Class::Vector) => wrong("holds no vectors"),
            Property::CpuReference { by } => self.without_reference(port).or_else(|| self.unseen(port, by)),
            _ => property.metric().and_then(|by| self.unseen(port, &by)),
        }
    }
}

/// What the channels of a port mean, where its descriptor says.
fn class(graph: &Graph, port: PortRef) -> Option<Class> {
    match &graph.port(port).kind {
        PortKind::Texture { class, .. } if *class != Class::Any => Some(*class),
        PortKind::Texture { .. } => None,
        PortKind::Buffer { .. } | PortKind::Value { .. } => Some(Class::Data),
    }
}

/// Whether a pattern matches a name; `*` stands for any characters.
pub(crate) fn matches(pattern: &str, name: &str) -> bool {
    let Some((head, rest)) = pattern.split_once('*') else { return pattern == name };
    let (parts, last) = rest.rsplit_once('*').unwrap_or(("", rest));
    let Some(mut left) = name.strip_prefix(head) else { return false };
    // The first place where a part stands leaves the most for those after it.
    for part in parts.split('*') {
        let Some(at) = left.find(part) else { return false };
        left = &left[at + part.len()..];
    }
    left.ends_with(last)
}

#[cfg(test)]
mod tests {
    use super::matches;

    #[test]
    fn patterns() {
        for (pattern, name) in [
            ("*", "a.b"),
            ("a.*", "a.b"),
            ("*.b", "a.b"),
            ("a.b", "a.b"),
            ("a*.b*", "air.bee"),
            ("a*b*b", "abb"),
            ("**", ""),
        ] {
            assert!(matches(pattern, name), "{pattern} {name}");
        }
        for (pattern, name) in
            [("a.*", "b.a"), ("*.b", "a.bee"), ("a.b", "a.bb"), ("a.*c", "a.cb"), ("ab*ba", "aba"), ("a*b*b", "ab")]
        {
            assert!(!matches(pattern, name), "{pattern} {name}");
        }
    }
}
