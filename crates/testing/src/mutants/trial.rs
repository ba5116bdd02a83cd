//! One mutant before the tests.

use std::path::Path;

use tyndall_shader::{Linked, Mutation};

use super::{Nearest, Trouble, Verdict};
use crate::options::Options;
use crate::outcome::{Outcome, Problem};
use crate::session::Session;
use crate::substitute::Substitute;

/// Turns that the loops of one invocation may take together: the first of these in which the right shader gives what it
/// always gives. Few, because a mutant that does not end takes them all.
const ITERATIONS: [u32; 4] = [1 << 10, 1 << 14, 1 << 18, 1 << 22];

/// What came of a mutant.
pub(super) enum Trial {
    /// No compiler or driver takes it.
    Invalid,
    Judged {
        without_goldens: Verdict,
        verdict: Verdict,
    },
}

/// Shows mutants of one pass to the tests that run it.
pub(super) struct Trials<'a> {
    pub session: &'a mut Session,
    pub pass: &'a str,
    pub fingerprint: u64,
    /// The quickest first.
    pub tests: &'a [&'a Path],
    pub goldens: bool,
    pub every_test: bool,
}

/// What the tests said of a shader.
enum Answer {
    Verdict(Verdict),
    /// Nothing; and what came nearest to a failure.
    Unnoticed(Option<Nearest>),
    Invalid,
}

impl Trials<'_> {
    /// How many turns the loops of a right shader need.
    pub fn bound(&mut self, file: &str, shader: &Linked) -> Result<u32, Trouble> {
        if !shader.has_loops() {
            return Ok(ITERATIONS[0]);
        }
        for iterations in ITERATIONS {
            let right = shader.mutant(None, iterations).map_err(|_| Trouble::Unbounded(self.pass.to_owned()))?;
            self.session.substitute(Substitute::new(self.pass, file, self.fingerprint, right));
            let answer = self.ask(false);
            let changed = self.session.restore();
            if !changed && matches!(answer, Answer::Unnoticed(_) | Answer::Verdict(Verdict::Untested)) {
                return Ok(iterations);
            }
        }
        Err(Trouble::Unbounded(self.pass.to_owned()))
    }

    /// Makes a mutant and shows it to the tests.
    pub fn run(&mut self, file: &str, shader: &Linked, mutation: &Mutation, iterations: u32) -> Result<Trial, Trouble> {
        let Ok(mutant) = shader.mutant(Some(mutation), iterations) else { return Ok(Trial::Invalid) };
        self.session.substitute(Substitute::new(self.pass, file, self.fingerprint, mutant));
        let alone = self.ask(false);
        let killed = matches!(&alone, Answer::Verdict(verdict) if verdict.is_killed());
        let all = if self.goldens && (self.every_test || !killed) { Some(self.ask(true)) } else { None };
        let changed = self.session.restore();
        let mut unnoticed = |answer: &Answer| match answer {
            Answer::Verdict(verdict) => Some(verdict.clone()),
            Answer::Unnoticed(nearest) if changed => Some(Verdict::Tolerated(nearest.clone())),
            Answer::Unnoticed(_) => Some(self.idle(file, shader, mutation, iterations)),
            Answer::Invalid => None,
        };
        let Some(without_goldens) = unnoticed(&alone) else { return Ok(Trial::Invalid) };
        let verdict = match &all {
            Some(answer) => unnoticed(answer),
            None => Some(without_goldens.clone()),
        };
        Ok(match verdict {
            Some(verdict) => Trial::Judged { without_goldens, verdict },
            None => Trial::Invalid,
        })
    }

    /// Why no bit changes: would anything in that place show?
    fn idle(&mut self, file: &str, shader: &Linked, mutation: &Mutation, iterations: u32) -> Verdict {
        let drastic = mutation.drastic().and_then(|drastic| shader.mutant(Some(&drastic), iterations).ok());
        let Some(drastic) = drastic else { return Verdict::SameBits };
        self.session.substitute(Substitute::new(self.pass, file, self.fingerprint, drastic));
        let answer = self.ask(false);
        let changed = self.session.restore();
        match answer {
            Answer::Unnoticed(_) if !changed => Verdict::Unreached,
            _ => Verdict::SameBits,
        }
    }

    /// Runs the tests until one fails, or all of them until one names another pass.
    fn ask(&mut self, goldens: bool) -> Answer {
        if self.tests.is_empty() {
            return Answer::Verdict(Verdict::Untested);
        }
        let options = Options { without_goldens: !goldens, until_failure: true, ..Options::default() };
        let mut nearest: Option<Nearest> = None;
        let mut killed = None;
        for test in self.tests {
            let outcome = self.session.run(test, &options);
            if outcome.problems.iter().any(|problem| matches!(problem, Problem::Machine(_) | Problem::Mistakes(_))) {
                return Answer::Invalid;
            }
            let named = self.named(&outcome);
            if !named.is_empty() {
                let test = outcome.name();
                if named.iter().any(|kind| kind != self.pass) {
                    return Answer::Verdict(Verdict::Misnamed { test, named });
                }
                if !(self.every_test && goldens == self.goldens) {
                    return Answer::Verdict(Verdict::Killed { test });
                }
                killed.get_or_insert(test);
                continue;
            }
            for (excess, check) in self.excesses(&outcome) {
                if excess.is_finite() && excess > nearest.as_ref().map_or(0.0, |nearest| nearest.excess) {
                    nearest = Some(Nearest { excess, check });
                }
            }
        }
        match killed {
            Some(test) => Answer::Verdict(Verdict::Killed { test }),
            None => Answer::Unnoticed(nearest),
        }
    }

    /// The kinds of the passes that a test blames.
    fn named(&self, outcome: &Outcome) -> Vec<String> {
        let guilty = outcome.guilty();
        let kinds = outcome.passes.iter().filter(|pass| guilty.contains(&pass.name.as_str()));
        let mut kinds: Vec<String> = kinds.map(|pass| pass.kind.clone()).collect();
        kinds.sort();
        kinds.dedup();
        kinds
    }

    /// How much of its tolerance each check of the pass used up.
    fn excesses(&self, outcome: &Outcome) -> Vec<(f64, String)> {
        let of_ports = outcome.ports.iter().filter(|port| port.kind == self.pass).flat_map(|port| {
            let name = |what: &str| format!("{what} of {} in {}", port.name, outcome.name());
            port.checks.iter().map(move |check| (check.judgement.excess, name(&check.what)))
        });
        let own = |pass: &str| outcome.passes.iter().any(|other| other.name == pass && other.kind == self.pass);
        let of_relations = outcome.relations.iter().filter(|relation| own(&relation.pass)).map(|relation| {
            let name = format!("\"{}\" of {} in {}", relation.about, relation.port, outcome.name());
            (relation.judgement.excess, name)
        });
        of_ports.chain(of_relations).collect()
    }
}
