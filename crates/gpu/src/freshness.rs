//! Which passes must run: a result whose fingerprint has not changed, and whose memory nobody has used since, is kept.

use std::hash::{DefaultHasher, Hash, Hasher};

use tyndall_graph::descriptor::ParamValue;
use tyndall_graph::{Handle, Plan, PlannedPass, PlannedPort, Slot, Step, Table};

use crate::bindings::Values;
use crate::scene::SceneBuffers;
use crate::setup::{Program, Programs};

/// What every slot holds, and what every pass would give now.
pub(crate) struct Freshness {
    /// The part of a pass's fingerprint that a plan fixes.
    fixed: Table<PlannedPass, u64>,
    /// The scene data that a pass reads.
    scene: Table<PlannedPass, Vec<usize>>,
    /// The pass reads a history, has side effects, or must run anyway.
    always: Table<PlannedPass, bool>,
    /// For this frame.
    fingerprints: Table<PlannedPass, u64>,
    /// The pass runs in this frame.
    run: Table<PlannedPass, bool>,
    /// A running pass reads the port in this frame.
    needed: Table<PlannedPort, bool>,
    /// The port that a slot holds, and the fingerprint that this was made with.
    holds: Table<Slot, Option<(Handle<PlannedPort>, u64)>>,
    /// The content of the port was given, and is not computed.
    given: Table<PlannedPort, bool>,
    /// The port must hold its content after the frame.
    roots: Table<PlannedPort, bool>,
    /// Counts the frames, to make each one's histories distinct.
    frame: u64,
}

impl Freshness {
    pub(crate) fn new(plan: &Plan, programs: &dyn Programs, scene: &mut SceneBuffers) -> Self {
        let descriptors = || plan.passes.handles().map(|pass| plan.descriptor(pass));
        let fixed = plan
            .passes
            .handles()
            .map(|pass| {
                let mut hasher = DefaultHasher::new();
                let descriptor = plan.descriptor(pass);
                (&descriptor.name, descriptor.revision).hash(&mut hasher);
                programs.fingerprint(&descriptor.name).hash(&mut hasher);
                for binding in plan.bindings(pass) {
                    let slot = binding.map(|slot| &plan.slots[slot]);
                    slot.map(|slot| slot.resource).hash(&mut hasher);
                    slot.and_then(|slot| slot.initial()).map(|value| value.map(f32::to_bits)).hash(&mut hasher);
                }
                hasher.finish()
            })
            .collect();
        let scene =
            descriptors().map(|descriptor| descriptor.scene.iter().map(|name| scene.intern(name)).collect()).collect();
        let always = descriptors().map(|descriptor| descriptor.side_effect || descriptor.remembers()).collect();
        // What a history carries over is copied at the end of the frame, whoever else has read it.
        let roots = plan.ports.iter().map(|port| port.root || port.carried).collect();
        Self {
            fixed,
            scene,
            always,
            fingerprints: plan.passes.column(0),
            run: plan.passes.column(false),
            needed: plan.ports.column(false),
            holds: plan.slots.column(None),
            given: plan.ports.column(false),
            roots,
            frame: 0,
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
        self.holds[plan.ports[port].slot] = Some((port, 0));
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
        programs: &Table<PlannedPass, Box<dyn Program>>,
        everything: bool,
    ) -> usize {
        self.frame += 1;
        self.fingerprint(plan, values, scene, programs);
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

    /// Sets the fingerprint of every pass from those upstream, its parameters and the scene data that it reads.
    fn fingerprint(
        &mut self,
        plan: &Plan,
        values: &Table<PlannedPass, Values>,
        scene: &SceneBuffers,
        programs: &Table<PlannedPass, Box<dyn Program>>,
    ) {
        for index in plan.passes.handles() {
            let mut hasher = DefaultHasher::new();
            self.fixed[index].hash(&mut hasher);
            programs[index].fingerprint().hash(&mut hasher);
            for value in &values[index] {
                hash_value(value, &mut hasher);
            }
            for &data in &self.scene[index] {
                scene.version(data).hash(&mut hasher);
            }
            for source in plan.sources(index).iter().flatten() {
                source.hash(&mut hasher);
                if let Some(producer) = plan.ports[*source].pass {
                    self.fingerprints[producer].hash(&mut hasher);
                }
            }
            // What a history holds has no fingerprint; the number of the frame stands for it.
            if self.always[index] {
                self.frame.hash(&mut hasher);
            }
            self.fingerprints[index] = hasher.finish();
        }
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
        self.holds[planned.slot].is_some_and(|(held, fingerprint)| {
            held == port && (self.given[port] || fingerprint == self.fingerprints[pass])
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
                    self.holds[plan.ports[port].slot] = Some((port, self.fingerprints[pass]));
                }
            }
        }
    }
}

fn hash_value(value: &ParamValue, hasher: &mut impl Hasher) {
    match value {
        ParamValue::Bool(on) => on.hash(hasher),
        ParamValue::Integer(number) => number.hash(hasher),
        ParamValue::Float(number) => number.to_bits().hash(hasher),
        ParamValue::Vector(numbers) => numbers.iter().for_each(|number| number.to_bits().hash(hasher)),
        ParamValue::Choice(word) | ParamValue::File(word) => word.hash(hasher),
    }
}
