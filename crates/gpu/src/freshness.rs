//! Which passes must run: a result whose fingerprint has not changed, and whose memory nobody has used since, is kept.

use std::hash::{DefaultHasher, Hash, Hasher};

use tyndall_graph::descriptor::{ParamValue, Role};
use tyndall_graph::{Plan, Step};

use crate::scene::SceneBuffers;
use crate::setup::{Program, Programs};

/// What every slot holds, and what every pass would give now.
pub(crate) struct Freshness {
    /// Of each pass: the part of its fingerprint that a plan fixes.
    fixed: Vec<u64>,
    /// Of each pass: the scene data that it reads.
    scene: Vec<Vec<usize>>,
    /// Of each pass: it reads a history, has side effects, or must run anyway.
    always: Vec<bool>,
    /// Of each pass, for this frame.
    fingerprints: Vec<u64>,
    /// Of each pass, for this frame: it runs.
    run: Vec<bool>,
    /// Of each port, for this frame: a running pass reads it.
    needed: Vec<bool>,
    /// Of each slot: the port that it holds, and the fingerprint that this was made with.
    holds: Vec<Option<(usize, u64)>>,
    /// Of each port: its content was given, and is not computed.
    given: Vec<bool>,
    /// Ports that must hold their content after the frame.
    roots: Vec<bool>,
    /// Counts the frames, to make each one's histories distinct.
    frame: u64,
}

impl Freshness {
    pub(crate) fn new(plan: &Plan, programs: &dyn Programs, scene: &mut SceneBuffers) -> Self {
        let passes = plan.passes.len();
        let descriptors = || (0..passes as u32).map(|pass| plan.descriptor(pass));
        let fixed = (0..passes as u32)
            .map(|pass| {
                let mut hasher = DefaultHasher::new();
                let descriptor = plan.descriptor(pass);
                (&descriptor.name, descriptor.revision).hash(&mut hasher);
                programs.fingerprint(&descriptor.name).hash(&mut hasher);
                for binding in plan.bindings(pass) {
                    let slot = binding.map(|slot| &plan.slots[slot as usize]);
                    slot.map(|slot| slot.resource).hash(&mut hasher);
                    slot.and_then(|slot| slot.initial()).map(|value| value.map(f32::to_bits)).hash(&mut hasher);
                }
                hasher.finish()
            })
            .collect();
        let scene =
            descriptors().map(|descriptor| descriptor.scene.iter().map(|name| scene.intern(name)).collect()).collect();
        let always = descriptors()
            .map(|descriptor| {
                let history = descriptor.ports.iter().any(|port| matches!(port.role, Role::History(_)));
                descriptor.side_effect || history
            })
            .collect();
        let mut roots = vec![false; plan.ports.len()];
        for (index, port) in plan.ports.iter().enumerate() {
            // What a history carries over is copied at the end of the frame, whoever else has read it.
            roots[index] = port.root || port.carried;
        }
        Self {
            fixed,
            scene,
            always,
            fingerprints: vec![0; passes],
            run: vec![false; passes],
            needed: vec![false; plan.ports.len()],
            holds: vec![None; plan.slots.len()],
            given: vec![false; plan.ports.len()],
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
    pub(crate) fn forget_pass(&mut self, plan: &Plan, pass: u32) {
        for port in plan.outputs_of(pass) {
            self.holds[plan.ports[port as usize].slot as usize] = None;
        }
    }

    /// The port's slot holds what was put there from outside; its pass need not run for it any more.
    pub(crate) fn give(&mut self, plan: &Plan, port: usize) {
        self.given[port] = true;
        self.holds[plan.ports[port].slot as usize] = Some((port, 0));
    }

    /// Whether this pass runs in this frame.
    pub(crate) fn runs(&self, pass: usize) -> bool {
        self.run[pass]
    }

    /// Whether the port's slot still holds what the port last was.
    pub(crate) fn holds(&self, plan: &Plan, port: usize) -> bool {
        let planned = &plan.ports[port];
        planned.pass.is_none() || self.holds[planned.slot as usize].is_some_and(|(held, _)| held == port)
    }

    /// Decides which passes run in this frame, and says how many.
    pub(crate) fn decide(
        &mut self,
        plan: &Plan,
        values: &[Vec<ParamValue>],
        scene: &SceneBuffers,
        programs: &[Box<dyn Program>],
        everything: bool,
    ) -> usize {
        self.frame += 1;
        self.fingerprint(plan, values, scene, programs);
        if everything {
            self.run.fill(true);
            return self.run.len();
        }
        for pass in 0..self.run.len() {
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
        values: &[Vec<ParamValue>],
        scene: &SceneBuffers,
        programs: &[Box<dyn Program>],
    ) {
        for index in 0..plan.passes.len() {
            let mut hasher = DefaultHasher::new();
            self.fixed[index].hash(&mut hasher);
            programs[index].fingerprint().hash(&mut hasher);
            for value in &values[index] {
                hash_value(value, &mut hasher);
            }
            for &data in &self.scene[index] {
                scene.version(data).hash(&mut hasher);
            }
            for source in plan.sources(index as u32).iter().flatten() {
                source.hash(&mut hasher);
                if let Some(producer) = plan.ports[*source as usize].pass {
                    self.fingerprints[producer as usize].hash(&mut hasher);
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
        for (port, planned) in plan.ports.iter().enumerate() {
            if let Some(pass) = planned.pass
                && self.roots[port]
                && !self.valid(plan, port)
            {
                self.run[pass as usize] = true;
            }
        }
        for index in (0..plan.passes.len()).rev() {
            if !self.run[index] {
                continue;
            }
            for source in plan.sources(index as u32).iter().flatten() {
                if let Some(pass) = plan.ports[*source as usize].pass
                    && !self.valid(plan, *source as usize)
                {
                    self.run[pass as usize] = true;
                }
            }
        }
    }

    /// All that a pass writes was put there from outside, and it does nothing else.
    fn is_given(&self, plan: &Plan, pass: usize) -> bool {
        let mut outputs = plan.outputs_of(pass as u32);
        let writes_alone = !plan.descriptor(pass as u32).side_effect && !outputs.is_empty();
        writes_alone && outputs.all(|port| self.given[port as usize])
    }

    fn valid(&self, plan: &Plan, port: usize) -> bool {
        let planned = &plan.ports[port];
        let Some(pass) = planned.pass else { return true };
        self.holds[planned.slot as usize].is_some_and(|(held, fingerprint)| {
            held == port && (self.given[port] || fingerprint == self.fingerprints[pass as usize])
        })
    }

    /// Marks passes whose kept result would be overwritten in this frame before its last reader comes.
    /// Says whether there was one.
    fn overwritten(&mut self, plan: &Plan) -> bool {
        self.needed.fill(false);
        for index in 0..plan.passes.len() {
            if self.run[index] {
                for source in plan.sources(index as u32).iter().flatten() {
                    self.needed[*source as usize] = true;
                }
            }
        }
        let mut changed = false;
        for (port, planned) in plan.ports.iter().enumerate() {
            let Some(pass) = planned.pass.map(|pass| pass as usize) else { continue };
            if self.run[pass] || !(self.needed[port] || self.roots[port]) {
                continue;
            }
            let others = plan.ports_in(planned.slot).filter_map(|other| plan.ports[other as usize].pass);
            if others.map(|other| other as usize).any(|other| other < pass && self.run[other]) {
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
                && self.run[pass as usize]
            {
                for port in plan.outputs_of(pass) {
                    let held = (port as usize, self.fingerprints[pass as usize]);
                    self.holds[plan.ports[port as usize].slot as usize] = Some(held);
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
