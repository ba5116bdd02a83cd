//! Which slot holds each port.
//!
//! Ports of equal resources share slots by a linear scan over the order: a slot is free again after the pass that reads
//! its port last. For intervals that is optimal: a class never has more slots than ports alive at one time. A version
//! made in place belongs to the interval of the version before it.

use rustc_hash::FxHashMap;

mod standing;

use super::lifetimes::Draft;
use super::sizes::Size;
use super::{ClassBytes, PlannedPort, Resource, Slot, SlotKind, Step, Usages};
use crate::signature::RoleKind;
use crate::table::{NONE, Shape, Table};

/// What may share, and what outlives a frame.
#[derive(Debug, Clone, Copy)]
pub(super) struct Policy {
    pub share: bool,
    pub keep: bool,
}

/// Every port in a slot.
pub(super) struct Assignment {
    pub ports: Vec<PlannedPort>,
    pub slots: Vec<Slot>,
    pub steps: Vec<Step>,
    pub bindings: Vec<Option<u32>>,
    pub sources: Vec<Option<u32>>,
    pub classes: Vec<ClassBytes>,
}

/// Gives every port a slot.
pub(super) fn assign(
    table: &Table,
    sizes: &[Size],
    draft: &Draft,
    ports: Vec<PlannedPort>,
    policy: Policy,
) -> Assignment {
    let mut scan = Scan::new(table, sizes, draft, policy, ports);
    for position in 0..draft.passes.len() as u32 {
        scan.pass(position);
        scan.release(position);
    }
    scan.finish();
    Assignment {
        ports: scan.ports,
        slots: scan.slots,
        steps: scan.steps,
        bindings: scan.bindings,
        sources: scan.sources,
        classes: scan.classes,
    }
}

struct Scan<'a> {
    table: &'a Table,
    sizes: &'a [Size],
    draft: &'a Draft,
    policy: Policy,
    ports: Vec<PlannedPort>,
    slots: Vec<Slot>,
    steps: Vec<Step>,
    bindings: Vec<Option<u32>>,
    sources: Vec<Option<u32>>,
    classes: Vec<ClassBytes>,
    class_of: FxHashMap<Resource, u32>,
    /// By kind of pass the first of its ports in `latest`; and by port of a kind its latest class, or constant slot.
    first_of_kind: Vec<u32>,
    latest: Vec<u32>,
    /// By class: a free slot; and by slot: the next free one of its class.
    free: Vec<u32>,
    next_free: Vec<u32>,
    /// By slot: its class, and the port that it holds.
    state: Vec<SlotState>,
    /// By position: a port that is read there last; and by port: the next one of the same position.
    expiring: Vec<u32>,
    next_expiring: Vec<u32>,
    constants: FxHashMap<(Resource, [u32; 4]), u32>,
    histories: FxHashMap<(u32, [u32; 4]), u32>,
    /// By port, where results are kept: it needs a slot of its own.
    own: Vec<bool>,
}

#[derive(Clone, Copy)]
struct SlotState {
    class: u32,
    holds: u32,
}

impl<'a> Scan<'a> {
    fn new(table: &'a Table, sizes: &'a [Size], draft: &'a Draft, policy: Policy, ports: Vec<PlannedPort>) -> Self {
        let mut kind_ports = 0;
        let mut first_of_kind = Vec::with_capacity(table.kinds.len());
        for kind in &table.kinds {
            first_of_kind.push(kind_ports);
            kind_ports += kind.signature.ports.len() as u32;
        }
        let bindings = table.pass_of.len();
        let mut scan = Self {
            table,
            sizes,
            draft,
            policy,
            slots: Vec::new(),
            steps: Vec::with_capacity(draft.passes.len() + 16),
            bindings: Vec::with_capacity(bindings),
            sources: Vec::with_capacity(bindings),
            classes: Vec::new(),
            class_of: FxHashMap::default(),
            first_of_kind,
            latest: vec![NONE; kind_ports as usize],
            free: Vec::new(),
            next_free: Vec::new(),
            state: Vec::new(),
            expiring: vec![NONE; draft.passes.len() + 1],
            next_expiring: vec![NONE; ports.len()],
            constants: FxHashMap::default(),
            histories: FxHashMap::default(),
            own: Vec::new(),
            ports,
        };
        scan.own = if policy.keep { scan.own_slots() } else { Vec::new() };
        scan
    }

    /// Kept ports, and the versions that they were made from in place.
    fn own_slots(&self) -> Vec<bool> {
        let mut own: Vec<bool> = self.ports.iter().map(|port| port.kept).collect();
        for position in (0..self.draft.passes.len() as u32).rev() {
            let pass = self.draft.passes[position as usize].index;
            for (number, port) in self.table.ports(pass).zip(&self.table.kind(pass).signature.ports) {
                if port.role == RoleKind::InOut
                    && own[self.draft.planned[number as usize] as usize]
                    && let Some(source) = self.source(number)
                    && self.may_change(source, number, position)
                {
                    own[source as usize] = true;
                }
            }
        }
        own
    }

    fn pass(&mut self, position: u32) {
        let pass = self.draft.passes[position as usize].index;
        let table = self.table;
        let signature = &table.kind(pass).signature;
        let first = table.first_port[pass as usize];
        for (index, port) in signature.ports.iter().enumerate() {
            let number = first + index as u32;
            let (slot, source) = match port.role {
                RoleKind::Output => (self.written(number), None),
                RoleKind::InOut => self.changed(number, position),
                RoleKind::History => (self.history(number, port), None),
                RoleKind::Input | RoleKind::Optional => self.read(number),
            };
            self.slots[slot as usize].usages |= port.usages;
            self.bindings.push(Some(slot));
            self.sources.push(source);
        }
        self.steps.push(Step::Run { pass: position });
    }

    /// The planned port that feeds an input.
    fn source(&self, number: u32) -> Option<u32> {
        Some(self.draft.planned[self.table.feeds[number as usize].as_port()? as usize])
    }

    fn read(&mut self, number: u32) -> (u32, Option<u32>) {
        match self.source(number) {
            Some(source) => (self.ports[source as usize].slot, Some(source)),
            None => (self.constant_for(number), None),
        }
    }

    fn written(&mut self, number: u32) -> u32 {
        let port = self.draft.planned[number as usize];
        let resource = self.resource(number);
        let class = self.class_of_output(number, resource);
        let slot = self.allocate(port, resource, class);
        self.hold(slot, port);
        slot
    }

    /// A new version: in place where nobody needs the old one any more, else in a copy.
    fn changed(&mut self, number: u32, position: u32) -> (u32, Option<u32>) {
        let (from, source) = self.read(number);
        let port = self.draft.planned[number as usize];
        if let Some(source) = source.filter(|source| self.may_change(*source, number, position)) {
            self.ports[port as usize].in_place = true;
            let resource = self.slots[from as usize].resource;
            let class = self.class_of_output(number, resource);
            self.classes[class as usize].ports += 1;
            self.hold(from, port);
            return (from, Some(source));
        }
        let to = self.written(number);
        self.slots[from as usize].usages |= Usages::COPY_FROM;
        self.slots[to as usize].usages |= Usages::COPY_TO;
        self.steps.push(Step::Copy { pass: position, from, to });
        (to, source)
    }

    /// Whether the pass that reads `source` through the in-out port `number` may change it in place.
    fn may_change(&self, source: u32, number: u32, position: u32) -> bool {
        let port = &self.ports[source as usize];
        let kept = self.policy.keep && port.kept;
        if !self.policy.share || kept || port.lifetime.1 != position {
            return false;
        }
        let pass = self.table.pass_of[number as usize];
        let feed = self.table.feeds[number as usize];
        !self.table.ports(pass).any(|other| other != number && self.table.feeds[other as usize] == feed)
    }

    fn resource(&self, number: u32) -> Resource {
        let [width, height, depth_or_layers] = self.sizes[number as usize];
        match self.table.flows[number as usize].shape {
            Shape::Texture { dimension, format } => {
                Resource::Texture { dimension, format, width, height, depth_or_layers }
            }
            Shape::Buffer { stride } => Resource::Buffer { bytes: u64::from(width) * u64::from(stride), stride },
            Shape::Value { bytes } => Resource::Buffer { bytes: u64::from(bytes), stride: bytes },
            Shape::Unknown => Resource::Buffer { bytes: 0, stride: 0 },
        }
    }

    /// Where the latest class or constant of a port's kind is remembered: most passes of a kind have the same sizes.
    fn latest(&self, number: u32) -> usize {
        let pass = self.table.pass_of[number as usize];
        let kind = self.table.kind_of[pass as usize];
        (self.first_of_kind[kind as usize] + number - self.table.first_port[pass as usize]) as usize
    }

    /// The class of what an output writes.
    fn class_of_output(&mut self, number: u32, resource: Resource) -> u32 {
        let latest = self.latest(number);
        let class = self.latest[latest];
        if self.classes.get(class as usize).is_some_and(|class| class.resource == resource) {
            return class;
        }
        self.latest[latest] = self.class(resource);
        self.latest[latest]
    }

    fn class(&mut self, resource: Resource) -> u32 {
        let next = self.classes.len() as u32;
        let class = *self.class_of.entry(resource).or_insert(next);
        if class == next {
            self.classes.push(ClassBytes { resource, ports: 0, slots: 0 });
            self.free.push(NONE);
        }
        class
    }

    fn allocate(&mut self, port: u32, resource: Resource, class: u32) -> u32 {
        self.classes[class as usize].ports += 1;
        if self.own.get(port as usize) == Some(&true) {
            return self.add(resource, SlotKind::Kept, class);
        }
        let free = self.free[class as usize];
        if self.policy.share && free != NONE {
            self.free[class as usize] = self.next_free[free as usize];
            return free;
        }
        self.classes[class as usize].slots += 1;
        self.add(resource, SlotKind::Transient, class)
    }

    fn add(&mut self, resource: Resource, kind: SlotKind, class: u32) -> u32 {
        let slot = self.slots.len() as u32;
        self.slots.push(Slot { resource, kind, usages: Usages::NONE, first_port: NONE });
        self.next_free.push(NONE);
        self.state.push(SlotState { class, holds: NONE });
        slot
    }

    /// Puts a port into a slot, behind those that were there before.
    fn hold(&mut self, slot: u32, port: u32) {
        let before = std::mem::replace(&mut self.state[slot as usize].holds, port);
        match before {
            NONE => self.slots[slot as usize].first_port = port,
            before => self.ports[before as usize].next_in_slot = port,
        }
        self.ports[port as usize].slot = slot;
        let last = self.ports[port as usize].lifetime.1 as usize;
        self.next_expiring[port as usize] = std::mem::replace(&mut self.expiring[last], port);
    }

    /// Frees the slots of the ports that are read last at this position, unless a newer version is in them.
    fn release(&mut self, position: u32) {
        let mut port = self.expiring[position as usize];
        while port != NONE {
            let slot = self.ports[port as usize].slot;
            let state = self.state[slot as usize];
            if state.holds == port && self.slots[slot as usize].kind == SlotKind::Transient {
                self.next_free[slot as usize] = std::mem::replace(&mut self.free[state.class as usize], slot);
            }
            port = self.next_expiring[port as usize];
        }
    }
}
