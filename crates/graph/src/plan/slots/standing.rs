//! Slots that hold what no pass of this frame writes: constants, and what ports held in the frame before.

use super::Scan;
use crate::graph::PortRef;
use crate::plan::{PlannedPort, Resource, SlotKind, Step, Usages};
use crate::signature::PortSignature;
use crate::table::NONE;

impl Scan<'_> {
    /// The slot of what a port held in the frame before. Its content's slot is known when all is assigned.
    pub(super) fn history(&mut self, number: u32, port: &PortSignature) -> u32 {
        let first = port.constant;
        let Some(of) = self.source(number) else { return self.constant_for(number) };
        if let Some(slot) = self.histories.get(&(of, first.map(f32::to_bits))) {
            return *slot;
        }
        let resource = self.resource(number);
        let slot = self.add(resource, SlotKind::History { of, first }, NONE);
        self.slots[slot as usize].usages |= Usages::COPY_TO;
        self.histories.insert((of, first.map(f32::to_bits)), slot);
        slot
    }

    /// The constant that stands for the input `number`.
    pub(super) fn constant_for(&mut self, number: u32) -> u32 {
        let number = self.table.feeds[number as usize].as_constant().unwrap_or(number);
        self.constant(number)
    }

    fn constant(&mut self, number: u32) -> u32 {
        let pass = self.table.pass_of[number as usize];
        let index = number - self.table.first_port[pass as usize];
        let value = self.table.kind(pass).signature.ports[index as usize].constant;
        let resource = self.resource(number);
        let latest = self.latest(number);
        if let Some(slot) = self.slots.get(self.latest[latest] as usize)
            && slot.resource == resource
            && matches!(slot.kind, SlotKind::Constant(other) if other.map(f32::to_bits) == value.map(f32::to_bits))
        {
            return self.latest[latest];
        }
        let slot = self.constant_of(resource, value);
        self.latest[latest] = slot;
        slot
    }

    fn constant_of(&mut self, resource: Resource, value: [f32; 4]) -> u32 {
        let key = (resource, value.map(f32::to_bits));
        if let Some(slot) = self.constants.get(&key) {
            return *slot;
        }
        let slot = self.add(resource, SlotKind::Constant(value), NONE);
        self.slots[slot as usize].usages |= Usages::COPY_TO;
        self.constants.insert(key, slot);
        slot
    }

    /// Constants that were asked for, what is read back, and what is carried to the next frame.
    pub(super) fn finish(&mut self) {
        for port in 0..self.ports.len() {
            let PlannedPort { pass, port: PortRef { pass: owner, port: index }, root, .. } = self.ports[port];
            if pass.is_none() {
                let number = self.table.port(owner, index);
                let number = self.table.feeds[number as usize].as_constant().unwrap_or(number);
                let slot = self.constant(number);
                self.hold(slot, port as u32);
            }
            if root {
                self.slots[self.ports[port].slot as usize].usages |= Usages::COPY_FROM;
            }
        }
        for slot in 0..self.slots.len() {
            if let SlotKind::History { of, .. } = self.slots[slot].kind {
                let from = self.ports[of as usize].slot;
                self.slots[from as usize].usages |= Usages::COPY_FROM;
                self.steps.push(Step::Carry { from, to: slot as u32 });
            }
        }
    }
}
