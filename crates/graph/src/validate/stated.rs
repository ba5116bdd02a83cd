//! Values of parameters of passes from the file and the command line.

use std::sync::Arc;

use rustc_hash::FxHashMap;
use tyndall_document::{Decoder, Diagnostics, Node, Place, Source, Value};

use super::mistakes::Mistakes;
use super::scope::Scope;
use crate::codes;
use crate::descriptor::{ParamDescriptor, ParamValue, PassDescriptor};
use crate::graph::ParamRef;
use crate::overrides::{Override, moved_to_argument};

/// A value that the file or the command line gives.
#[derive(Clone, Copy)]
pub(super) struct Stated<'a> {
    pub node: &'a Node,
    pub source: &'a Arc<Source>,
    /// The argument of the command line that it came from.
    pub argument: Option<&'a str>,
}

impl<'a> Stated<'a> {
    pub fn place(self) -> Place {
        match self.argument {
            Some(argument) => Place::Argument(argument.to_owned()),
            None => self.source.place(self.node.span),
        }
    }

    /// The name after the `$`.
    pub fn reference(self) -> Option<&'a str> {
        match &self.node.value {
            Value::Text(text) => text.strip_prefix('$'),
            _ => None,
        }
    }

    /// Its value as one of a parameter.
    pub fn typed(self, param: &ParamDescriptor, out: &mut Mistakes) -> Option<ParamValue> {
        let mut found = Diagnostics::default();
        let value = param.read(&mut Decoder::new(self.source, &mut found), self.node);
        out.extend(match self.argument {
            Some(argument) => moved_to_argument(found, argument),
            None => found,
        });
        value
    }
}

/// Values of parameters of passes from the command line; the last one for a name wins.
pub(super) fn overrides<'a>(scope: &Scope<'a>, out: &mut Mistakes) -> FxHashMap<ParamRef, &'a Override> {
    let mut found = FxHashMap::default();
    for given in &scope.request.overrides.params {
        if let Some((pass, param)) = given.name.split_once('.')
            && let Some(param) = overridden(scope, (pass, param), &given.argument, out)
        {
            found.insert(param, given);
        }
    }
    found
}

/// The parameter that `pass.parameter` means on the command line.
fn overridden(
    scope: &Scope<'_>,
    (pass_name, param_name): (&str, &str),
    argument: &str,
    out: &mut Mistakes,
) -> Option<ParamRef> {
    let place = Place::Argument(argument.to_owned());
    let Some(pass) = scope.pass_named(pass_name) else {
        let message = format!("there is no pass `{pass_name}`");
        let code = (codes::UNKNOWN_REFERENCE, place);
        out.report_unknown(code, message, pass_name, scope.pass_names(), |near| format!("{near}.{param_name}"));
        return None;
    };
    let descriptor = &scope.passes.kind(pass).descriptor;
    let found = descriptor.param_named(param_name);
    if found.is_none() && scope.is_known(pass) {
        unknown_param(descriptor, param_name, place, |near| format!("{pass_name}.{near}"), out);
    }
    found.map(|param| ParamRef { pass, param })
}

pub(super) fn unknown_param(
    descriptor: &PassDescriptor,
    name: &str,
    place: Place,
    suggestion: impl Fn(&str) -> String,
    out: &mut Mistakes,
) {
    let message = format!("`{}` has no parameter `{name}`", descriptor.name);
    let names = descriptor.params.iter().map(|param| param.name.as_str());
    out.report_unknown((codes::UNKNOWN_PARAMETER, place), message, name, names, suggestion);
}
