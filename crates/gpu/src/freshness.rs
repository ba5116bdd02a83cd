//! Which passes must run: a result that was made from the same as now, and whose memory nobody has used since, is kept.

use tyndall_graph::{Digest, Handle, MadeFrom, Plan, PlannedPass, PlannedPort, Provenance, Slot, Step, Table, Values};

use crate::program::Programs;
use crate::scene::SceneBuffers;

/// What every slot holds, and what every pass would give now.
pub(crate) struct Freshness {
    provenance: Provenance,
    /// The scene data that the provenance asks for.
    scene: Vec<usize>,
    /// The pass reads a history, has side effects, or must run anyway.
    always: Table<PlannedPass, bool>,
    /// The pass runs in this frame.
    run: Table<PlannedPass, bool>,
    /// A running pass reads the port in this frame.
    needed: Table<PlannedPort, bool>,
    /// The port that a slot holds, and what it was made from.
    holds: Table<Slot, Option<(Handle<PlannedPort>, MadeFrom)>>,
    /// The content of the port was given, and is not computed.
    given: Table<PlannedPort, bool>,
    /// The port must hold its content after the frame.
    roots: Table<PlannedPort, bool>,
}

impl Freshness {
    pub(crate) fn new(plan: &Plan, programs: &dyn Programs, scene: &mut SceneBuffers) -> Self {
        // A file that cannot be read has no content; the pass that reads it says so.
        let file = |path: &str| Digest::of(&std::fs::read(path).unwrap_or_default());
        let provenance = Provenance::new(plan, &|pass| programs.shaders(pass), &file);
        let descriptors = plan.passes.handles().map(|pass| plan.descriptor(pass));
        Self {
            scene: provenance.scene().iter().map(|name| scene.intern(name)).collect(),
            provenance,
            always: descriptors.map(|descriptor| descriptor.side_effect || descriptor.remembers()).collect(),
            run: plan.passes.column(false),
            needed: plan.ports.column(false),
            holds: plan.slots.column(None),
            given: plan.ports.column(false),
            // What a history carries over is copied at the end of the frame, whoever else has read it.
            roots: plan.ports.iter().map(|port| port.root || port.carried).collect(),
        }
    }

    /// Nothing holds anything any more.
    pub(crate) fn forget(&mut self) {
        self.holds.fill(None);
        self.given.fill(false);
    }

    /// What a pass has written is not there any more: it runs in the next frame, and nothing else does for that.
    pub(crate) fn forget_pass(&mut self, plan: &Plan, pass: Handle<PlannedPass>) {
        for port in plan.outputs_of(pass) {
            self.holds[plan.ports[port].slot] = None;
        }
    }

    /// The port's slot holds what was put there from outside; its pass need not run for it any more.
    pub(crate) fn give(&mut self, plan: &Plan, port: Handle<PlannedPort>) {
        self.given[port] = true;
        self.holds[plan.ports[port].slot] = Some((port, MadeFrom::default()));
    }

    /// Whether this pass runs in this frame.
    pub(crate) fn runs(&self, pass: Handle<PlannedPass>) -> bool {
        self.run[pass]
    }

    /// Whether the port's slot still holds what the port last was.
    pub(crate) fn holds(&self, plan: &Plan, port: Handle<PlannedPort>) -> bool {
        let planned = &plan.ports[port];
        planned.pass.is_none() || self.holds[planned.slot].is_some_and(|(held, _)| held == port)
    }

    /// Decides which passes run in this frame, and says how many.
    pub(crate) fn decide(
        &mut self,
        plan: &Plan,
        values: &Table<PlannedPass, Values>,
        scene: &SceneBuffers,
        everything: bool,
    ) -> usize {
        self.provenance.update(plan, values, |index| scene.version(self.scene[index]));
        if everything {
            self.run.fill(true);
            return self.run.len();
        }
        for pass in plan.passes.handles() {
            self.run[pass] = self.always[pass] && !self.is_given(plan, pass);
        }
        loop {
            self.pull(plan);
            if !self.overwritten(plan) {
                break;
            }
        }
        self.run.iter().filter(|run| **run).count()
    }

    /// Marks every pass that must run because something that runs, or a root, reads a port which is not there.
    fn pull(&mut self, plan: &Plan) {
        for (port, planned) in plan.ports.entries() {
            if let Some(pass) = planned.pass
                && self.roots[port]
                && !self.valid(plan, port)
            {
                self.run[pass] = true;
            }
        }
        for index in plan.passes.handles().rev() {
            if !self.run[index] {
                continue;
            }
            for source in plan.sources(index).iter().flatten() {
                if let Some(pass) = plan.ports[*source].pass
                    && !self.valid(plan, *source)
                {
                    self.run[pass] = true;
                }
            }
        }
    }

    /// All that a pass writes was put there from outside, and it does nothing else.
    fn is_given(&self, plan: &Plan, pass: Handle<PlannedPass>) -> bool {
        let mut outputs = plan.outputs_of(pass);
        let writes_alone = !plan.descriptor(pass).side_effect && outputs.len() > 0;
        writes_alone && outputs.all(|port| self.given[port])
    }

    fn valid(&self, plan: &Plan, port: Handle<PlannedPort>) -> bool {
        let planned = &plan.ports[port];
        let Some(pass) = planned.pass else { return true };
        self.holds[planned.slot].is_some_and(|(held, made_from)| {
            held == port && (self.given[port] || self.provenance.of(pass).repeatable() == Some(made_from))
        })
    }

    /// Marks passes whose kept result would be overwritten in this frame before its last reader comes.
    /// Says whether there was one.
    fn overwritten(&mut self, plan: &Plan) -> bool {
        self.needed.fill(false);
        for index in plan.passes.handles() {
            if self.run[index] {
                for source in plan.sources(index).iter().flatten() {
                    self.needed[*source] = true;
                }
            }
        }
        let mut changed = false;
        for (port, planned) in plan.ports.entries() {
            let Some(pass) = planned.pass else { continue };
            if self.run[pass] || !(self.needed[port] || self.roots[port]) {
                continue;
            }
            let mut others = plan.ports_in(planned.slot).filter_map(|other| plan.ports[other].pass);
            if others.any(|other| other < pass && self.run[other]) {
                self.run[pass] = true;
                changed = true;
            }
        }
        changed
    }

    /// After the frame was recorded: what every slot holds now.
    pub(crate) fn remember(&mut self, plan: &Plan) {
        for step in &plan.steps {
            if let Step::Run { pass } = *step
                && self.run[pass]
            {
                for port in plan.outputs_of(pass) {
                    self.holds[plan.ports[port].slot] = Some((port, self.provenance.of(pass).made_from));
                }
            }
        }
    }
}
