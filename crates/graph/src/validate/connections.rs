//! Inputs of passes, and the ports that feed them.

use tyndall_document::Diagnostic;

use super::mistakes::Mistakes;
use super::scope::Scope;
use crate::codes;
use crate::descriptor::{PassDescriptor, PortDescriptor, Role};
use crate::file::{InputEntry, PassEntry, Text};
use crate::graph::{Connection, Pass, PortRef};
use crate::handle::{Handle, Table};
use crate::signature::RoleKind;
use crate::wiring::{Feed, Feeds, GraphPort};

/// What feeds the ports of a graph as it is written, as if every pass were enabled.
pub(super) struct Connections {
    pub list: Table<Connection>,
    pub to: Table<GraphPort, Option<Handle<Connection>>>,
    pub written: Feeds,
    /// The history ports that are connected.
    pub history: Vec<Handle<GraphPort>>,
}

/// Makes the connections of the file, and reports missing ones.
pub(super) fn connect(scope: &Scope<'_>, out: &mut Mistakes) -> Connections {
    let ports = &scope.passes.pass_of;
    let mut connections = Connections {
        list: Table::with_capacity(scope.file.passes.iter().map(|pass| pass.inputs.len()).sum()),
        to: ports.column(None),
        written: ports.column(Feed::Nothing),
        history: Vec::new(),
    };
    let mut is_named = ports.column(false);
    for (pass, entry) in scope.file.passes.entries() {
        for input in &entry.inputs {
            let from = input.from.as_ref().and_then(|from| Some((written(scope, from, out)?, from)));
            let Some(to) = input_port(scope, pass, input, out) else { continue };
            is_named[scope.passes.port(to)] = true;
            if let Some((port, from)) = from {
                let history = scope.passes.kind(pass).signature.ports[to.port].role == RoleKind::History;
                connections.join(scope, Connection { from: port, to, history, span: from.span });
            }
        }
        for (port, signature) in scope.passes.ports_of(pass).filter(|(port, _)| !is_named[*port]) {
            match signature.role {
                RoleKind::Output => {}
                RoleKind::Optional => connections.written[port] = Feed::Constant(port),
                RoleKind::Input | RoleKind::History | RoleKind::InOut => {
                    out.report(missing_input(scope, pass, entry, scope.passes.descriptor(port)));
                }
            }
        }
    }
    connections
}

/// The outputs of the graph that name a port.
pub(super) fn outputs(scope: &Scope<'_>, out: &mut Mistakes) -> Vec<(String, PortRef)> {
    let file = scope.file;
    if file.outputs.is_empty() && !file.broken {
        let message = "the graph has no outputs, so nothing would be drawn";
        let suggestion = "add outputs: { \"image\": \"pass.port\" }";
        let place = scope.place(file.outputs_span);
        out.report(Diagnostic::error(codes::NO_OUTPUTS, place, message).suggest(suggestion));
    }
    let outputs = file.outputs.iter();
    outputs
        .filter_map(|output| Some((file.text(&output.name).to_owned(), written(scope, &output.from, out)?)))
        .collect()
}

impl Connections {
    fn join(&mut self, scope: &Scope<'_>, connection: Connection) {
        let port = scope.passes.port(connection.to);
        if connection.history {
            self.history.push(port);
        }
        self.written[port] = Feed::Port(scope.passes.port(connection.from));
        self.to[port] = Some(self.list.push(connection));
    }
}

/// The port that an entry of a pass's inputs names. Nothing is reported of a pass whose kind is unknown.
fn input_port(scope: &Scope<'_>, pass: Handle<Pass>, input: &InputEntry, out: &mut Mistakes) -> Option<PortRef> {
    let descriptor = &scope.passes.kind(pass).descriptor;
    let name = scope.file.text(&input.name);
    match descriptor.port_named(name) {
        Some(port) if descriptor.ports[port].role.is_input() => return Some(PortRef { pass, port }),
        Some(_) => out.report(not_an_input(scope, descriptor, &input.name)),
        None if !scope.is_known(pass) => {}
        None => {
            let message = format!("`{}` has no input `{name}`", descriptor.name);
            let inputs = descriptor.inputs().map(|port| port.name.as_str());
            let code = (codes::UNKNOWN_PORT, scope.place(input.name.span));
            out.report_unknown(code, message, name, inputs, str::to_owned);
        }
    }
    None
}

fn not_an_input(scope: &Scope<'_>, descriptor: &PassDescriptor, name: &Text) -> Diagnostic {
    let port = scope.file.text(name);
    let message = format!("`{port}` is an output of `{}`, so nothing can be connected to it", descriptor.name);
    let inputs = descriptor.inputs().map(|port| port.name.as_str());
    Diagnostic::error(codes::NOT_AN_INPUT, scope.place(name.span), message).suggest_available(inputs)
}

fn missing_input(scope: &Scope<'_>, pass: Handle<Pass>, entry: &PassEntry, port: &PortDescriptor) -> Diagnostic {
    let kind = &scope.passes.kind(pass).descriptor.name;
    let message = format!("`{}` needs the input `{}` of `{kind}`", scope.file.text(&entry.name), port.name);
    let suggestion = match &port.role {
        Role::History(_) => {
            format!("connect what it should hold of the frame before: \"{}\": \"pass.port\"", port.name)
        }
        _ => format!("add \"{}\": \"pass.port\" to its inputs", port.name),
    };
    Diagnostic::error(codes::MISSING_INPUT, scope.place(entry.name.span), message).suggest(suggestion)
}

/// The port that `pass.port` means, which the pass writes.
fn written(scope: &Scope<'_>, from: &Text, out: &mut Mistakes) -> Option<PortRef> {
    let Some((pass_name, port_name)) = scope.file.text(from).split_once('.') else {
        out.report(bad_reference(scope, from));
        return None;
    };
    let Some(pass) = scope.pass_named(pass_name) else {
        let message = format!("there is no pass `{pass_name}`");
        let code = (codes::UNKNOWN_REFERENCE, scope.place(from.span));
        out.report_unknown(code, message, pass_name, scope.pass_names(), |near| format!("{near}.{port_name}"));
        return None;
    };
    let descriptor = &scope.passes.kind(pass).descriptor;
    match descriptor.port_named(port_name) {
        Some(port) if descriptor.ports[port].role.is_output() => return Some(PortRef { pass, port }),
        Some(_) => out.report(not_an_output(scope, pass, from, port_name)),
        None if !scope.is_known(pass) => {}
        None => {
            let message = format!("`{}` has no output `{port_name}`", descriptor.name);
            let outputs = descriptor.outputs().map(|port| port.name.as_str());
            let code = (codes::UNKNOWN_PORT, scope.place(from.span));
            out.report_unknown(code, message, port_name, outputs, |near| format!("{pass_name}.{near}"));
        }
    }
    None
}

fn bad_reference(scope: &Scope<'_>, from: &Text) -> Diagnostic {
    let name = scope.file.text(from);
    let pass = scope.pass_named(name).map(|pass| &scope.passes.kind(pass).descriptor);
    let suggestion = match pass.and_then(|descriptor| descriptor.outputs().next()) {
        Some(port) => format!("write pass.port: `{name}.{}`", port.name),
        None => "write pass.port".to_owned(),
    };
    let message = format!("`{name}` is not of the form pass.port");
    Diagnostic::error(codes::BAD_REFERENCE, scope.place(from.span), message).suggest(suggestion)
}

fn not_an_output(scope: &Scope<'_>, pass: Handle<Pass>, from: &Text, port: &str) -> Diagnostic {
    let descriptor = &scope.passes.kind(pass).descriptor;
    let name = scope.name(pass);
    let message = format!("`{port}` is an input of `{}`, so it cannot be read", descriptor.name);
    Diagnostic::error(codes::NOT_AN_OUTPUT, scope.place(from.span), message)
        .suggest_available(descriptor.outputs().map(|port| format!("{name}.{}", port.name)))
        .relate(scope.place_of(pass), format!("`{name}` is here"))
}
