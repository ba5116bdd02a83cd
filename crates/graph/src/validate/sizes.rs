//! Messages about sizes that do not agree.

use tyndall_document::{BAD_SIZE, Diagnostic, Place};

use crate::codes;
use crate::descriptor::ParamValue;
use crate::graph::{Graph, ParamRef, ParamSetting, PortRef};
use crate::plan::sizes::{Size, SizeProblem, sizes};
use crate::wiring::Feeds;

/// What is wrong with the sizes that the frame's size gives: of the graph as written, and with its switches.
pub(super) fn check(graph: &Graph, written: &Feeds) -> Vec<Diagnostic> {
    if graph.size.0 == 0 || graph.size.1 == 0 {
        return Vec::new();
    }
    let (_, mut problems) = sizes(graph, written, graph.size);
    if graph.wiring.feeds != *written {
        let (_, switched) = sizes(graph, &graph.wiring.feeds, graph.size);
        problems.extend(switched.into_iter().filter(|problem| !same_port(&problems, problem)).collect::<Vec<_>>());
    }
    size_mistakes(graph, &problems)
}

fn same_port(problems: &[SizeProblem], problem: &SizeProblem) -> bool {
    let SizeProblem::Differs { port, .. } = problem else { return problems.contains(problem) };
    problems.iter().any(|other| matches!(other, SizeProblem::Differs { port: other, .. } if other == port))
}

/// Messages about wrong sizes, at the connection or the parameter.
pub(crate) fn size_mistakes(graph: &Graph, problems: &[SizeProblem]) -> Vec<Diagnostic> {
    problems.iter().filter_map(|problem| mistake(graph, problem)).collect()
}

fn mistake(graph: &Graph, problem: &SizeProblem) -> Option<Diagnostic> {
    match *problem {
        SizeProblem::Differs { port, fed, demanded } => differs(graph, port, fed, demanded),
        SizeProblem::Param { param, value } => {
            let name = &graph.pass(param.pass).descriptor().params[param.param].name;
            let message = format!("`{name}` must be at least 1, because it sets the size of a port; got {value}");
            Some(Diagnostic::error(BAD_SIZE, place_of(graph, param), message))
        }
        SizeProblem::Picture { param } => {
            let of_pass = graph.pass(param.pass);
            let name = &of_pass.descriptor().params[param.param].name;
            let message = match &of_pass.params[param.param] {
                ParamSetting::Value(ParamValue::File(path)) if !path.is_empty() => {
                    format!("`{name}` names {path}, which is not a readable picture")
                }
                _ => format!("`{name}` of pass `{}` does not name a picture", of_pass.name),
            };
            let diagnostic = Diagnostic::error(codes::BAD_PICTURE, place_of(graph, param), message);
            Some(diagnostic.suggest("give the path of an EXR, HDR, PNG or NPY file"))
        }
    }
}

/// Where a parameter that sets a size is set; if it is not set, its pass.
fn place_of(graph: &Graph, param: ParamRef) -> Place {
    let place = graph.size_params.get(&param).map(|param| param.place.clone());
    place.unwrap_or_else(|| graph.place(graph.pass(param.pass).span))
}

fn differs(graph: &Graph, port: PortRef, fed: Size, demanded: Size) -> Option<Diagnostic> {
    let connection = graph.connection_to(port)?;
    let axes = graph.signature(port).axes;
    let port = graph.port(port);
    let rule = port.size.as_ref().map(ToString::to_string).unwrap_or_default();
    let (demanded, fed) = (size_words(&demanded[..axes]), size_words(&fed[..axes]));
    let message = if rule.starts_with(|first: char| first.is_ascii_digit()) {
        format!("`{}` must be {demanded}, but this is {fed}", port.name)
    } else {
        format!("`{}` must be {demanded} ({rule}), but this is {fed}", port.name)
    };
    let diagnostic = Diagnostic::error(codes::WRONG_SIZE, graph.place(connection.span), message);
    let writer = graph.place(graph.pass(connection.from.pass).span);
    Some(diagnostic.relate(writer, format!("`{}` is written here", graph.port_name(connection.from))))
}

/// `640×480`, `4096 elements`.
fn size_words(size: &[u32]) -> String {
    match size {
        [elements] => format!("{elements} elements"),
        _ => size.iter().map(ToString::to_string).collect::<Vec<_>>().join("×"),
    }
}
