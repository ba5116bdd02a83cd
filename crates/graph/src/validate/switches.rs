//! Passes that are switched off, and what flows in their place.

use petgraph::graph::NodeIndex;
use tyndall_document::Diagnostic;

use super::Validator;
use super::params::kind_name;
use crate::codes;
use crate::descriptor::ParamValue;
use crate::file::Switch;
use crate::signature::RoleKind;
use crate::table::Feed;

impl Validator<'_> {
    /// Decides which passes are on, and what feeds every port once the others are gone.
    pub(super) fn switch_passes(&mut self) {
        let mut any_off = false;
        for pass in 0..self.table.passes() {
            let on = self.is_on(pass);
            any_off |= !on;
            self.table.enabled[pass as usize] = on;
            self.passes[NodeIndex::new(pass as usize)].enabled = on;
        }
        self.table.feeds = self.written.clone();
        if !any_off {
            return;
        }
        for pass in self.table.order.clone() {
            self.pass_through(pass);
        }
        for port in self.table.history.clone() {
            self.table.feeds[port as usize] = self.flowing(self.written[port as usize]);
        }
    }

    fn is_on(&mut self, pass: u32) -> bool {
        let file = self.file;
        let Some(switch) = &file.passes[pass as usize].enabled else { return true };
        match &switch.value {
            Switch::Fixed(on) => *on,
            Switch::Param(name) => {
                self.passes[NodeIndex::new(pass as usize)].switch = Some(name.clone());
                let place = self.place(switch.span);
                self.graph_param(name, &place).is_none_or(|index| self.switch_value(index, place))
            }
        }
    }

    fn switch_value(&mut self, index: u32, place: tyndall_document::Place) -> bool {
        let param = &self.params.graph[index as usize];
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

    fn pass_through(&mut self, pass: u32) {
        let kind = self.kind_of(pass);
        let first = self.table.first_port[pass as usize];
        for (number, port) in (first..).zip(&kind.signature.ports) {
            if !matches!(port.role, RoleKind::Output | RoleKind::History) {
                self.table.feeds[number as usize] = self.flowing(self.written[number as usize]);
            }
        }
        if self.table.enabled[pass as usize] {
            return;
        }
        for (number, port) in (first..).zip(&kind.signature.ports) {
            if port.role == RoleKind::Output {
                self.table.feeds[number as usize] = match port.through {
                    Some(input) => self.table.feeds[(first + input) as usize],
                    None => Feed::constant(number),
                };
            }
        }
    }

    /// What flows where the file connects a port: past every pass that is off.
    fn flowing(&self, feed: Feed) -> Feed {
        match feed.as_port() {
            Some(source) if !self.table.enabled[self.table.pass_of[source as usize] as usize] => {
                self.table.feeds[source as usize]
            }
            _ => feed,
        }
    }
}
