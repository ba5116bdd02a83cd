//! How large every port is.

use crate::graph::{Graph, ParamRef};
use crate::signature::{Amount, RoleKind, Rule, Signature};
use crate::table::{Feed, Table};

/// Width, height, depth or layers. All 0: a mistake hides it.
pub(crate) type Size = [u32; 3];

const UNKNOWN: Size = [0; 3];

/// What is wrong with a size.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum SizeProblem {
    /// An input demands another size than it is fed.
    Differs { port: u32, fed: Size, demanded: Size },
    /// A parameter that sets a size is below 1 or beyond 32 bits.
    Param { pass: u32, param: u32, value: i64 },
    /// A file parameter that sets a size names no picture whose size is known.
    Picture { pass: u32, param: u32 },
}

/// The size of every port by its number, and what is wrong with them.
///
/// `feeds` is the table's, or that of the graph as written with every pass switched on.
pub(crate) fn sizes(graph: &Graph, feeds: &[Feed], frame: (u32, u32)) -> (Vec<Size>, Vec<SizeProblem>) {
    let table = &graph.table;
    let mut resolver = Resolver { graph, feeds, frame, sizes: vec![UNKNOWN; feeds.len()], problems: Vec::new() };
    for pass in &table.order {
        resolver.pass(*pass);
    }
    for port in &table.history {
        resolver.history(*port);
    }
    (resolver.sizes, resolver.problems)
}

struct Resolver<'a> {
    graph: &'a Graph,
    feeds: &'a [Feed],
    frame: (u32, u32),
    sizes: Vec<Size>,
    problems: Vec<SizeProblem>,
}

impl Resolver<'_> {
    fn pass(&mut self, pass: u32) {
        let table = &self.graph.table;
        let signature = &table.kind(pass).signature;
        let first = table.first_port[pass as usize];
        for index in &signature.size_order {
            let port = first + index;
            self.sizes[port as usize] = self.port(pass, first, port, signature, *index);
        }
        for index in &signature.demands {
            if signature.ports[*index as usize].role != RoleKind::History {
                self.demand(table, pass, first + index, *index);
            }
        }
    }

    fn port(&mut self, pass: u32, first: u32, port: u32, signature: &Signature, index: u32) -> Size {
        let of_port = &signature.ports[index as usize];
        if of_port.role != RoleKind::Output {
            match self.feeds[port as usize].number() {
                Some(source) if source != port => return self.sizes[source as usize],
                None => return UNKNOWN,
                Some(_) => {}
            }
        }
        let rule = of_port.rule.as_ref().unwrap_or(&Rule::Frame);
        self.evaluate(pass, first, rule, of_port.axes)
    }

    fn history(&mut self, port: u32) {
        let table = &self.graph.table;
        let pass = table.pass_of[port as usize];
        let index = port - table.first_port[pass as usize];
        if let Some(source) = self.feeds[port as usize].number() {
            self.sizes[port as usize] = self.sizes[source as usize];
        }
        if table.kind(pass).signature.ports[index as usize].rule.is_some() {
            self.demand(table, pass, port, index);
        }
    }

    fn demand(&mut self, table: &Table, pass: u32, port: u32, index: u32) {
        let of_port = &table.kind(pass).signature.ports[index as usize];
        let (Some(rule), axes) = (of_port.rule.as_ref(), of_port.axes) else { return };
        let fed = self.sizes[port as usize];
        if fed == UNKNOWN || self.feeds[port as usize].number() == Some(port) {
            return;
        }
        let demanded = self.evaluate(pass, table.first_port[pass as usize], rule, axes);
        if demanded != UNKNOWN && demanded != cut(fed, axes) {
            self.problems.push(SizeProblem::Differs { port, fed, demanded });
        }
    }

    fn evaluate(&mut self, pass: u32, first: u32, rule: &Rule, axes: u32) -> Size {
        match rule {
            Rule::Frame => cut([self.frame.0, self.frame.1, 1], axes),
            Rule::Same(other) => cut(self.sizes[(first + other) as usize], axes),
            Rule::Other(amounts) => self.amounts(pass, first, amounts, axes),
        }
    }

    fn amounts(&mut self, pass: u32, first: u32, amounts: &[Amount; 3], axes: u32) -> Size {
        let mut size = [1; 3];
        for (extent, amount) in size.iter_mut().zip(amounts).take(axes as usize) {
            *extent = match *amount {
                Amount::Fixed(texels) => texels,
                Amount::Frame(axis, scale) => scaled([self.frame.0, self.frame.1, 1][axis], scale),
                Amount::FramePixels(scale) => pixels(self.frame, scale),
                Amount::Port(other, axis, scale) => {
                    let other = self.sizes[(first + other) as usize];
                    if other == UNKNOWN {
                        return UNKNOWN;
                    }
                    scaled(other[axis], scale)
                }
                Amount::Param(param) => self.param(pass, param),
                Amount::Picture(param, axis) => match self.graph.pictures.get(&ParamRef { pass, param }) {
                    Some(&(width, height)) => [width, height, 1][axis],
                    None => {
                        self.problem(SizeProblem::Picture { pass, param });
                        return UNKNOWN;
                    }
                },
            };
        }
        size
    }

    fn param(&mut self, pass: u32, param: u32) -> u32 {
        let value = self.graph.size_param(pass, param);
        u32::try_from(value).ok().filter(|extent| *extent > 0).unwrap_or_else(|| {
            self.problem(SizeProblem::Param { pass, param, value });
            1
        })
    }

    fn problem(&mut self, problem: SizeProblem) {
        if !self.problems.contains(&problem) {
            self.problems.push(problem);
        }
    }
}

/// The extents that mean something, and 1 in place of the others.
fn cut(size: Size, axes: u32) -> Size {
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

/// Rounded up, at least 1, at most what 32 bits hold.
fn scaled(extent: u32, scale: f64) -> u32 {
    if scale == 1.0 { extent } else { ((f64::from(extent) * scale).ceil() as u32).max(1) }
}

fn pixels(frame: (u32, u32), scale: f64) -> u32 {
    ((f64::from(frame.0) * f64::from(frame.1) * scale).ceil() as u32).max(1)
}
