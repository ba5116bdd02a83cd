//! Which slot holds each port.
//!
//! Ports of equal resources share slots by a linear scan over the order: a slot is free again after the pass that reads
//! its port last. For intervals this is optimal: a class never has more slots than ports alive at one time. A version
//! made in place belongs to the interval of the version before it.

use rustc_hash::FxHashMap;

mod standing;

use super::lifetimes::Draft;
use super::sizes::Sizes;
use super::{Bindings, ClassBytes, PlannedPass, PlannedPort, Resource, Slot, SlotKind, Step, Until};
use crate::catalogue::Kind;
use crate::descriptor::PortDescriptor;
use crate::handle::{Handle, Segment, Table};
use crate::signature::RoleKind;
use crate::wiring::{GraphPort, Shape, Wiring};

/// Which ports may share slots, and which outlive a frame.
#[derive(Debug, Clone, Copy)]
pub(super) struct Policy {
    pub share: bool,
    pub keep: bool,
}

/// The slot of every port.
pub(super) struct Assignment {
    pub ports: Table<PlannedPort>,
    pub slots: Table<Slot>,
    pub steps: Vec<Step>,
    pub bindings: Bindings,
    pub classes: Table<ClassBytes>,
}

/// Assigns a slot to every port.
pub(super) fn assign(wiring: &Wiring, sizes: &Sizes, draft: &Draft, policy: Policy) -> Assignment {
    let mut scan = Scan::new(wiring, sizes, draft, policy);
    for position in draft.passes.handles() {
        scan.pass(position);
        scan.release(position);
    }
    scan.finish();
    scan.done
}

struct Scan<'a> {
    wiring: &'a Wiring,
    sizes: &'a Sizes,
    draft: &'a Draft,
    policy: Policy,
    done: Assignment,
    class_of: FxHashMap<Resource, Handle<ClassBytes>>,
    ports_of_kind: Table<Kind, Segment<PortDescriptor, KindPort>>,
    latest: Table<KindPort, Latest>,
    /// The first free slot of a class.
    free: Table<ClassBytes, Option<Handle<Slot>>>,
    state: Table<Slot, SlotState>,
    /// A port that is read last at a position.
    expiring: Table<PlannedPass, Option<Handle<PlannedPort>>>,
    /// The next one of the same position.
    next_expiring: Table<PlannedPort, Option<Handle<PlannedPort>>>,
    constants: FxHashMap<(Resource, [u32; 4]), Handle<Slot>>,
    histories: FxHashMap<(Handle<PlannedPort>, [u32; 4]), Handle<Slot>>,
    /// Whether a port needs a slot of its own; empty where no result is kept.
    own: Table<PlannedPort, bool>,
}

/// A port of a kind of pass.
enum KindPort {}

/// What was last found for a port of a kind: most passes of a kind have the same sizes.
#[derive(Debug, Clone, Copy, Default)]
struct Latest {
    class: Option<Handle<ClassBytes>>,
    constant: Option<Handle<Slot>>,
}

#[derive(Clone, Copy)]
struct SlotState {
    /// `None` of what no pass writes.
    class: Option<Handle<ClassBytes>>,
    holds: Option<Handle<PlannedPort>>,
    /// Of a free slot, the next free one of its class.
    next_free: Option<Handle<Slot>>,
}

impl<'a> Scan<'a> {
    fn new(wiring: &'a Wiring, sizes: &'a Sizes, draft: &'a Draft, policy: Policy) -> Self {
        let mut latest = Table::new();
        let ports_of_kind =
            wiring.passes.kinds.iter().map(|kind| latest.push_for(&kind.signature.ports, Latest::default())).collect();
        let mut scan = Self {
            wiring,
            sizes,
            draft,
            policy,
            done: Assignment {
                ports: Table::with_capacity(draft.ports.len()),
                slots: Table::new(),
                steps: Vec::with_capacity(draft.passes.len() + 16),
                bindings: Bindings {
                    slots: wiring.passes.pass_of.column(None),
                    sources: wiring.passes.pass_of.column(None),
                },
                classes: Table::new(),
            },
            class_of: FxHashMap::default(),
            ports_of_kind,
            latest,
            free: Table::new(),
            state: Table::new(),
            expiring: draft.passes.column(None),
            next_expiring: Table::with_capacity(draft.ports.len()),
            constants: FxHashMap::default(),
            histories: FxHashMap::default(),
            own: Table::new(),
        };
        scan.own = if policy.keep { scan.own_slots() } else { Table::new() };
        scan
    }

    /// Kept ports, and the versions that they were made from in place.
    fn own_slots(&self) -> Table<PlannedPort, bool> {
        let mut own: Table<PlannedPort, bool> = self.draft.ports.iter().map(|port| port.kept).collect();
        for (position, planned) in self.draft.passes.entries().rev() {
            for (number, port) in self.wiring.passes.ports_of(planned.pass) {
                if port.role == RoleKind::InOut
                    && self.draft.planned[number].is_some_and(|port| own[port])
                    && let Some(source) = self.source(number)
                    && self.may_change(source, number, position)
                {
                    own[source] = true;
                }
            }
        }
        own
    }

    fn pass(&mut self, position: Handle<PlannedPass>) {
        let passes = &self.wiring.passes;
        let pass = self.draft.passes[position].pass;
        let (ports, latest) = (passes.ports[pass], self.ports_of_kind[passes.kind_of[pass]]);
        for (port, signature) in passes.kind(pass).signature.ports.entries() {
            let (number, latest) = (ports.at(port), latest.at(port));
            let (slot, source) = match signature.role {
                RoleKind::Output => (self.written(number, latest), None),
                RoleKind::InOut => self.changed(number, latest, position),
                RoleKind::History => (self.history(number, signature), None),
                RoleKind::Input | RoleKind::Optional => self.read(number),
            };
            self.done.bindings.slots[number] = Some(slot);
            self.done.bindings.sources[number] = source;
        }
        self.done.steps.push(Step::Run { pass: position });
    }

    /// The planned port that feeds an input.
    fn source(&self, input: Handle<GraphPort>) -> Option<Handle<PlannedPort>> {
        self.draft.source(self.wiring, input)
    }

    fn read(&mut self, number: Handle<GraphPort>) -> (Handle<Slot>, Option<Handle<PlannedPort>>) {
        match self.source(number) {
            Some(source) => (self.done.ports[source].slot, Some(source)),
            None => (self.constant_for(number), None),
        }
    }

    fn written(&mut self, number: Handle<GraphPort>, latest: Handle<KindPort>) -> Handle<Slot> {
        let resource = self.resource(number);
        let class = self.class_of_output(latest, resource);
        let slot = self.allocate(resource, class);
        self.hold(slot, false);
        slot
    }

    /// A new version: in place if the old one is no longer needed, else in a copy.
    fn changed(
        &mut self,
        number: Handle<GraphPort>,
        latest: Handle<KindPort>,
        position: Handle<PlannedPass>,
    ) -> (Handle<Slot>, Option<Handle<PlannedPort>>) {
        let (from, source) = self.read(number);
        if source.is_some_and(|source| self.may_change(source, number, position)) {
            let class = self.class_of_output(latest, self.done.slots[from].resource);
            self.done.classes[class].ports += 1;
            self.hold(from, true);
            return (from, source);
        }
        let to = self.written(number, latest);
        self.done.steps.push(Step::Copy { pass: position, from, to });
        (to, source)
    }

    /// Whether the pass at this position, which reads `source` through the in-out port `number`, may change it in place.
    fn may_change(
        &self,
        source: Handle<PlannedPort>,
        number: Handle<GraphPort>,
        position: Handle<PlannedPass>,
    ) -> bool {
        let port = &self.draft.ports[source];
        let kept = self.policy.keep && port.kept;
        if !self.policy.share || kept || port.until != Until::Pass(position) {
            return false;
        }
        let feeds = &self.wiring.feeds;
        let mut ports = self.wiring.passes.ports[self.draft.passes[position].pass].handles();
        !ports.any(|other| other != number && feeds[other] == feeds[number])
    }

    fn resource(&self, number: Handle<GraphPort>) -> Resource {
        let [width, height, depth_or_layers] = self.sizes[number];
        match self.wiring.flows[number].shape {
            Shape::Texture { dimension, format } => {
                Resource::Texture { dimension, format, width, height, depth_or_layers }
            }
            Shape::Buffer { stride } => Resource::Buffer { bytes: u64::from(width) * u64::from(stride), stride },
            Shape::Value { bytes } => Resource::Buffer { bytes: u64::from(bytes), stride: bytes },
            Shape::Unknown => Resource::Buffer { bytes: 0, stride: 0 },
        }
    }

    fn kind_port(&self, number: Handle<GraphPort>) -> Handle<KindPort> {
        let port = self.wiring.passes.port_ref(number);
        self.ports_of_kind[self.wiring.passes.kind_of[port.pass]].at(port.port)
    }

    /// The class of what an output writes.
    fn class_of_output(&mut self, at: Handle<KindPort>, resource: Resource) -> Handle<ClassBytes> {
        match self.latest[at].class {
            Some(class) if self.done.classes[class].resource == resource => class,
            _ => {
                let class = self.class(resource);
                self.latest[at].class = Some(class);
                class
            }
        }
    }

    fn class(&mut self, resource: Resource) -> Handle<ClassBytes> {
        *self.class_of.entry(resource).or_insert_with(|| {
            self.free.push(None);
            self.done.classes.push(ClassBytes { resource, ports: 0, slots: 0 })
        })
    }

    /// A slot for the next port.
    fn allocate(&mut self, resource: Resource, class: Handle<ClassBytes>) -> Handle<Slot> {
        self.done.classes[class].ports += 1;
        if self.policy.keep && self.own[self.done.ports.next_handle()] {
            return self.add(resource, SlotKind::Kept, Some(class));
        }
        if let Some(free) = self.free[class].filter(|_| self.policy.share) {
            self.free[class] = self.state[free].next_free;
            return free;
        }
        self.done.classes[class].slots += 1;
        self.add(resource, SlotKind::Transient, Some(class))
    }

    fn add(&mut self, resource: Resource, kind: SlotKind, class: Option<Handle<ClassBytes>>) -> Handle<Slot> {
        self.state.push(SlotState { class, holds: None, next_free: None });
        self.done.slots.push(Slot { resource, kind, first_port: None })
    }

    /// Puts the next port of the draft into a slot, after those that were there before. Slots are given in the order of
    /// the draft's ports: pass by pass, and in each by the descriptor.
    fn hold(&mut self, slot: Handle<Slot>, in_place: bool) {
        let port = self.done.ports.next_handle();
        let draft = self.draft.ports[port];
        self.done.ports.push(PlannedPort {
            pass: draft.pass,
            port: draft.port,
            slot,
            class: draft.class,
            until: draft.until,
            root: draft.root,
            kept: draft.kept,
            carried: draft.carried,
            in_place,
            next_in_slot: None,
        });
        match self.state[slot].holds.replace(port) {
            None => self.done.slots[slot].first_port = Some(port),
            Some(before) => self.done.ports[before].next_in_slot = Some(port),
        }
        let next = match draft.until {
            Until::Pass(position) => self.expiring[position].replace(port),
            Until::End => None,
        };
        self.next_expiring.push(next);
    }

    /// Frees the slots of the ports that are read last at this position, unless a newer version is in them.
    fn release(&mut self, position: Handle<PlannedPass>) {
        let mut next = self.expiring[position];
        while let Some(port) = next {
            let slot = self.done.ports[port].slot;
            let state = &mut self.state[slot];
            if let Some(class) = state.class
                && state.holds == Some(port)
                && self.done.slots[slot].kind == SlotKind::Transient
            {
                state.next_free = self.free[class].replace(slot);
            }
            next = self.next_expiring[port];
        }
    }
}
