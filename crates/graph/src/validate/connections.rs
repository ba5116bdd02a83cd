//! Inputs of passes, and the ports that feed them.

use tyndall_document::{Diagnostic, Span};

use super::Validator;
use crate::catalogue::Kind;
use crate::codes;
use crate::descriptor::{PortDescriptor, Role};
use crate::file::{InputEntry, PassEntry, Text};
use crate::graph::{Connection, Pass, PortRef};
use crate::handle::Handle;
use crate::signature::RoleKind;
use crate::wiring::Feed;

impl<'a> Validator<'a> {
    /// Connects what the file feeds to a pass, and reports what it leaves out.
    pub(super) fn connect(&mut self, pass: Handle<Pass>, entry: &'a PassEntry) {
        let kind = self.kind_of(pass);
        let known = self.is_known_pass(pass);
        for input in &entry.inputs {
            let source = input.from.as_ref().and_then(|from| self.source(from));
            if !known {
                continue;
            }
            let Some(port) = self.input(kind, input) else { continue };
            let number = self.wiring.port(PortRef { pass, port });
            self.named[number] = true;
            if let Some((from, span)) = source {
                self.join(from, PortRef { pass, port }, kind.signature.ports[port].role, span);
            }
        }
        for (number, (port, signature)) in self.wiring.ports[pass].handles().zip(kind.signature.ports.entries()) {
            match signature.role {
                RoleKind::Output => {}
                _ if self.named[number] => {}
                RoleKind::Optional => self.written[number] = Feed::Constant(number),
                RoleKind::Input | RoleKind::History | RoleKind::InOut => {
                    self.missing_input(kind, port, &entry.name);
                }
            }
        }
    }

    fn join(&mut self, from: PortRef, to: PortRef, role: RoleKind, span: Span) {
        let history = role == RoleKind::History;
        let number = self.wiring.port(to);
        self.written[number] = Feed::Port(self.wiring.port(from));
        if history {
            self.wiring.history.push(number);
        }
        self.wiring.connection_to[number] = Some(self.connections.push(Connection { from, to, history, span }));
    }

    /// The input that an entry names.
    fn input(&mut self, kind: &'a Kind, input: &'a InputEntry) -> Option<Handle<PortDescriptor>> {
        let descriptor = &kind.descriptor;
        let name = self.file.text(&input.name);
        let found = descriptor.port_named(name);
        let place = self.place(input.name.span);
        match found {
            Some(port) if descriptor.ports[port].role.is_input() => return Some(port),
            Some(_) => {
                let message = format!("`{name}` is an output of `{}`, and cannot be fed", descriptor.name);
                let inputs: Vec<String> = descriptor.inputs().map(|port| format!("`{}`", port.name)).collect();
                let suggestion = match inputs.is_empty() {
                    true => "the pass has no inputs".to_owned(),
                    false => format!("its inputs are {}", inputs.join(", ")),
                };
                self.report(Diagnostic::error(codes::NOT_AN_INPUT, place, message).suggest(suggestion));
            }
            None => {
                let message = format!("`{}` has no input named `{name}`", descriptor.name);
                let inputs = descriptor.inputs().map(|port| port.name.as_str());
                self.report_unknown((codes::UNKNOWN_PORT, place), message, name, inputs, str::to_owned);
            }
        }
        None
    }

    /// The port that `pass.port` means, and where it stands.
    pub(super) fn source(&mut self, from: &'a Text) -> Option<(PortRef, Span)> {
        let Some((pass_name, port_name)) = self.file.text(from).split_once('.') else {
            self.bad_reference(from);
            return None;
        };
        let Some(pass) = self.pass_named(pass_name) else {
            self.unknown_reference(from, pass_name, port_name);
            return None;
        };
        let kind = self.kind_of(pass);
        match kind.descriptor.port_named(port_name) {
            Some(port) if kind.signature.ports[port].role.is_output() => Some((PortRef { pass, port }, from.span)),
            _ if !self.is_known_pass(pass) => None,
            found => {
                self.no_output(from, pass, kind, found.is_some());
                None
            }
        }
    }

    fn bad_reference(&mut self, from: &'a Text) {
        let name = self.file.text(from);
        let message = format!("`{name}` names no port");
        let place = self.place(from.span);
        let mut diagnostic = Diagnostic::error(codes::BAD_REFERENCE, place, message);
        let kind = self.pass_named(name).map(|pass| self.kind_of(pass));
        let port = kind.and_then(|kind| kind.descriptor.outputs().next());
        diagnostic = diagnostic.suggest(match port {
            Some(port) => format!("write pass.port: `{name}.{}`", port.name),
            None => "write pass.port".to_owned(),
        });
        self.report(diagnostic);
    }

    fn unknown_reference(&mut self, from: &'a Text, pass: &str, port: &str) {
        let message = format!("there is no pass named `{pass}`");
        let place = self.place(from.span);
        let names = self.pass_names();
        self.report_unknown((codes::UNKNOWN_REFERENCE, place), message, pass, names, |near| format!("{near}.{port}"));
    }

    fn no_output(&mut self, from: &'a Text, pass: Handle<Pass>, kind: &'a Kind, is_input: bool) {
        let file = self.file;
        let entry = &file.passes[pass];
        let (pass_name, kind_name) = (file.text(&entry.name), &kind.descriptor.name);
        let port = &file.text(from)[pass_name.len() + 1..];
        let place = self.place(from.span);
        let outputs = kind.descriptor.outputs().map(|port| port.name.as_str());
        if is_input {
            let message = format!("`{port}` is an input of `{kind_name}`, and nothing can be read from it");
            let outputs: Vec<String> = outputs.map(|port| format!("`{pass_name}.{port}`")).collect();
            let related = self.place(entry.name.span);
            let diagnostic = Diagnostic::error(codes::NOT_AN_OUTPUT, place, message)
                .suggest(format!("what it writes is {}", outputs.join(", ")))
                .relate(related, format!("`{pass_name}` stands here"));
            return self.report(diagnostic);
        }
        let message = format!("`{kind_name}` has no output named `{port}`");
        self.report_unknown((codes::UNKNOWN_PORT, place), message, port, outputs, |near| format!("{pass_name}.{near}"));
    }

    fn missing_input(&mut self, kind: &Kind, port: Handle<PortDescriptor>, name: &Text) {
        let port = &kind.descriptor.ports[port];
        let message =
            format!("`{}` needs the input `{}` of `{}`", self.file.text(name), port.name, kind.descriptor.name);
        let place = self.place(name.span);
        let suggestion = match &port.role {
            Role::History(_) => {
                format!("feed it with what it should hold of the frame before: \"{}\": \"pass.port\"", port.name)
            }
            _ => format!("add \"{}\": \"pass.port\" to its inputs", port.name),
        };
        self.report(Diagnostic::error(codes::MISSING_INPUT, place, message).suggest(suggestion));
    }

    pub(super) fn kind_of(&self, pass: Handle<Pass>) -> &'a Kind {
        self.kinds[self.wiring.kind_of[pass]]
    }
}
