//! Sizes that do not agree, in words.

use petgraph::Direction;
use petgraph::graph::NodeIndex;
use tyndall_document::Diagnostic;

use super::Validator;
use crate::codes;
use crate::descriptor::ParamValue;
use crate::graph::{Connection, Graph, ParamRef, ParamSetting, PortRef};
use crate::plan::sizes::{Size, SizeProblem, sizes};

impl Validator<'_> {
    /// Checks the sizes that the frame's size gives: of the graph as written, and with its switches.
    pub(super) fn check_sizes(&mut self, graph: &Graph) {
        if graph.size.0 == 0 || graph.size.1 == 0 {
            return;
        }
        let (_, mut problems) = sizes(graph, &self.written, graph.size);
        if graph.table.enabled.contains(&false) {
            let (_, switched) = sizes(graph, &graph.table.feeds, graph.size);
            problems.extend(switched.into_iter().filter(|problem| !same_port(&problems, problem)).collect::<Vec<_>>());
        }
        for mistake in size_mistakes(graph, &problems) {
            self.report(mistake);
        }
    }
}

fn same_port(problems: &[SizeProblem], problem: &SizeProblem) -> bool {
    let SizeProblem::Differs { port, .. } = problem else { return problems.contains(problem) };
    problems.iter().any(|other| matches!(other, SizeProblem::Differs { port: other, .. } if other == port))
}

/// Wrong sizes in words, at the connection or the parameter.
pub(crate) fn size_mistakes(graph: &Graph, problems: &[SizeProblem]) -> Vec<Diagnostic> {
    problems.iter().filter_map(|problem| mistake(graph, problem)).collect()
}

fn mistake(graph: &Graph, problem: &SizeProblem) -> Option<Diagnostic> {
    match *problem {
        SizeProblem::Differs { port, fed, demanded } => differs(graph, port, fed, demanded),
        SizeProblem::Param { pass, param, value } => {
            let of_pass = graph.pass(pass);
            let name = &of_pass.descriptor().params[param as usize].name;
            let message = format!("`{name}` sets the size of a port, and {value} is none");
            let place = graph.size_param_places.get(&ParamRef { pass, param }).cloned();
            let place = place.unwrap_or_else(|| graph.place(of_pass.span));
            Some(Diagnostic::error(codes::BAD_SIZE, place, message).suggest("give a number of 1 or more"))
        }
        SizeProblem::Picture { pass, param } => {
            let of_pass = graph.pass(pass);
            let name = &of_pass.descriptor().params[param as usize].name;
            let message = match &of_pass.params[param as usize] {
                ParamSetting::Value(ParamValue::File(path)) if !path.is_empty() => {
                    format!("`{name}` names {path}, which is no picture that can be read")
                }
                _ => format!("`{name}` of pass `{}` names no picture", of_pass.name),
            };
            let place = graph.size_param_places.get(&ParamRef { pass, param }).cloned();
            let place = place.unwrap_or_else(|| graph.place(of_pass.span));
            Some(
                Diagnostic::error(codes::BAD_PICTURE, place, message)
                    .suggest("give the path of an EXR, HDR, PNG or NPY file"),
            )
        }
    }
}

fn differs(graph: &Graph, number: u32, fed: Size, demanded: Size) -> Option<Diagnostic> {
    let pass = graph.table.pass_of[number as usize];
    let index = number - graph.table.first_port[pass as usize];
    let (connection, writer) = connection(graph, pass, index)?;
    let port = &graph.pass(pass).descriptor().ports[index as usize];
    let axes = graph.table.kind(pass).signature.ports[index as usize].axes as usize;
    let rule = port.size.as_ref().map(ToString::to_string).unwrap_or_default();
    let (demanded, fed) = (size_words(&demanded[..axes]), size_words(&fed[..axes]));
    let message = if rule.starts_with(|first: char| first.is_ascii_digit()) {
        format!("`{}` must be {demanded}, and this is {fed}", port.name)
    } else {
        format!("`{}` must be {demanded} ({rule}), and this is {fed}", port.name)
    };
    let diagnostic = Diagnostic::error(codes::WRONG_SIZE, graph.place(connection.span), message);
    let port = graph.port_name(PortRef { pass: writer, port: connection.from });
    Some(diagnostic.relate(graph.place(graph.pass(writer).span), format!("`{port}` is written here")))
}

/// The connection that feeds a port, and the pass that writes it.
fn connection(graph: &Graph, pass: u32, port: u32) -> Option<(&Connection, u32)> {
    use petgraph::visit::EdgeRef;
    let inputs = graph.passes.edges_directed(NodeIndex::new(pass as usize), Direction::Incoming);
    let edge = inputs.into_iter().find(|edge| edge.weight().to == port)?;
    Some((edge.weight(), edge.source().index() as u32))
}

/// `640×480`, `4096 elements`.
fn size_words(size: &[u32]) -> String {
    match size {
        [elements] => format!("{elements} elements"),
        _ => size.iter().map(ToString::to_string).collect::<Vec<_>>().join("×"),
    }
}
