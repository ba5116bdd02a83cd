//! Whose fault each failure is.

use std::collections::BTreeSet;

use tyndall_graph::Plan;

use crate::outcome::{Check, Outcome, PortOutcome, Reach, State, Suspicion};

/// What each pass of a plan was made from, in the run that is judged: ports, by the position of the pass. A port that was
/// given to a pass is not among them, and neither is what lies before it.
pub(crate) struct Upstream(Vec<BTreeSet<u32>>);

impl Upstream {
    /// Where every pass ran.
    pub fn of(plan: &Plan) -> Self {
        let mut upstream = Self::nothing(plan);
        for pass in 0..plan.passes.len() {
            let sources: Vec<u32> = plan.sources(pass as u32).iter().flatten().copied().collect();
            upstream.0[pass] = upstream.with_before(plan, &sources);
        }
        upstream
    }

    /// Where no pass ran for another.
    pub fn nothing(plan: &Plan) -> Self {
        Self(vec![BTreeSet::new(); plan.passes.len()])
    }

    /// A pass ran, and these of its inputs were rendered for it; others were given.
    pub fn ran_with(&mut self, plan: &Plan, pass: u32, rendered: &[u32]) {
        let before = Self::of(plan).with_before(plan, rendered);
        self.0[pass as usize].extend(before);
    }

    /// Ports, and what their passes were made from.
    fn with_before(&self, plan: &Plan, ports: &[u32]) -> BTreeSet<u32> {
        let producers = ports.iter().filter_map(|port| plan.ports[*port as usize].pass);
        let before = producers.flat_map(|pass| self.0[pass as usize].iter());
        before.chain(ports).copied().collect()
    }

    /// The ports that the pass at this position was made from.
    pub fn ports(&self, pass: usize) -> &BTreeSet<u32> {
        &self.0[pass]
    }

    /// The positions of their passes.
    pub fn passes<'a>(&'a self, plan: &'a Plan, pass: usize) -> impl Iterator<Item = usize> + 'a {
        self.0[pass].iter().filter_map(|port| Some(plan.ports[*port as usize].pass? as usize))
    }
}

/// Says whose fault each failure is: that of the first pass which fails though all that it was made from holds. What
/// depends on a pass that fails is inherited. A check that names other passes falls with these; a relation is weighed like
/// a check. A golden that is missing says nothing of a pass.
///
/// A port that no check holds in every number may be wrong without a word. Where a pass that is named was made from one,
/// the outcome says so.
pub(crate) fn attribute(plan: &Plan, upstream: &Upstream, outcome: &mut Outcome) {
    let mut blame = Blame { plan, upstream, failing: vec![false; plan.passes.len()] };
    for port in &outcome.ports {
        blame.failing(&port.pass, divergences(port).any(|check| check.also_on.is_empty()));
    }
    for relation in outcome.relations.iter().filter(|relation| !relation.judgement.passed) {
        blame.failing(&relation.pass, true);
    }
    // Only now is it known what a check about other passes falls with; a pass that nothing excuses fails by itself.
    for port in &outcome.ports {
        let excused = divergences(port).all(|check| blame.falls_with(&port.pass, &check.also_on));
        blame.failing(&port.pass, !excused);
    }
    for port in outcome.ports.iter_mut().filter(|port| !port.passed()) {
        let excused = divergences(port).all(|check| blame.falls_with(&port.pass, &check.also_on));
        let diverges = divergences(port).next().is_some();
        port.state = match (diverges, excused) {
            (false, _) => State::Unjudged,
            (true, true) => State::Inherited,
            (true, false) => State::Guilty,
        };
    }
    for relation in outcome.relations.iter_mut().filter(|relation| !relation.judgement.passed) {
        let excused = blame.falls_with(&relation.pass, &[]);
        relation.state = if excused { State::Inherited } else { State::Guilty };
    }
    outcome.suspicions = blame.suspicions(outcome);
}

/// What of a port does not hold, where there was something to hold it against.
fn divergences(port: &PortOutcome) -> impl Iterator<Item = &Check> {
    port.checks.iter().filter(|check| !check.judgement.passed && check.reach != Reach::Nothing)
}

/// Which passes of a plan fail by themselves.
struct Blame<'a> {
    plan: &'a Plan,
    upstream: &'a Upstream,
    failing: Vec<bool>,
}

impl Blame<'_> {
    fn position(&self, name: &str) -> Option<usize> {
        (0..self.plan.passes.len()).find(|pass| self.plan.pass_name(*pass as u32) == name)
    }

    fn failing(&mut self, pass: &str, fails: bool) {
        if let Some(position) = self.position(pass) {
            self.failing[position] |= fails;
        }
    }

    /// Whether something upstream of a pass fails, or one of these others, or something upstream of one.
    fn falls_with(&self, pass: &str, also_on: &[String]) -> bool {
        let Some(pass) = self.position(pass) else { return false };
        let others = also_on.iter().filter_map(|name| self.position(name)).filter(|other| *other != pass);
        let involved = others.flat_map(|other| self.upstream.passes(self.plan, other).chain([other]));
        self.upstream.passes(self.plan, pass).chain(involved).any(|other| other != pass && self.failing[other])
    }

    /// Of every pass that is named, the ports that it was made from and that nothing holds.
    fn suspicions(&self, outcome: &Outcome) -> Vec<Suspicion> {
        let held: BTreeSet<&str> = outcome.ports.iter().filter(|port| is_held(port)).map(|port| &*port.name).collect();
        let unheld = |pass: &str| -> Vec<String> {
            let Some(position) = self.position(pass) else { return Vec::new() };
            let rendered = |port: &&u32| self.plan.ports[**port as usize].pass.is_some();
            let names = self.upstream.ports(position).iter().filter(rendered).map(|port| self.plan.port_name(*port));
            names.filter(|name| !held.contains(name.as_str())).collect()
        };
        let guilty = outcome.guilty().into_iter();
        let suspicions = guilty.map(|pass| Suspicion { pass: pass.to_owned(), unheld: unheld(pass) });
        suspicions.filter(|suspicion| !suspicion.unheld.is_empty()).collect()
    }
}

/// Something holds every number of a port.
fn is_held(port: &PortOutcome) -> bool {
    port.checks.iter().any(|check| check.judgement.passed && check.reach == Reach::EveryNumber)
}
