//! Passes that are switched off, and what flows in their place.

use tyndall_document::Diagnostic;

use super::Validator;
use super::params::{GraphValue, kind_name};
use crate::codes;
use crate::descriptor::ParamValue;
use crate::file::Switch;
use crate::graph::Pass;
use crate::handle::Handle;
use crate::signature::RoleKind;
use crate::wiring::Feed;

impl Validator<'_> {
    /// Decides which passes are on, and what feeds every port once the others are gone.
    pub(super) fn switch_passes(&mut self) {
        let mut any_off = false;
        for pass in self.passes.handles() {
            let on = self.is_on(pass);
            any_off |= !on;
            self.wiring.enabled[pass] = on;
            self.passes[pass].enabled = on;
        }
        self.wiring.feeds = self.written.clone();
        if !any_off {
            return;
        }
        for pass in self.wiring.order.clone() {
            self.pass_through(pass);
        }
        for port in self.wiring.history.clone() {
            self.wiring.feeds[port] = self.flowing(self.written[port]);
        }
    }

    fn is_on(&mut self, pass: Handle<Pass>) -> bool {
        let file = self.file;
        let Some(switch) = &file.passes[pass].enabled else { return true };
        match &switch.value {
            Switch::Fixed(on) => *on,
            Switch::Param(name) => {
                self.passes[pass].switch = Some(name.clone());
                let place = self.place(switch.span);
                self.graph_param(name, &place).is_none_or(|index| self.switch_value(index, place))
            }
        }
    }

    fn switch_value(&mut self, index: Handle<GraphValue>, place: tyndall_document::Place) -> bool {
        let param = &self.params.graph[index];
        match &param.value {
            Some(ParamValue::Bool(on)) => *on,
            None => true,
            Some(other) => {
                let message = format!("`enabled` is a switch, and ${} is {}", param.name, kind_name(other));
                let definition = self.place(param.definition);
                let diagnostic = Diagnostic::error(codes::WRONG_REFERENCE_TYPE, place, message);
                self.report(diagnostic.relate(definition, "defined here"));
                true
            }
        }
    }

    fn pass_through(&mut self, pass: Handle<Pass>) {
        let ports = self.wiring.ports[pass];
        let kind = self.kind_of(pass);
        for (number, port) in ports.handles().zip(&kind.signature.ports) {
            if port.role.reads_this_frame() {
                self.wiring.feeds[number] = self.flowing(self.written[number]);
            }
        }
        if self.wiring.enabled[pass] {
            return;
        }
        for (number, port) in ports.handles().zip(&kind.signature.ports) {
            if port.role == RoleKind::Output {
                self.wiring.feeds[number] = match port.through {
                    Some(input) => self.wiring.feeds[ports.at(input)],
                    None => Feed::Constant(number),
                };
            }
        }
    }

    /// What flows where the file connects a port: past every pass that is off.
    fn flowing(&self, feed: Feed) -> Feed {
        match feed.as_port() {
            Some(source) if !self.wiring.enabled[self.wiring.pass_of[source]] => self.wiring.feeds[source],
            _ => feed,
        }
    }
}
