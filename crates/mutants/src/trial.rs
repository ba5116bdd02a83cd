//! One mutant before the tests.

use std::sync::Arc;

use tyndall_plugin::{Registry, RegistryPass};
use tyndall_shader::{Linked, Mutation};
use tyndall_testing::{Options, Outcome, PortOutcome, Problem, Session};

use crate::findings::{Nearest, Verdict};
use crate::hunt::{Tested, Trouble};

/// Turns that the loops of one invocation may take together: the first of these in which the right shader gives what it
/// always gives. Few, because a mutant that does not end takes them all.
const ITERATIONS: [u32; 4] = [1 << 10, 1 << 14, 1 << 18, 1 << 22];

/// What became of a mutant.
pub(crate) struct Judged {
    pub without_goldens: Verdict,
    pub verdict: Verdict,
}

/// Shows mutants of one pass to the tests that run it.
pub(crate) struct Trials<'a> {
    /// In which the tests have run as they are.
    pub session: &'a Session,
    pub pass: &'a RegistryPass,
    /// The quickest first.
    pub tests: &'a [&'a Tested],
    pub goldens: bool,
    pub every_test: bool,
}

/// A shader in the place of one of the pass's own, and a session that keeps what is made of it to itself.
struct StandIn<'a> {
    session: Session,
    file: &'a str,
    shader: Arc<Linked>,
}

/// What the tests said of a shader.
enum Answer {
    Verdict(Verdict),
    /// Nothing; and what came nearest to a failure, and whether every port came out as it always does, bit by bit.
    Unnoticed {
        nearest: Option<Nearest>,
        same_bits: bool,
    },
    /// No driver takes it.
    Invalid,
}

impl Trials<'_> {
    /// How many turns the loops of a right shader need.
    pub fn bound(&self, file: &str, shader: &Linked) -> Result<u32, Trouble> {
        if !shader.has_loops() {
            return Ok(ITERATIONS[0]);
        }
        for iterations in ITERATIONS {
            let Ok(right) = shader.mutant(None, iterations) else { break };
            if matches!(
                self.ask(&mut self.stand_in(file, right), false),
                Answer::Unnoticed { same_bits: true, .. } | Answer::Verdict(Verdict::Untested)
            ) {
                return Ok(iterations);
            }
        }
        Err(Trouble::Unbounded(self.pass.descriptor.name.clone()))
    }

    /// Makes a mutant and shows it to the tests. `None` where no compiler or driver takes it.
    pub fn run(&self, file: &str, shader: &Linked, mutation: &Mutation, iterations: u32) -> Option<Judged> {
        let mutant = shader.mutant(Some(mutation), iterations).ok()?;
        let mut stand_in = self.stand_in(file, mutant);
        let verdict = |answer: Answer| match answer {
            Answer::Verdict(verdict) => Some(verdict),
            Answer::Unnoticed { nearest, same_bits: false } => Some(Verdict::Tolerated(nearest)),
            Answer::Unnoticed { same_bits: true, .. } => Some(self.idle(file, shader, mutation, iterations)),
            Answer::Invalid => None,
        };
        let without_goldens = verdict(self.ask(&mut stand_in, false))?;
        let asks_goldens = self.goldens && (self.every_test || !without_goldens.is_killed());
        let with_goldens = asks_goldens.then(|| self.ask(&mut stand_in, true));
        let verdict = with_goldens.map_or_else(|| Some(without_goldens.clone()), verdict)?;
        Some(Judged { without_goldens, verdict })
    }

    /// Why no bit changes: would anything in that place show?
    fn idle(&self, file: &str, shader: &Linked, mutation: &Mutation, iterations: u32) -> Verdict {
        let drastic = mutation.drastic().and_then(|drastic| shader.mutant(Some(&drastic), iterations).ok());
        let Some(drastic) = drastic else { return Verdict::SameBits };
        match self.ask(&mut self.stand_in(file, drastic), false) {
            Answer::Unnoticed { same_bits: true, .. } => Verdict::Unreached,
            _ => Verdict::SameBits,
        }
    }

    fn stand_in<'f>(&self, file: &'f str, shader: Linked) -> StandIn<'f> {
        StandIn { session: self.session.fork(), file, shader: Arc::new(shader) }
    }

    /// Runs the tests until one fails, or all of them until one names another pass.
    fn ask(&self, stand_in: &mut StandIn<'_>, goldens: bool) -> Answer {
        if self.tests.is_empty() {
            return Answer::Verdict(Verdict::Untested);
        }
        let own = &self.pass.descriptor.name;
        let (mut nearest, mut same_bits, mut killed): (Option<Nearest>, _, _) = (None, true, None);
        for test in self.tests {
            let outcome = self.outcome(stand_in, test, goldens);
            if outcome.problems.iter().any(|problem| matches!(problem, Problem::Machine(_) | Problem::Mistakes(_))) {
                return Answer::Invalid;
            }
            same_bits &= outcome.digest == test.digest;
            let named = named(&outcome);
            if named.is_empty() {
                for other in excesses(&outcome, own).into_iter().filter(|other| other.excess.is_finite()) {
                    if other.excess > nearest.as_ref().map_or(0.0, |nearest| nearest.excess) {
                        nearest = Some(other);
                    }
                }
                continue;
            }
            if named.iter().any(|kind| kind != own) {
                return Answer::Verdict(Verdict::Misnamed { test: outcome.name(), named });
            }
            killed.get_or_insert(outcome.name());
            // Without goldens it is asked only whether it is killed, where with goldens is to come.
            if !(self.every_test && goldens == self.goldens) {
                break;
            }
        }
        killed.map_or(Answer::Unnoticed { nearest, same_bits }, |test| Answer::Verdict(Verdict::Killed { test }))
    }

    /// What a test finds: of the pass's own ports alone where these fail, since all that is made from them inherits that.
    fn outcome(&self, stand_in: &mut StandIn<'_>, test: &Tested, goldens: bool) -> Outcome {
        let registry = self.registry(test, stand_in);
        let options = Options { without_goldens: !goldens, fail_fast: true, digest: true, ..Options::default() };
        let only = Options { only: Some(self.pass.descriptor.name.clone()), ..options.clone() };
        let own = stand_in.session.run_with(&registry, &test.path, &only);
        // A check about another port as well is for the whole graph: it may be that one which fails.
        if own.ports.iter().any(PortOutcome::fails_by_itself) && !own.guilty().is_empty() {
            return own;
        }
        stand_in.session.run_with(&registry, &test.path, &options)
    }

    /// What a test runs with, and the shader in its place: another pass of the same name, beside another graph, keeps its own.
    fn registry(&self, test: &Tested, stand_in: &StandIn<'_>) -> Arc<Registry> {
        let name = &self.pass.descriptor.name;
        match test.registry.pass(name) {
            Some(pass) if pass.fingerprint == self.pass.fingerprint => {
                Arc::new(test.registry.with_shader(name, stand_in.file, &stand_in.shader))
            }
            _ => test.registry.clone(),
        }
    }
}

/// The kinds of the passes that a test blames.
fn named(outcome: &Outcome) -> Vec<String> {
    let guilty = outcome.guilty();
    let kinds = outcome.passes.iter().filter(|pass| guilty.contains(&pass.name.as_str()));
    let mut kinds: Vec<String> = kinds.map(|pass| pass.kind.clone()).collect();
    kinds.sort();
    kinds.dedup();
    kinds
}

/// How much of its tolerance each check of passes of a kind used up.
fn excesses(outcome: &Outcome, kind: &str) -> Vec<Nearest> {
    let of_ports = outcome.ports.iter().filter(|port| port.kind == kind).flat_map(|port| {
        let name = |what: &str| format!("{what} of {} in {}", port.name, outcome.name());
        port.checks.iter().map(move |check| Nearest { excess: check.judgement.excess, check: name(&check.what) })
    });
    let own = |pass: &str| outcome.passes.iter().any(|other| other.name == pass && other.kind == kind);
    let of_relations = outcome.relations.iter().filter(|relation| own(&relation.pass)).map(|relation| {
        let check = format!("\"{}\" of {} in {}", relation.about, relation.port, outcome.name());
        Nearest { excess: relation.judgement.excess, check }
    });
    of_ports.chain(of_relations).collect()
}
