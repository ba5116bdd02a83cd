//! Why something in a plan is as it is.

mod pass;
mod port;
mod sizes;

use tyndall_document::{Diagnostic, Place};

use crate::codes;
use crate::graph::PortRef;
use crate::plan::Plan;

/// Explains a pass, a `pass.port` or an output of the graph: why it was culled or ordered where it is, and why a port has
/// its size, format and slot, and which others share the slot.
///
/// # Errors
/// `unknown-reference`, `unknown-port` or `unknown-output` at the argument, if nothing has this name.
pub fn explain(plan: &Plan, name: &str) -> Result<String, Diagnostic> {
    let graph = &plan.graph;
    if let Some((pass, port)) = name.split_once('.')
        && let Some(pass) = graph.pass_named(pass)
        && let Some(port) = graph.pass(pass).descriptor().port_named(port)
    {
        return Ok(port::explain(plan, PortRef { pass, port }));
    }
    if let Some(pass) = graph.pass_named(name) {
        return Ok(pass::explain(plan, pass));
    }
    if let Some((_, port)) = graph.outputs.iter().find(|(output, _)| output == name) {
        let text = port::explain(plan, *port);
        return Ok(format!("The output `{name}` is {}.\n\n{text}", graph.port_name(*port)));
    }
    Err(unknown(plan, name))
}

fn unknown(plan: &Plan, name: &str) -> Diagnostic {
    let graph = &plan.graph;
    let place = Place::Argument(name.to_owned());
    if name.contains('.') {
        let mistake = graph.find(name, place.clone()).err();
        return mistake.unwrap_or_else(|| Diagnostic::error(codes::UNKNOWN_PORT, place, "there is no such port"));
    }
    let message = format!("the graph has neither a pass nor an output `{name}`");
    let outputs = graph.outputs.iter().map(|(output, _)| output.as_str());
    let otherwise = "name a pass, a `pass.port` or an output; `show` lists them";
    Diagnostic::error(codes::UNKNOWN_REFERENCE, place, message).suggest_near_or(
        name,
        graph.pass_names().chain(outputs),
        otherwise,
    )
}

/// A heading and its lines.
struct Report {
    text: String,
}

impl Report {
    fn new(title: String) -> Self {
        Self { text: title + "\n" }
    }

    /// A line `  what      words`.
    fn line(&mut self, what: &str, words: &str) {
        self.text += &format!("  {what:10} {words}\n");
    }

    /// Several of them, the first with its heading.
    fn lines(&mut self, what: &str, lines: &[String]) {
        for (index, line) in lines.iter().enumerate() {
            self.line(if index == 0 { what } else { "" }, line);
        }
    }
}

/// `1st`, `2nd`, `13th`.
fn ordinal(number: usize) -> String {
    let ending = match (number % 10, number % 100) {
        (1, rest) if rest != 11 => "st",
        (2, rest) if rest != 12 => "nd",
        (3, rest) if rest != 13 => "rd",
        _ => "th",
    };
    format!("{number}{ending}")
}
