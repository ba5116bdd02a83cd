//! A graph in which every name has been resolved and every value checked.

use std::sync::Arc;

use rustc_hash::FxHashMap;
use tyndall_document::{Diagnostic, Place, Source, Span, available};

use crate::catalogue::Kind;
use crate::codes;
use crate::descriptor::{ParamDescriptor, ParamValue, PassDescriptor, PortDescriptor};
use crate::handle::{Handle, Table};
use crate::names::Names;
use crate::signature::PortSignature;
use crate::wiring::Wiring;

/// A typed graph: passes joined by connections between their ports, as the file has them.
///
/// Made by [`validate`](crate::validate); never changed afterwards.
#[derive(Debug)]
pub struct Graph {
    /// The file that it came from.
    pub source: Arc<Source>,
    /// What the graph is for.
    pub about: String,
    /// The scene that the file names: a path that is relative to the working directory (or absolute).
    pub scene: Option<String>,
    /// Size of the frame in pixels: from the overrides, else from the file, else 640×480.
    pub size: (u32, u32),
    /// Graph parameters with the values that they have after overrides, in file order.
    pub params: Vec<GraphParam>,
    /// Passes in file order.
    pub passes: Table<Pass>,
    /// Connections in file order, each from a port that one pass writes to a port that another, or the same, reads.
    pub connections: Table<Connection>,
    /// Outputs in file order.
    pub outputs: Vec<(String, PortRef)>,
    pub(crate) names: Names<Pass>,
    /// The parameters that set sizes, and are set themselves.
    pub(crate) size_params: FxHashMap<ParamRef, SizeParam>,
    pub(crate) wiring: Wiring,
}

/// One pass of a graph.
#[derive(Debug)]
pub struct Pass {
    /// Name in the file.
    pub name: String,
    /// The place of the name.
    pub span: Span,
    /// Settings, one for each of the descriptor's parameters.
    pub params: Table<ParamDescriptor, ParamSetting>,
    /// Whether it is enabled.
    pub enabled: bool,
    /// The graph parameter that enables it, if there is one.
    pub switch: Option<String>,
    pub(crate) kind: Arc<Kind>,
}

impl Pass {
    /// What the pass declares.
    pub fn descriptor(&self) -> &Arc<PassDescriptor> {
        &self.kind.descriptor
    }
}

/// What a parameter of a pass is set to.
#[derive(Debug, Clone, PartialEq)]
pub enum ParamSetting {
    /// A value.
    Value(ParamValue),
    /// The number of the frame.
    Frame,
    /// The time of the frame in seconds: its number / 24.
    Time,
}

impl ParamSetting {
    /// The value in the frame of this number, at this time in seconds.
    pub fn value(&self, frame: u32, seconds: f64) -> ParamValue {
        match self {
            Self::Value(value) => value.clone(),
            Self::Frame => ParamValue::Integer(i64::from(frame)),
            Self::Time => ParamValue::Float(seconds),
        }
    }
}

/// A value for each parameter of a pass.
pub type Values = Table<ParamDescriptor, ParamValue>;

/// An edge of the graph.
#[derive(Debug, Clone)]
pub struct Connection {
    /// The port that is written.
    pub from: PortRef,
    /// The port that reads it.
    pub to: PortRef,
    /// Whether it carries what was written in the frame before, and so does not order passes.
    pub history: bool,
    /// The place of `"pass.port"`.
    pub span: Span,
}

/// A port of a pass.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct PortRef {
    /// The pass in the graph.
    pub pass: Handle<Pass>,
    /// The port in the pass's descriptor.
    pub port: Handle<PortDescriptor>,
}

/// A parameter of a pass.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct ParamRef {
    /// The pass in the graph.
    pub pass: Handle<Pass>,
    /// The parameter in the pass's descriptor.
    pub param: Handle<ParamDescriptor>,
}

/// A parameter of the graph.
#[derive(Debug, Clone)]
pub struct GraphParam {
    /// Name, without `$`.
    pub name: String,
    /// Its value after overrides. A text is a [`ParamValue::Choice`] here; if it names a file, the settings that use it
    /// hold the path.
    pub value: ParamValue,
    /// The parameters of passes that are set to it.
    pub uses: Vec<ParamRef>,
}

/// A parameter of a pass that sets a size.
#[derive(Debug)]
pub(crate) struct SizeParam {
    /// Where it is set.
    pub place: Place,
    /// Width and height of the picture that it names.
    pub picture: Option<(u32, u32)>,
}

impl Graph {
    /// The pass of this handle.
    pub fn pass(&self, pass: Handle<Pass>) -> &Pass {
        &self.passes[pass]
    }

    /// The pass of this name.
    pub fn pass_named(&self, name: &str) -> Option<Handle<Pass>> {
        self.names.find(name, |pass| self.passes[pass].name == name)
    }

    /// Whether an enabled pass feeds this input of the pass.
    pub fn is_fed(&self, pass: Handle<Pass>, input: &str) -> bool {
        let port = self.passes[pass].descriptor().port_named(input);
        let connection = port.and_then(|port| self.connection_to(PortRef { pass, port }));
        connection.is_some_and(|connection| self.passes[connection.from.pass].enabled)
    }

    /// The connection that the file makes to a port.
    pub fn connection_to(&self, port: PortRef) -> Option<&Connection> {
        self.wiring.connection_to[self.wiring.passes.port(port)].map(|connection| &self.connections[connection])
    }

    /// What the pass declares about this port.
    pub fn port(&self, port: PortRef) -> &PortDescriptor {
        &self.passes[port.pass].descriptor().ports[port.port]
    }

    pub(crate) fn signature(&self, port: PortRef) -> &PortSignature {
        &self.passes[port.pass].kind.signature.ports[port.port]
    }

    /// `pass.port`.
    pub fn port_name(&self, port: PortRef) -> String {
        format!("{}.{}", self.passes[port.pass].name, self.port(port).name)
    }

    /// Every port that a pass writes, those of disabled passes included, in file order.
    pub fn written_ports(&self) -> impl Iterator<Item = PortRef> + '_ {
        self.passes.entries().flat_map(|(pass, of)| {
            let ports = of.descriptor().ports.entries().filter(|(_, port)| port.role.is_output());
            ports.map(move |(port, _)| PortRef { pass, port })
        })
    }

    /// The port that a name means: an output of the graph, or `pass.port` with a port that the pass writes.
    ///
    /// # Errors
    /// `unknown-output`, `unknown-reference`, `unknown-port` or `not-an-output` at `place`, with a near name where there
    /// is one.
    pub fn find(&self, name: &str, place: Place) -> Result<PortRef, Diagnostic> {
        let Some((pass_name, port_name)) = name.split_once('.') else { return self.find_output(name, place) };
        let Some(pass) = self.pass_named(pass_name) else {
            let message = format!("there is no pass `{pass_name}`");
            let problem = Diagnostic::error(codes::UNKNOWN_REFERENCE, place, message);
            return Err(problem.suggest_near_as(pass_name, self.pass_names(), |near| format!("{near}.{port_name}")));
        };
        let descriptor = self.passes[pass].descriptor();
        match descriptor.port_named(port_name) {
            Some(port) if descriptor.ports[port].role.is_output() => Ok(PortRef { pass, port }),
            Some(_) => {
                let message = format!("`{port_name}` is an input of `{}`, so it cannot be read", descriptor.name);
                Err(Diagnostic::error(codes::NOT_AN_OUTPUT, place, message))
            }
            None => {
                let message = format!("`{}` has no port `{port_name}`", descriptor.name);
                let ports = descriptor.outputs().map(|port| port.name.as_str());
                let problem = Diagnostic::error(codes::UNKNOWN_PORT, place, message);
                Err(problem.suggest_near_as(port_name, ports, |near| format!("{pass_name}.{near}")))
            }
        }
    }

    fn find_output(&self, name: &str, place: Place) -> Result<PortRef, Diagnostic> {
        if let Some((_, port)) = self.outputs.iter().find(|(output, _)| output == name) {
            return Ok(*port);
        }
        let message = format!("the graph has no output `{name}`");
        let outputs = self.outputs.iter().map(|(output, _)| output.as_str());
        let otherwise = "`pass.port` names any port".to_owned();
        let otherwise = available(outputs.clone()).map_or(otherwise.clone(), |list| format!("{list}; {otherwise}"));
        Err(Diagnostic::error(codes::UNKNOWN_OUTPUT, place, message).suggest_near_or(name, outputs, otherwise))
    }

    /// The parameters that a name means: one for `pass.parameter`, all that use it for a parameter of the graph, none if
    /// the name is unknown.
    pub fn find_params(&self, name: &str) -> Vec<ParamRef> {
        let Some((pass, param)) = name.split_once('.') else {
            return self
                .params
                .iter()
                .find(|param| param.name == name)
                .map(|param| param.uses.clone())
                .unwrap_or_default();
        };
        let found = self
            .pass_named(pass)
            .and_then(|pass| Some(ParamRef { pass, param: self.passes[pass].descriptor().param_named(param)? }));
        found.into_iter().collect()
    }

    /// The place of a span of the graph's file.
    pub fn place(&self, span: Span) -> Place {
        Place::Text { source: self.source.clone(), span }
    }

    /// The value of an integer parameter that sets a size. One that changes with the frame was refused before.
    pub(crate) fn size_param(&self, ParamRef { pass, param }: ParamRef) -> i64 {
        match self.passes[pass].params[param] {
            ParamSetting::Value(ParamValue::Integer(value)) => value,
            _ => 1,
        }
    }

    pub(crate) fn pass_names(&self) -> impl Iterator<Item = &str> + Clone {
        self.passes.iter().map(|pass| pass.name.as_str())
    }
}
