//! Slots whose content no pass of this frame writes: constants, and what ports held in the frame before.

use super::Scan;
use crate::handle::Handle;
use crate::plan::{Resource, Slot, SlotKind, Step};
use crate::signature::PortSignature;
use crate::wiring::GraphPort;

impl Scan<'_> {
    /// The slot of what a port held in the frame before. The slot to copy it from is known once all are assigned.
    pub(super) fn history(&mut self, number: Handle<GraphPort>, port: &PortSignature) -> Handle<Slot> {
        let first = port.constant;
        let Some(of) = self.source(number) else { return self.constant_for(number) };
        if let Some(slot) = self.histories.get(&(of, first.map(f32::to_bits))) {
            return *slot;
        }
        let resource = self.resource(number);
        let slot = self.add(resource, SlotKind::History { of, first }, None);
        self.histories.insert((of, first.map(f32::to_bits)), slot);
        slot
    }

    /// The constant that stands for the input `number`, or for an output of a pass that is switched off.
    pub(super) fn constant_for(&mut self, number: Handle<GraphPort>) -> Handle<Slot> {
        let number = self.wiring.feeds[number].as_constant().unwrap_or(number);
        let value = self.wiring.passes.signature(number).constant;
        let resource = self.resource(number);
        let at = self.kind_port(number);
        let is_it = |slot: &Slot| {
            slot.resource == resource
                && matches!(slot.kind, SlotKind::Constant(other) if other.map(f32::to_bits) == value.map(f32::to_bits))
        };
        match self.latest[at].constant {
            Some(slot) if is_it(&self.done.slots[slot]) => slot,
            _ => {
                let slot = self.constant_of(resource, value);
                self.latest[at].constant = Some(slot);
                slot
            }
        }
    }

    fn constant_of(&mut self, resource: Resource, value: [f32; 4]) -> Handle<Slot> {
        let key = (resource, value.map(f32::to_bits));
        if let Some(slot) = self.constants.get(&key) {
            return *slot;
        }
        let slot = self.add(resource, SlotKind::Constant(value), None);
        self.constants.insert(key, slot);
        slot
    }

    /// Constants that were asked for, what is read back, and what is carried to the next frame.
    pub(super) fn finish(&mut self) {
        for port in self.draft.ports.iter().filter(|port| port.pass.is_none()) {
            let slot = self.constant_for(self.wiring.passes.port(port.port));
            self.hold(slot, false);
        }
        for slot in self.done.slots.handles() {
            if let SlotKind::History { of, .. } = self.done.slots[slot].kind {
                let from = self.done.ports[of].slot;
                self.done.steps.push(Step::Carry { from, to: slot });
            }
        }
    }
}
