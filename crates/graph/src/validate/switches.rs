//! Passes that are disabled, and what flows in their place.

use tyndall_document::{Diagnostic, Place};

use super::connections::Connections;
use super::mistakes::Mistakes;
use super::params::{GraphValue, Params};
use super::scope::Scope;
use crate::codes;
use crate::descriptor::ParamValue;
use crate::file::{Spanned, Switch};
use crate::graph::Pass;
use crate::handle::{Handle, Table};
use crate::signature::RoleKind;
use crate::wiring::{Feed, Feeds, Passes};

/// Which passes are enabled, and what decides it.
pub(super) struct Switches {
    pub enabled: Table<Pass, bool>,
    /// The parameter of the graph that enables a pass.
    pub switched_by: Table<Pass, Option<String>>,
    /// The parameters of the graph that are named.
    pub used: Vec<Handle<GraphValue>>,
}

/// Reads what `enabled` says of each pass.
pub(super) fn read(scope: &Scope<'_>, params: &Params<'_>, out: &mut Mistakes) -> Switches {
    let passes = &scope.file.passes;
    let mut switches = Switches { enabled: passes.column(true), switched_by: passes.column(None), used: Vec::new() };
    for (pass, entry) in passes.entries() {
        let Some(Spanned { value: switch, span }) = &entry.enabled else { continue };
        match switch {
            Switch::Fixed(on) => switches.enabled[pass] = *on,
            Switch::Param(name) => {
                let place = scope.place(*span);
                let found = params.resolve(scope, name, &place, out);
                switches.used.extend(found.map_or_else(|meant| meant, Some));
                switches.enabled[pass] = found.map_or(true, |param| is_on(scope, &params.values[param], place, out));
                switches.switched_by[pass] = Some(name.clone());
            }
        }
    }
    switches
}

/// Whether a parameter enables a pass; true if a mistake hides it.
fn is_on(scope: &Scope<'_>, param: &GraphValue, place: Place, out: &mut Mistakes) -> bool {
    match &param.value {
        Some(ParamValue::Bool(on)) => *on,
        None => true,
        Some(other) => {
            let message = format!("`enabled` is a switch, but ${} is {}", param.name, other.words());
            let diagnostic = Diagnostic::error(codes::WRONG_REFERENCE_TYPE, place, message);
            out.report(diagnostic.relate(scope.place(param.definition), "defined here"));
            true
        }
    }
}

/// What feeds every port once disabled passes are removed.
pub(super) fn pass_through(
    passes: &Passes,
    order: &[Handle<Pass>],
    connections: &Connections,
    enabled: &Table<Pass, bool>,
) -> Feeds {
    let written = &connections.written;
    let mut feeds = written.clone();
    if enabled.iter().all(|on| *on) {
        return feeds;
    }
    // Past every disabled pass.
    let flowing = |feeds: &Feeds, feed: Feed| match feed {
        Feed::Port(source) if !enabled[passes.pass_of[source]] => feeds[source],
        _ => feed,
    };
    for pass in order {
        for (port, _) in passes.ports_of(*pass).filter(|(_, port)| port.role.reads_this_frame()) {
            feeds[port] = flowing(&feeds, written[port]);
        }
        if enabled[*pass] {
            continue;
        }
        for (port, signature) in passes.ports_of(*pass).filter(|(_, port)| port.role == RoleKind::Output) {
            feeds[port] = match signature.through {
                Some(input) => feeds[passes.ports[*pass].at(input)],
                None => Feed::Constant(port),
            };
        }
    }
    for port in &connections.history {
        feeds[*port] = flowing(&feeds, written[*port]);
    }
    feeds
}
