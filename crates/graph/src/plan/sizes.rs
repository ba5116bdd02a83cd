//! How large every port is.

use crate::graph::{Graph, ParamRef, Pass, PortRef};
use crate::handle::{Handle, Table};
use crate::signature::{Amount, PortSignature, RoleKind, Rule};
use crate::wiring::{Feeds, GraphPort};

/// Width, height, depth or layers. All 0 if a mistake hides it.
pub(crate) type Size = [u32; 3];

/// The size of every port.
pub(crate) type Sizes = Table<GraphPort, Size>;

const UNKNOWN: Size = [0; 3];

/// What is wrong with a size.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum SizeProblem {
    /// An input demands another size than that of the port connected to it.
    Differs { port: PortRef, fed: Size, demanded: Size },
    /// A parameter that sets a size is below 1 or exceeds 32 bits.
    Param { param: ParamRef, value: i64 },
    /// A file parameter that sets a size does not name a picture of known size.
    Picture { param: ParamRef },
}

/// The size of every port, and problems with sizes.
///
/// `feeds` is that of the graph, or of the graph as written with every pass switched on.
pub(crate) fn sizes(graph: &Graph, feeds: &Feeds, frame: (u32, u32)) -> (Sizes, Vec<SizeProblem>) {
    let mut resolver = Resolver { graph, feeds, frame, sizes: feeds.column(UNKNOWN), problems: Vec::new() };
    for pass in &graph.wiring.order {
        resolver.pass(*pass);
    }
    for port in &graph.wiring.history {
        resolver.history(*port);
    }
    (resolver.sizes, resolver.problems)
}

struct Resolver<'a> {
    graph: &'a Graph,
    feeds: &'a Feeds,
    frame: (u32, u32),
    sizes: Sizes,
    problems: Vec<SizeProblem>,
}

impl Resolver<'_> {
    fn pass(&mut self, pass: Handle<Pass>) {
        let passes = &self.graph.wiring.passes;
        let (signature, ports) = (&passes.kind(pass).signature, passes.ports[pass]);
        for port in &signature.size_order {
            let number = ports.at(*port);
            self.sizes[number] = self.port(pass, number, &signature.ports[*port]);
        }
        for port in &signature.demands {
            let of_port = &signature.ports[*port];
            if of_port.role != RoleKind::History {
                self.demand(PortRef { pass, port: *port }, of_port);
            }
        }
    }

    fn port(&mut self, pass: Handle<Pass>, number: Handle<GraphPort>, port: &PortSignature) -> Size {
        if port.role != RoleKind::Output {
            match self.feeds[number].like() {
                Some(source) if source != number => return self.sizes[source],
                None => return UNKNOWN,
                Some(_) => {}
            }
        }
        self.evaluate(pass, port.rule.as_ref().unwrap_or(&Rule::Frame), port.axes)
    }

    fn history(&mut self, number: Handle<GraphPort>) {
        let port = self.graph.wiring.passes.port_ref(number);
        if let Some(source) = self.feeds[number].like() {
            self.sizes[number] = self.sizes[source];
        }
        self.demand(port, self.graph.signature(port));
    }

    fn demand(&mut self, port: PortRef, of_port: &PortSignature) {
        let (Some(rule), axes) = (of_port.rule.as_ref(), of_port.axes) else { return };
        let number = self.graph.wiring.passes.port(port);
        let fed = self.sizes[number];
        if fed == UNKNOWN || self.feeds[number].like() == Some(number) {
            return;
        }
        let demanded = self.evaluate(port.pass, rule, axes);
        if demanded != UNKNOWN && demanded != cut(fed, axes) {
            self.problems.push(SizeProblem::Differs { port, fed, demanded });
        }
    }

    fn evaluate(&mut self, pass: Handle<Pass>, rule: &Rule, axes: usize) -> Size {
        match rule {
            Rule::Frame => cut([self.frame.0, self.frame.1, 1], axes),
            Rule::Same(other) => cut(self.sizes[self.graph.wiring.passes.ports[pass].at(*other)], axes),
            Rule::Other(amounts) => self.amounts(pass, amounts, axes),
        }
    }

    fn amounts(&mut self, pass: Handle<Pass>, amounts: &[Amount; 3], axes: usize) -> Size {
        let mut size = [1; 3];
        for (extent, amount) in size.iter_mut().zip(amounts).take(axes) {
            *extent = match *amount {
                Amount::Fixed(texels) => texels,
                Amount::Frame(axis, scale) => scaled(axis.of([self.frame.0, self.frame.1, 1]), scale),
                Amount::FramePixels(scale) => pixels(self.frame, scale),
                Amount::Port(other, axis, scale) => {
                    let other = self.sizes[self.graph.wiring.passes.ports[pass].at(other)];
                    if other == UNKNOWN {
                        return UNKNOWN;
                    }
                    scaled(axis.of(other), scale)
                }
                Amount::Param(param) => self.param(ParamRef { pass, param }),
                Amount::Picture(param, axis) => {
                    let param = ParamRef { pass, param };
                    let Some((width, height)) = self.graph.size_params.get(&param).and_then(|set| set.picture) else {
                        self.problem(SizeProblem::Picture { param });
                        return UNKNOWN;
                    };
                    axis.of([width, height, 1])
                }
            };
        }
        size
    }

    fn param(&mut self, param: ParamRef) -> u32 {
        let value = self.graph.size_param(param);
        u32::try_from(value).ok().filter(|extent| *extent > 0).unwrap_or_else(|| {
            self.problem(SizeProblem::Param { param, value });
            1
        })
    }

    fn problem(&mut self, problem: SizeProblem) {
        if !self.problems.contains(&problem) {
            self.problems.push(problem);
        }
    }
}

/// The extents that apply, and 1 in place of the others.
fn cut(size: Size, axes: usize) -> Size {
    if size == UNKNOWN {
        return UNKNOWN;
    }
    let [width, height, depth] = size;
    match axes {
        0 => [1; 3],
        1 => [width, 1, 1],
        2 => [width, height, 1],
        _ => [width, height, depth],
    }
}

/// Rounded up, at least 1, and at most the largest number of 32 bits.
fn scaled(extent: u32, scale: f64) -> u32 {
    if scale == 1.0 { extent } else { ((f64::from(extent) * scale).ceil() as u32).max(1) }
}

fn pixels(frame: (u32, u32), scale: f64) -> u32 {
    ((f64::from(frame.0) * f64::from(frame.1) * scale).ceil() as u32).max(1)
}
