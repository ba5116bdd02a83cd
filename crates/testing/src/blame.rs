//! Whose fault each failure is.

use std::collections::{BTreeMap, BTreeSet};

use tyndall_graph::{Handle, Plan, PlannedPass, PlannedPort, SlotKind, Table};

use crate::outcome::{Check, Outcome, PortOutcome, Reach, State, Suspicion};

/// What each pass of a plan was made from, in the run that is judged: ports. A port that was
/// given to a pass is not among them, and neither is what lies before it.
pub(crate) struct Upstream {
    /// In the same frame.
    ports: Table<PlannedPass, Ports>,
    /// In frames before.
    remembered: Table<PlannedPass, Ports>,
}

type Ports = BTreeSet<Handle<PlannedPort>>;

impl Upstream {
    /// Where every pass ran.
    pub fn of(plan: &Plan) -> Self {
        let mut upstream = Self::nothing(plan);
        for pass in plan.passes.handles() {
            let (now, _) = sources(plan, pass);
            upstream.ports[pass] = with_before(plan, &upstream.ports, &now);
        }
        upstream.remembered = remembered(plan, &upstream.ports);
        upstream
    }

    /// Where no pass ran for another.
    pub fn nothing(plan: &Plan) -> Self {
        let nothing = plan.passes.column(Ports::new());
        Self { ports: nothing.clone(), remembered: nothing }
    }

    /// A pass ran, and these of its inputs were rendered for it, by passes that all ran; others were given.
    pub fn ran_with(&mut self, plan: &Plan, all: &Self, pass: Handle<PlannedPass>, rendered: &[Handle<PlannedPort>]) {
        let before = with_before(plan, &all.ports, rendered);
        self.ports[pass].extend(before);
    }

    /// The ports that the pass at this position was made from, in the same frame.
    pub fn ports(&self, pass: Handle<PlannedPass>) -> &Ports {
        &self.ports[pass]
    }

    /// The positions of their passes.
    pub fn passes(&self, plan: &Plan, pass: Handle<PlannedPass>) -> impl Iterator<Item = Handle<PlannedPass>> {
        self.ports[pass].iter().filter_map(|port| plan.ports[*port].pass)
    }
}

/// What a pass reads of this frame, and of the frame before.
fn sources(plan: &Plan, pass: Handle<PlannedPass>) -> (Vec<Handle<PlannedPort>>, Vec<Handle<PlannedPort>>) {
    let kinds = plan.bindings(pass).iter().flatten().map(|slot| plan.slots[*slot].kind);
    let before = kinds.filter_map(|kind| if let SlotKind::History { of, .. } = kind { Some(of) } else { None });
    (plan.sources(pass).iter().flatten().copied().collect(), before.collect())
}

/// Ports, and what their passes were made from.
fn with_before(plan: &Plan, made_from: &Table<PlannedPass, Ports>, ports: &[Handle<PlannedPort>]) -> Ports {
    let producers = ports.iter().filter_map(|port| plan.ports[*port].pass);
    let before = producers.flat_map(|pass| made_from[pass].iter());
    before.chain(ports).copied().collect()
}

/// What frames before bring into each pass, through all that it reads.
fn remembered(plan: &Plan, ports: &Table<PlannedPass, Ports>) -> Table<PlannedPass, Ports> {
    let mut found = ports.column(Ports::new());
    loop {
        let mut grown = false;
        for pass in ports.handles() {
            let (_, before) = sources(plan, pass);
            let mut all = with_before(plan, ports, &before);
            let read = ports[pass].iter().chain(&before).filter_map(|port| plan.ports[*port].pass);
            all.extend(read.flat_map(|pass| found[pass].iter().copied().collect::<Vec<_>>()));
            grown |= !all.is_subset(&found[pass]);
            found[pass].extend(all);
        }
        if !grown {
            return found;
        }
    }
}

/// Says whose fault each failure is: that of the first pass which fails though all that it was made from holds, port by
/// port and frame by frame. What depends on a port that fails is inherited. A check that names other ports falls with
/// these; a relation is weighed like a check. A golden that is missing says nothing of a pass.
///
/// A port that no check holds in every number may be wrong without a word, and so may be a port that another is held
/// against. Where a pass that is named depends on such, the outcome says so.
pub(crate) fn attribute(plan: &Plan, upstream: &Upstream, outcome: &mut Outcome) {
    let numbers = plan.ports.handles().map(|port| (plan.port_name(port), port)).collect();
    let mut blame = Blame { plan, upstream, numbers, failing: BTreeSet::new(), earlier: BTreeSet::new() };
    let frames = outcome.ports.iter().map(|port| port.frame).chain(outcome.relations.iter().map(|each| each.frame));
    let frames: BTreeSet<u32> = frames.collect();
    for frame in frames {
        blame.frame(outcome, frame);
    }
    outcome.suspicions = blame.suspicions(outcome);
}

/// Which ports of a plan fail by themselves.
struct Blame<'a> {
    plan: &'a Plan,
    upstream: &'a Upstream,
    numbers: BTreeMap<String, Handle<PlannedPort>>,
    /// In the frame that is judged.
    failing: Ports,
    /// In frames before.
    earlier: Ports,
}

impl Blame<'_> {
    fn frame(&mut self, outcome: &mut Outcome, frame: u32) {
        self.earlier.append(&mut self.failing);
        let of_frame = || outcome.ports.iter().filter(|port| port.frame == frame);
        of_frame().filter(|port| port.fails_by_itself()).for_each(|port| self.fails(&port.name));
        let relations = || outcome.relations.iter().filter(|each| each.frame == frame && !each.judgement.passed);
        relations().for_each(|relation| self.fails(&relation.port));
        // Of a pass that fails in one port, those that nothing holds may be as wrong.
        let held: BTreeSet<&str> = of_frame().filter(|port| is_held(port)).map(|port| port.name.as_str()).collect();
        let wrong: BTreeSet<Option<Handle<PlannedPass>>> =
            self.failing.iter().map(|port| self.pass_of(*port)).collect();
        let unheld = self.numbers.iter().filter(|(name, port)| {
            !held.contains(name.as_str()) && self.pass_of(**port).is_some() && wrong.contains(&self.pass_of(**port))
        });
        let unheld: Vec<Handle<PlannedPort>> = unheld.map(|(_, port)| *port).collect();
        self.failing.extend(unheld);
        // Only now is it known what a check about other ports falls with; a port that nothing excuses fails by itself.
        for port in of_frame() {
            if !port.divergences().all(|check| self.falls_with(&port.name, &check.also_on)) {
                self.fails(&port.name);
            }
        }
        for port in outcome.ports.iter_mut().filter(|port| port.frame == frame && !port.passed()) {
            let excused = port.divergences().all(|check| self.falls_with(&port.name, &check.also_on));
            let diverges = port.divergences().next().is_some();
            port.state = match (diverges, excused) {
                (false, _) => State::Unjudged,
                (true, true) => State::Inherited,
                (true, false) => State::Guilty,
            };
        }
        for relation in outcome.relations.iter_mut().filter(|each| each.frame == frame && !each.judgement.passed) {
            let excused = self.falls_with(&relation.port, &[]);
            relation.state = if excused { State::Inherited } else { State::Guilty };
        }
    }

    fn fails(&mut self, port: &str) {
        self.failing.extend(self.numbers.get(port));
    }

    fn pass_of(&self, port: Handle<PlannedPort>) -> Option<Handle<PlannedPass>> {
        self.plan.ports[port].pass
    }

    /// The position of the pass that writes a port.
    fn position(&self, port: &str) -> Option<Handle<PlannedPass>> {
        self.pass_of(*self.numbers.get(port)?)
    }

    /// Whether something that a port was made from fails, or one of these others, or something that those were made from.
    fn falls_with(&self, port: &str, also_on: &[String]) -> bool {
        let Some(pass) = self.position(port) else { return false };
        let own = self.numbers.get(port);
        let others = || also_on.iter().filter(|other| *other != port);
        let made_from = others().filter_map(|other| self.position(other)).chain([pass]);
        let mut upstream = made_from.clone().flat_map(|pass| self.upstream.ports(pass));
        let mut remembered = made_from.flat_map(|pass| &self.upstream.remembered[pass]);
        upstream.any(|other| Some(other) != own && self.failing.contains(other))
            || others().filter_map(|other| self.numbers.get(other)).any(|other| self.failing.contains(other))
            || remembered.any(|other| self.earlier.contains(other))
    }

    /// Of every pass that is named, the ports that it depends on and that nothing holds, or that it is held against.
    fn suspicions(&self, outcome: &Outcome) -> Vec<Suspicion> {
        let held: BTreeSet<&str> = outcome.ports.iter().filter(|port| is_held(port)).map(|port| &*port.name).collect();
        let mut suspicions = Vec::new();
        for pass in outcome.guilty() {
            let ports = outcome.ports.iter().filter(|port| port.pass == pass && port.state == State::Guilty);
            let relations = outcome.relations.iter().filter(|each| each.pass == pass && each.state == State::Guilty);
            let mut suspected = BTreeSet::new();
            for port in ports {
                let of_own = self.position(&port.name).into_iter().flat_map(|pass| self.upstream.ports(pass));
                let rendered = of_own.filter(|port| self.pass_of(**port).is_some());
                suspected.extend(rendered.filter(|port| !held.contains(self.plan.port_name(**port).as_str())));
                let others = port.divergences().flat_map(|check| check.also_on.iter().map(move |other| (check, other)));
                let open = others.filter(|(check, other)| **other != port.name && !is_above(outcome, check, other));
                suspected.extend(open.filter_map(|(_, other)| self.numbers.get(other)));
            }
            suspected.extend(relations.flat_map(|each| &each.unheld).filter_map(|port| self.numbers.get(port)));
            if !suspected.is_empty() {
                let unheld = suspected.into_iter().map(|port| self.plan.port_name(port)).collect();
                suspicions.push(Suspicion { pass: pass.to_owned(), unheld });
            }
        }
        suspicions
    }
}

/// Another port is held so strictly that it cannot be what a check found: then it is not the one that is wrong.
fn is_above(outcome: &Outcome, check: &Check, other: &str) -> bool {
    let of_other = outcome.ports.iter().filter(|port| port.name == other);
    let held = of_other.flat_map(|port| &port.checks).filter(|held| held.judgement.passed);
    let mut metrics = held.filter_map(|held| held.by);
    check.by.is_some_and(|by| metrics.any(|metric| metric.excludes(&by, &check.judgement)))
}

/// Something holds every number of a port.
fn is_held(port: &PortOutcome) -> bool {
    port.checks.iter().any(|check| check.judgement.passed && check.reach == Reach::EveryNumber)
}
